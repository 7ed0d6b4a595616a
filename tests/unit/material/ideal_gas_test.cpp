#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/deform.hpp"

using namespace tamis;
using namespace tamis::symbols;

TEST_CASE("ideal gas: compressed without viscosity it keeps its entropy, and stores no more than its stress") {
    const ideal_gas gas{1.4, 1.2, 1e5};
    const auto check = [&](auto dimension) {
        constexpr int D = decltype(dimension)::value;
        for (const double d : {-0.1, 0.2}) {
            auto body = swell<held, D>(gas, d, 20, 0.1);
            using list = typename decltype(body)::field_list;
            STATIC_REQUIRE_FALSE(stores<list, field::internal_energy>);
            const auto p = *std::as_const(body).begin();
            const double J = std::pow(1 + D * d * 0.1, 20), V0 = 1;
            CHECK(std::abs(p[rho] * J / 1.2 - 1) < 1e-13);
            // tau = -p V/V0
            const double pressure = -p[sigma](0, 0) * V0 / J;
            CHECK(std::abs(pressure / std::pow(p[rho], 1.4) / (1e5 / std::pow(1.2, 1.4)) - 1) < 1e-12);
            CHECK(std::abs(elastic_energy(body) / (pressure * J / 0.4) - 1) < 1e-12);
            CHECK(std::abs(gas.wave_speed_at(p, D) / std::sqrt(1.4 * pressure / p[rho]) - 1) < 1e-12);
            if constexpr (D > 1) CHECK(p[sigma](0, 1) == 0);
        }
    };
    check(std::integral_constant<int, 1>{});
    check(std::integral_constant<int, 2>{});
    check(std::integral_constant<int, 3>{});
}

TEST_CASE("ideal gas: artificial viscosity acts in compression only, and its work is heat") {
    const artificial_viscosity q{.length = 0.3, .linear = 0.7, .quadratic = 1.3};
    const shocked_gas gas{1.4, 1.2, 1e5, q};
    for (const double d : {-40., 40.}) {
        const double dt = 1e-3;
        auto body = swell<held, 2>(gas, d, 1, dt);
        const auto p = *std::as_const(body).begin();
        const double rate = 2 * d, J = 1 + rate * dt, e0 = 1e5 / (0.4 * 1.2);
        const double c = std::sqrt(1.4 * 0.4 * e0);
        const double q_by_density =
            d < 0 ? std::pow(1.3 * 0.3 * rate, 2) + 0.7 * 0.3 * std::abs(rate) * c : 0;  // q/rho
        const double e = e0 * std::pow(J, -0.4) - q_by_density * rate * dt;
        CHECK(std::abs(p[field::internal_energy{}] / e - 1) < 1e-13);
        CHECK(std::abs(p[sigma](1, 1) / (-1.2 * (0.4 * e + q_by_density)) - 1) < 1e-13);
        CHECK((p[field::internal_energy{}] > (1 + 1e-12) * e0 * std::pow(J, -0.4)) == (d < 0));
        CHECK(std::abs(elastic_energy(body) / (1.2 * e) - 1) < 1e-13);
        // Sound follows what the viscosity heated.
        CHECK(std::abs(gas.energy_per_mass(p) / e - 1) < 1e-13);
        CHECK(std::abs(gas.wave_speed_at(p, 2) / std::sqrt(1.4 * 0.4 * e) - 1) < 1e-13);
        CHECK(std::abs(detail::wave_speed_of(std::as_const(body)) / std::sqrt(1.4 * 0.4 * e) - 1) < 1e-13);
    }
}

TEST_CASE("ideal gas: sound travels at the speed that the law tells") {
    const ideal_gas gas{1.4, 1, 1};
    const double c = std::sqrt(1.4), pi = std::acos(-1.), amplitude = 1e-5;
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.01}, quadratic_spline{}, fmpm<2>{}, ends};
    auto tube = mpm.make_body(gas, everywhere, per_cell{2});
    set_velocity_of(tube, [&](const auto& at) { return amplitude * std::sin(pi * at[0]); });
    const double start = elastic_energy(tube);
    integrate(mpm, bodies(tube), {0, 1 / c}, courant{0.2});
    // Half a period: the velocity is the first one's opposite.
    double most = 0;
    for (const auto p : std::as_const(tube))
        most = std::max(most, std::abs(p[v][0] + amplitude * std::sin(pi * p[x][0])));
    CHECK(most < 5e-3 * amplitude);
    CHECK(std::abs(elastic_energy(tube) - start) < 1e-9);
}

TEST_CASE("ideal gas: what makes no sense gets a sentence") {
    const uniform_grid grid{{0.}, {1.}, 0.1};
    const auto made = [&](const auto& gas) {
        return complaint([&] {
            solver mpm{grid, linear{}};
            mpm.make_body(gas, everywhere, per_cell{2});
        });
    };
    CHECK(names(made(ideal_gas{1, 1, 1}), "ideal_gas", "gamma is 1", "above 1"));
    CHECK(names(made(ideal_gas{1.4, 0, 1}), "ideal_gas", "density is 0", "positive"));
    CHECK(names(made(ideal_gas{1.4, 1, -1}), "ideal_gas", "pressure is -1", "positive"));
    CHECK(names(made(shocked_gas{1.4, 1, 1, {.length = 0}}), "artificial_viscosity", "length is 0", "spacing"));
    CHECK(names(made(shocked_gas{1.4, 1, 1, {.length = 1, .linear = -1}}), "artificial_viscosity", "-1"));

    solver mpm{grid, linear{}};
    auto tube = mpm.make_body(shocked_gas{1.4, 1, 1, {.length = 0.1}}, everywhere, per_cell{2});
    for (auto p : tube) p[field::internal_energy{}] = -1;
    CHECK(names(complaint([&] { mpm.step(bodies(tube), 1e-3); }), "particle 0", "internal energy is -1", "positive"));
}
