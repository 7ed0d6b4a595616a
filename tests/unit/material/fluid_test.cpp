#include <tamis/tamis.hpp>

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/deform.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double pi = std::numbers::pi;

/// Velocity at the middle of a tube of fluid, 0 <= x <= 1, that rings in its first mode, over the first one.
template <class Fluid> double ringing(const Fluid& fluid, double time) {
    const double amplitude = 1e-6;
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.02}, quadratic_spline{}, flip{}, usavg_minus{}, ends};
    auto tube = mpm.make_body(fluid, everywhere, per_cell{2});
    set_velocity_of(tube, [&](const auto& at) { return amplitude * std::sin(pi * at[0]); });
    integrate(mpm, bodies(tube), {0, time}, courant{0.1});
    // Its part in the mode.
    return sum_over(tube, [](const auto& p) { return p[v][0] * std::sin(pi * p[x][0]); }) / 50 / amplitude;
}

}  // namespace

TEST_CASE("tait: pressure, stress and energy by hand; with n = gamma and K = gamma p0 it is the gas of one entropy") {
    for (const double d : {-0.2, 0.3}) {
        const tait water{.bulk = 3, .exponent = 7, .density = 2};
        const auto body = swell<moving, 2>(water, d, 2, 0.1);
        const auto p = *body.begin();
        const double J = std::pow(1 + 2 * d * 0.1, 2), pressure = 3. / 7 * (std::pow(J, -7) - 1);
        CHECK(std::abs(p[rho] * J / 2 - 1) < 1e-14);
        CHECK(std::abs(p[sigma](1, 1) / (-pressure * J) - 1) < 1e-13);
        CHECK(p[sigma](0, 1) == 0);
        CHECK(std::abs(elastic_energy(body) / (3. / 7 * ((std::pow(J, -6) - 1) / 6 + J - 1)) - 1) < 1e-12);
        CHECK(std::abs(water.wave_speed_at(p, 2) / std::sqrt(1.5 * std::pow(J, -6)) - 1) < 1e-13);
        for (const double gamma : {1., 1.4}) {
            const auto fluid = swell<moving, 1>(tait{.bulk = gamma * 5, .exponent = gamma, .density = 2}, d, 3, 0.1);
            const auto gas = swell<moving, 1>(pressure_gas{gamma, 2, 5, 5}, d, 3, 0.1);
            CHECK(std::abs((*fluid.begin())[sigma](0, 0) / (*gas.begin())[sigma](0, 0) - 1) < 1e-12);
            CHECK(std::abs(elastic_energy(fluid) / elastic_energy(gas) - 1) < 1e-11);
        }
    }
}

TEST_CASE("newtonian: shear and swelling by hand, in one, two and three dimensions") {
    const newtonian_fluid oil{.law = {.bulk = 3, .density = 2}, .viscosity = 0.7, .bulk_viscosity = 0.2};
    const auto check = [&](auto dimension) {
        constexpr int D = decltype(dimension)::value;
        matrix<D, double> L;
        for (int c = 0; c < D; ++c)
            for (int d = 0; d < D; ++d) L(c, d) = 0.1 * (c + 1) - 0.15 * d;
        const auto body = deform<moving>(oil, L, 1, 0.1);
        const auto p = *body.begin();
        const double J = 1 + 0.1 * L.trace(), pressure = 3. / 7 * (std::pow(J, -7) - 1);
        const matrix<D, double> D_sym = (L + L.transpose()) / 2;
        const matrix<D, double> one = matrix<D, double>::Identity();
        const matrix<D, double> expected =
            J * (2 * 0.7 * (D_sym - L.trace() / 3 * one) + (0.2 * L.trace() - pressure) * one);
        CHECK((matrix<D, double>(p[sigma]) - expected).norm() < 1e-13);
    };
    check(std::integral_constant<int, 1>{});
    check(std::integral_constant<int, 2>{});
    check(std::integral_constant<int, 3>{});
}

TEST_CASE("tait: sound has the speed sqrt(K/rho); newtonian viscosity damps it as the oscillator that the mode is") {
    // q'' + 2 beta q' + (pi c)^2 q = 0 with q(0) = 0, v = q', beta = (4/3 mu + kappa) pi^2/(2 rho)
    const tait fluid{.bulk = 2, .exponent = 7, .density = 0.5};
    const double c = 2, time = 0.8 / c;
    CHECK(std::abs(ringing(fluid, time) - std::cos(pi * c * time)) < 2e-3);
    const double mu = 0.03, kappa = 0.01, beta = (4. / 3 * mu + kappa) * pi * pi / (2 * 0.5);
    const double w = std::sqrt(pi * c * pi * c - beta * beta);
    const double damped = std::exp(-beta * time) * (std::cos(w * time) - beta / w * std::sin(w * time));
    CHECK(std::abs(ringing(newtonian_fluid{fluid, mu, kappa}, time) - damped) < 2e-3);
    CHECK(std::abs(damped - std::cos(pi * c * time)) > 0.1);
}

TEST_CASE("newtonian: a vortex between slippery walls decays with exp(-2 nu pi^2 t)") {
    // Taylor and Green's, v = (sin pi x cos pi y, -cos pi x sin pi y): no flow through the walls, and no shear there.
    const double nu = 0.05, amplitude = 1e-4, time = 0.4, exact = std::exp(-2 * nu * pi * pi * time);
    using place = point<2, double>;
    const conditions walls{slip{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }, place(1, 0)},
                           slip{[](const auto& at) { return at[1] <= 0 || at[1] >= 1; }, place(0, 1)}};
    const auto vortex = [](const auto& at) {
        return place(std::sin(pi * at[0]) * std::cos(pi * at[1]), -std::cos(pi * at[0]) * std::sin(pi * at[1]));
    };
    const auto off = [&](int cells) {
        solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 1. / cells}, quadratic_spline{}, flip{}, walls};
        auto box = mpm.make_body(newtonian_fluid{{.bulk = 4, .density = 2}, 2 * nu}, everywhere, per_cell{2});
        set_velocity_of(box, [&](const auto& at) { return (amplitude * vortex(at)).eval(); });
        integrate(mpm, bodies(box), {0, time}, courant{0.1});
        const double part = sum_over(box, [&](const auto& p) { return p[v].dot(vortex(p[x])); });
        return std::abs(part / (2. * cells * cells) / amplitude / exact - 1);
    };
    const double coarse = off(16), fine = off(32);
    CAPTURE(coarse, fine);
    CHECK(fine < 6e-3);
    CHECK(coarse / fine > 3);
    CHECK(exact < 0.7);
}

TEST_CASE("fluids: what makes no sense gets a sentence") {
    const auto made = [](const auto& fluid) {
        return complaint([&] {
            solver mpm{uniform_grid{{0.}, {1.}, 1.}, linear{}};
            mpm.make_body(fluid, everywhere, per_cell{2});
        });
    };
    CHECK(names(made(tait{.bulk = 0, .density = 1}), "tait", "bulk modulus is 0", "positive"));
    CHECK(names(made(tait{.bulk = 1, .exponent = -1, .density = 1}), "tait", "exponent is -1", "positive"));
    CHECK(names(made(newtonian_fluid{{.bulk = 1, .density = 1}, -1}), "newtonian", "-1 and 0", "positive"));
    for (const double bad : {0., -1., double(NAN), double(INFINITY)}) {
        CAPTURE(bad);
        CHECK(names(made(tait{.bulk = bad, .density = 1}), "tait", "bulk modulus is", "positive"));
        CHECK(names(made(tait{.bulk = 1, .exponent = bad, .density = 1}), "tait", "exponent is", "water: 7"));
        CHECK(names(made(tait{.bulk = 1, .density = bad}), "tait", "the density is", "positive"));
    }
    // A particle's own density.
    solver mpm{uniform_grid{{0.}, {1.}, 1.}, linear{}};
    auto drop = mpm.make_body(tait{.bulk = 1, .density = 1}, everywhere, per_cell{2});
    auto oil = mpm.make_body(newtonian_fluid{{.bulk = 1, .density = 1}, 1}, everywhere, per_cell{2});
    for (const double bad : {0., -2., double(NAN)}) {
        CAPTURE(bad);
        for (auto p : drop) p[rho] = bad;
        for (auto p : oil) p[rho] = bad;
        CHECK(names(complaint([&] { mpm.step(bodies(drop), 1e-3); }), "particle 0", "its density is", "positive"));
        CHECK(names(complaint([&] { mpm.step(bodies(oil), 1e-3); }), "particle 0", "its density is", "positive"));
    }
    CHECK(
        names(made(newtonian_fluid{{.bulk = 1, .density = 1}, 1, 0, 2}), "newtonian", "density is 2", "leave it out"));
}
