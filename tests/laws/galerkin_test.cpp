// What the Taylor-Galerkin scheme keeps, and up to which step it is stable.
#include <tamis/conservation/integrate.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include "amplification.hpp"
#include "burgers.hpp"

#include "catch.hpp"

using namespace tamis;
using std::numbers::pi;

namespace {

const uniform_grid<1> ring = uniform_grid<1>{{0.}, {1.}, 1. / 16}.wrapped(0);

}  // namespace

TEST_CASE("Taylor-Galerkin: critical Courant numbers are those of von Neumann's analysis") {
    for (const int per_cell : {1, 2, 3, 5})
        for (const int k : {1, 2, 3, 8}) {
            if (per_cell == 1 && k > 1) continue;  // the full mass matrix is singular: no long wave is stable
            CAPTURE(per_cell, k);
            taylor_galerkin scheme{ring, conservation::advection<>{{1.}}, tamis::per_cell{per_cell}, linear{},
                                   full_mass<dynamic>{k}};
            const double theory = amplification::critical_courant_of_theory(per_cell, k, 16);
            CHECK(std::abs(amplification::critical_courant(scheme) - theory) < 5e-5);
            // Long waves decide: more cells go down to the number of the exact inverse, for every k > 1.
            const double limit = k == 1 ? 1 : std::sqrt((per_cell * per_cell - 1) / 3.) / per_cell;
            CHECK(theory >= limit - 1e-12);
            CHECK(std::abs(amplification::critical_courant_of_theory(per_cell, k, 1 << 10) - limit) < 1e-4);
        }
}

TEST_CASE("Taylor-Galerkin: systems have the critical Courant numbers of their waves") {
    for (const int k : {1, 4}) {
        taylor_galerkin scheme{ring, conservation::elastic_bar{4, 0.25}, per_cell{2}, linear{}, full_mass<dynamic>{k}};
        const double theory = amplification::critical_courant_of_theory(2, k, 16);
        CHECK(amplification::growth(scheme, 0.999 * theory) < 1 + 1e-10);
        CHECK(amplification::growth(scheme, 1.001 * theory) > 1 + 1e-10);
    }
}

TEST_CASE("Taylor-Galerkin: what is in the domain grows by what comes in, and a shock runs at its speed") {
    const conservation::ends open{conservation::inflow{[](double t) { return t < 0.5 ? 1 : 1.2; }},
                                  conservation::outflow{}};
    const auto run = [&](const auto& shape, const auto& mass) {
        taylor_galerkin scheme{uniform_grid{{0.}, {1.}, 0.01}, burgers{}, per_cell{2}, shape, mass, open};
        scheme.set([](const auto& at) { return at[0] < 0.2 ? 1. : 0.; });
        const double before = scheme.total()[0];
        integrate(scheme, interval{0, 0.4}, courant{0.2});
        // The flux 1/2, but for the ripples' ends.
        CHECK(std::abs(scheme.gain()[0] - 0.4 * 0.5) < 2e-4);
        CHECK(std::abs(scheme.total()[0] - before - scheme.gain()[0]) < 1e-14);
        double front = 0;
        for (int i = 0; i <= 100; ++i)
            if (scheme.on_node({i, 0, 0})[0] > 0.5) front = i * 0.01;
        CHECK(std::abs(front - (0.2 + 0.5 * 0.4)) < 0.011);
        integrate(scheme, interval{0.4, 0.8}, courant{0.2});
        CHECK(std::abs(scheme.total()[0] - before - scheme.gain()[0]) < 1e-14);
    };
    run(linear{}, lumped_mass{});
    run(quadratic_spline{}, full_mass<dynamic>{3});
}

TEST_CASE("Taylor-Galerkin: in two dimensions waves along an axis are those in one, and all waves are second order") {
    const auto wave = [](double s) { return std::sin(2 * pi * s) + 0.3 * std::cos(4 * pi * s); };
    const auto square = [](int cells) { return uniform_grid{{0., 0.}, {1., 1.}, 1. / cells}.wrapped(0).wrapped(1); };
    const full_mass<dynamic> mass{3};
    double before = 0;
    for (const int cells : {20, 40}) {
        taylor_galerkin along{square(cells), conservation::advection<2>{{1., 0.}}, per_cell{2}, quadratic_spline{},
                              mass};
        taylor_galerkin across{square(cells), conservation::advection<2>{{0.5, 1.}}, per_cell{2}, quadratic_spline{},
                               mass};
        taylor_galerkin line{uniform_grid{{0.}, {1.}, 1. / cells}.wrapped(0), conservation::advection<>{{1.}},
                             per_cell{2}, quadratic_spline{}, mass};
        along.set([&](const auto& at) { return wave(at[0]); });
        across.set([&](const auto& at) { return wave(2 * at[0] + at[1]); });
        line.set([&](const auto& at) { return wave(at[0]); });
        const double total = across.total()[0];
        for (const double end : {0.25, 0.5}) {
            integrate(along, interval{end - 0.25, end}, courant{0.2});
            integrate(across, interval{end - 0.25, end}, courant{0.2});
            integrate(line, interval{end - 0.25, end}, courant{0.2});
        }
        double off = 0, error = 0;
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i) {
                const double x = static_cast<double>(i) / cells, y = static_cast<double>(j) / cells;
                off = std::max(off, std::abs(along.on_node({i, j, 0})[0] - line.on_node({i, 0, 0})[0]));
                // Two periods of the wave have gone by.
                error = std::max(error, std::abs(across.on_node({i, j, 0})[0] - wave(2 * x + y - 1)));
            }
        CHECK(off < 1e-13);
        CHECK(std::abs(across.total()[0] - total) < 1e-14);
        CAPTURE(before, error);
        if (cells == 40) CHECK(before / error > 3.5);
        before = error;
    }
}

TEST_CASE("Taylor-Galerkin: wrong use is told") {
    const conservation::advection<> law{{1.}};
    CHECK_THROWS_AS((uniform_grid{{0.}, {1.}, 0.5}.wrapped(0)), error);
    CHECK_THROWS_AS((uniform_grid{{0.}, {1.}, 0.1}.wrapped(1)), error);
    CHECK_THROWS_AS((taylor_galerkin{uniform_grid{{0., 0.}, {1., 1.}, 0.1}.wrapped(0),
                                     conservation::advection<2>{{1., 0.}}, per_cell{2}}),
                    error);
    CHECK_THROWS_AS((taylor_galerkin{ring, law, std::vector<point<1, double>>{}, 1.}), error);
    const std::vector<point<1, double>> middle{point<1, double>(0.5)};
    CHECK_THROWS_AS((taylor_galerkin{uniform_grid{{0.}, {1.}, 0.1}, law, middle, 1.}), error);
    CHECK_THROWS_AS((taylor_galerkin{ring, conservation::elastic_bar{-1, 1}, per_cell{2}}), error);
    taylor_galerkin scheme{ring, law, per_cell{2}};
    CHECK_THROWS_AS(scheme.step(-1.), error);
    CHECK_THROWS_AS(integrate(scheme, interval{0, 1}, fixed_steps{10}), error);
    CHECK_THROWS_AS(integrate(scheme, interval{0, 1}, courant{1.5}), error);
    scheme.set([](const auto& at) { return std::sqrt(at[0] - 0.5); });
    CHECK_THROWS_AS(integrate(scheme, interval{0, 1}, courant{0.5}), error);
}
