#include <tamis/shape/gimp.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include "unit/complaint.hpp"
#include "unit/shape/functions.hpp"

using namespace tamis;

namespace {

/// Integral of the tent max(0, 1 - |x|) from minus infinity to x.
double tent_integral(double x) {
    if (x <= -1) return 0;
    if (x <= 0) return (x + 1) * (x + 1) / 2;
    if (x <= 1) return 1 - (1 - x) * (1 - x) / 2;
    return 1;
}
double tent(double x) { return std::max(0., 1 - std::abs(x)); }

/// Functions of a domain 2 l wide around place r of a cell, by the integral and its derivative.
axis_weights<double, 3> by_integral(double r, double l) {
    axis_weights<double, 3> at;
    for (int k = 0; k < 3; ++k) {
        const double x = r - 0.5 - (k - 1);
        at.w[k] = (tent_integral(x + l) - tent_integral(x - l)) / (2 * l);
        at.dw[k] = (tent(x + l) - tent(x - l)) / (2 * l);
    }
    return at;
}

/// A particle as a shape sees it: its stretches.
struct stretched {
    double along[3];
    struct gradient {
        const double* along;
        double operator()(int d, int) const { return along[d]; }
    };
    gradient operator[](field::deformation) const { return {along}; }
};

void same(const axis_weights<double, 3>& a, const axis_weights<double, 3>& b, double within) {
    for (int k = 0; k < 3; ++k) {
        CHECK(std::abs(a.w[k] - b.w[k]) < within);
        CHECK(std::abs(a.dw[k] - b.dw[k]) < within);
    }
}

}  // namespace

TEST_CASE("ugimp: tents averaged over the particle's domain") {
    for (const int per_cell : {1, 2, 3, 4, 7}) {
        CAPTURE(per_cell);
        // A difference across the places where the slope bends says nothing.
        if (per_cell == 3 || per_cell == 7) check_functions(ugimp{per_cell});
        for (int j = 0; j <= 40; ++j)
            same(ugimp{per_cell}.on_axis(j / 40.), by_integral(j / 40., 0.5 / per_cell), 1e-14);
    }
    CHECK(slopes_are_continuous(ugimp{2}));
}

TEST_CASE("ugimp: one particle per cell is the quadratic spline") {
    for (int j = 0; j <= 10; ++j) same(ugimp{1}.on_axis(j / 10.), quadratic_spline{}.on_axis(j / 10.), 1e-15);
}

TEST_CASE("cpgimp: domains follow the stretch along each axis, up to a cell's side") {
    STATIC_REQUIRE(ShapeFunction<cpgimp>);
    const stretched particle{{1, 1.3, 9}};
    for (int j = 0; j <= 20; ++j) {
        const double r = j / 20.;
        same(cpgimp{2}.on_axis(r, particle, 0), ugimp{2}.on_axis(r), 1e-15);
        same(cpgimp{2}.on_axis(r, particle, 1), by_integral(r, 0.25 * 1.3), 1e-14);
        same(cpgimp{2}.on_axis(r, particle, 2), by_integral(r, 0.5), 1e-14);
        // An empty lane has no stretch: its functions are numbers all the same.
        const auto empty = cpgimp{2}.on_axis(r, stretched{{0, 0, 0}}, 0);
        for (int k = 0; k < 3; ++k) CHECK(std::isfinite(empty.w[k] + empty.dw[k]));
    }
    // A domain of hardly any width, or of none left, is a millionth of a cell's side to either side: tents.
    for (const double stretch : {1e-7, 0., -1.}) {
        const auto middle = cpgimp{2}.on_axis(0.5, stretched{{stretch, 0, 0}}, 0);
        CHECK(std::abs(middle.w[0] / 0.25e-6 - 1) < 1e-9);
        CHECK(std::abs(middle.w[2] / 0.25e-6 - 1) < 1e-9);
        const auto beside = cpgimp{2}.on_axis(0.6, stretched{{stretch, 0, 0}}, 0);
        CHECK(std::abs(beside.w[2] - 0.1) < 1e-15);
        CHECK(beside.dw[2] == 1);
    }
    CHECK(cpgimp{4}.undeformed().half_width() == 0.125);
}

TEST_CASE("gimp: a number of particles per cell below 1 is refused") {
    CHECK(names(complaint([] { ugimp{0}; }), "ugimp", "per_cell is 0", "1 or more"));
    CHECK(names(complaint([] { cpgimp{-2}; }), "cpgimp", "per_cell is -2"));
}
