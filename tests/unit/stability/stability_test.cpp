#include <tamis/stability/stability.hpp>
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;
using stability::bar;

namespace {

constexpr double tolerance = 3e-5, most = 1.2;

/// How much the kinetic energy of a rough start has grown after some steps, in a run of plain numbers.
template <class... Policy> double growth(const bar& set, double courant, int steps, const Policy&... policies) {
    // Some runs grow beyond all numbers.
    auto mpm = stability::detail::solver_of<double>(set, policies..., held{}, unchecked{});
    std::vector<point<1, double>> places;
    const double side = 1. / set.per_cell, first = set.free ? 4 + set.offset : 0;
    for (int p = 0; p < set.cells * set.per_cell; ++p) places.push_back(point<1, double>(first + (p + 0.5) * side));
    auto body = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0, .density = 1}, places, side);
    int number = 0;
    for (auto p : body) {
        p[v][0] = std::sin(1 + 2.3 * number * number);
        ++number;
    }
    const double before = kinetic_energy(body) + elastic_energy(body);
    for (int n = 0; n < steps; ++n) mpm.step(bodies(body), courant);
    return (kinetic_energy(body) + elastic_energy(body)) / before;
}

template <class... Policy> void check_runs(const bar& set, const Policy&... policies) {
    const double critical = stability::critical_courant(set, most, tolerance, policies...);
    CAPTURE(critical);
    REQUIRE(critical > 0.1);
    REQUIRE(critical < most);
    CHECK(growth(set, 0.98 * critical, 4000, policies...) < 100);
    CHECK_FALSE(growth(set, 1.02 * critical, 4000, policies...) < 1e6);
}

}  // namespace

TEST_CASE("stability: the Jacobian is that of the step") {
    const bar set{4, 2};
    const double courant = 0.4, small = 1e-7;
    const auto check = [&](const auto&... policies) {
        const Eigen::MatrixXd J = stability::jacobian(set, courant, policies...);
        REQUIRE(J.rows() == 16);
        double largest = 0;
        for (int column = 0; column < 16; ++column) {
            auto mpm = stability::detail::solver_of<double>(set, policies...);
            auto body = mpm.make_body(linear_elastic{.young = 1, .poisson = 0, .density = 1}, everywhere, per_cell{2});
            int number = 0;
            for (auto p : body) {
                if (number == column) p[v][0] = small;
                if (number + 8 == column) p[sigma](0, 0) = small;
                ++number;
            }
            mpm.step(bodies(body), courant);
            number = 0;
            for (const auto p : std::as_const(body)) {
                largest = std::max(largest, std::abs(p[v][0] / small - J(number, column)));
                largest = std::max(largest, std::abs(p[sigma](0, 0) / small - J(8 + number, column)));
                ++number;
            }
        }
        CHECK(largest < 1e-6);
        CHECK(J.cwiseAbs().maxCoeff() > 0.5);
    };
    check(linear{}, flip{}, usl_minus{});
    check(quadratic_spline{}, fmpm<dynamic>{4}, usavg_plus{});
}

TEST_CASE("stability: known limits are met") {
    // On the periodic lattice, linear functions and 2 particles per cell: C^2 = 4/7. Fixed ends come near it from
    // above, by the square of the longest wave number.
    const auto of = [](int cells, const auto& update) {
        return stability::critical_courant(bar{cells, 2}, most, tolerance, linear{}, update, usl_minus{});
    };
    const double lattice = std::sqrt(4. / 7), at_16 = of(16, flip{}) - lattice, at_32 = of(32, flip{}) - lattice;
    CAPTURE(at_16, at_32);
    CHECK(at_32 > 0);
    CHECK(at_32 < 0.002);
    CHECK(std::abs(at_16 / at_32 - 4) < 0.5);
    // FMPM(k), k to infinity: 1/2.
    CHECK(std::abs(of(32, fmpm<dynamic>{64}) - 0.5) < 0.004);
    CHECK(of(16, fmpm<dynamic>{1}) > of(16, fmpm<dynamic>{2}));
    CHECK(of(16, fmpm<dynamic>{2}) > of(16, fmpm<dynamic>{8}));
}

TEST_CASE("stability: USL+ and USAVG+ have the limits of USF") {
    for (const double courant : {0.4, 0.8}) {
        const auto of = [&](const auto& order) {
            return stability::spectral_radius(bar{8, 2, 0.3, true}, courant, linear{}, fmpm<dynamic>{4}, order);
        };
        const double first = of(usf{});
        CHECK(std::abs(of(usl_plus{}) / first - 1) < 1e-4);
        CHECK(std::abs(of(usavg_plus{}) / first - 1) < 1e-4);
    }
}

TEST_CASE("stability: runs grow beyond the critical number and not below") {
    check_runs(bar{8, 2}, linear{}, flip{}, usl_minus{});
    check_runs(bar{8, 2}, linear{}, fmpm<dynamic>{4}, usl_minus{});
    check_runs(bar{8, 2, 0.4, true}, linear{}, flip{}, usl_minus{});
    check_runs(bar{8, 2, 0.1, true}, quadratic_spline{}, fmpm<dynamic>{4}, usl_minus{});
}

TEST_CASE("stability: explicit Euler is unstable at every step") {
    CHECK(stability::spectral_radius(bar{8, 2}, 0.02, linear{}, flip{}, euler{}) > 1 + 1e-5);
    CHECK(stability::critical_courant(bar{8, 2}, most, tolerance, linear{}, flip{}, euler{}) < 0.02);
}

TEST_CASE("stability: bars that make no sense get a sentence") {
    const auto radius = [](const bar& set) {
        return complaint([&] { stability::spectral_radius(set, 0.1, linear{}, flip{}, usl_minus{}); });
    };
    CHECK(names(radius(bar{0, 2}), "stability::bar", "0 cells"));
    CHECK(names(radius(bar{4, 2, 0.5}), "the offset is 0.5", "free ends"));
}
