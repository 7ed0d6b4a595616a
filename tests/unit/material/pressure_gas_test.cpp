#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/deform.hpp"

using namespace tamis;
using namespace tamis::symbols;

TEST_CASE("pressure gas: along a particle that moves, p J^gamma is kept, also at constant temperature") {
    for (const double gamma : {1., 1.4})
        for (const double d : {-0.1, 0.2}) {
            const pressure_gas gas{gamma, 1.2, 1e5, 3e4};
            const auto body = swell<moving, 2>(gas, d, 4, 0.1);
            STATIC_REQUIRE_FALSE(decltype(body)::needs_flow);
            const auto p = *body.begin();
            const double J = std::pow(1 + 2 * d * 0.1, 4), now = 1e5 * std::pow(J, -gamma);
            CHECK(std::abs(p[field::pressure{}] / now - 1) < 1e-13);
            CHECK(std::abs(p[sigma](0, 0) / ((3e4 - now) * J) - 1) < 1e-12);
            CHECK(p[sigma](0, 1) == 0);
            // The work of p - ambient from 1 to J, by a fine sum.
            double work = 0;
            const int n = 2000;
            for (int k = 0; k < n; ++k)
                work -= (1e5 * std::pow(1 + (J - 1) * (k + 0.5) / n, -gamma) - 3e4) * (J - 1) / n;
            CHECK(std::abs(elastic_energy(body) / work - 1) < 1e-6);
        }
}

TEST_CASE("pressure gas: at a fixed point the flow carries pressure past it; ADMPM's says so of moving ones too") {
    // One cell, particles at 1/4 and 3/4: the nodes' means of pressure are by hand.
    const auto check = [](const auto& gas, auto motion) {
        const double left = -0.3, right = 0.5, dt = 0.01, p1 = 1.1, p2 = 0.7, gamma = gas.gamma;
        const auto drive = prescribed{everywhere, [=](const auto& at, auto) {
                                          auto speed = (at * 0).eval();
                                          speed[0] = at[0] < 0.5 ? left : right;
                                          return speed;
                                      }};
        solver mpm{uniform_grid{{0.}, {1.}, 1.}, linear{}, flip{}, usl_minus{}, motion, drive};
        using place = point<1, double>;
        auto body = mpm.make_body_at(gas, {place::Constant(0.25), place::Constant(0.75)}, 0.5);
        STATIC_REQUIRE(decltype(body)::needs_flow);
        for (auto p : body) p[field::pressure{}] = p[x][0] < 0.5 ? p1 : p2;
        // A copy has scratch of its own.
        auto copy = body;
        mpm.step(bodies(body), dt);
        mpm.step(bodies(copy), dt);
        const double at_left = 0.75 * p1 + 0.25 * p2, at_right = 0.25 * p1 + 0.75 * p2;
        const double slope = at_right - at_left, flux = right * at_right - left * at_left;
        for (const auto* one : {&body, &copy})
            for (const auto p : *one) {
                const bool first = p[x][0] < 0.5;
                // Both steps strain by the nodes' velocities, which are given.
                const double speed = first ? 0.75 * left + 0.25 * right : 0.25 * left + 0.75 * right;
                const double now = (first ? p1 : p2) + dt * ((gamma - 1) * speed * slope - gamma * flux);
                CHECK(std::abs(p[field::pressure{}] / now - 1) < 1e-14);
                CHECK(std::abs(p[sigma](0, 0) - (0.2 - now)) < 1e-14);
            }
    };
    check(pressure_gas{1.4, 1, 1, 0.2}, held{});
    check(pressure_gas{1, 1, 1, 0.2}, held{});
    check(admpm_gas{1.4, 1, 1, 0.2}, moving{});

    // Uniform pressure: v . grad p = 0, and the rate is -gamma p div v.
    matrix<2, double> shear;
    shear << 0.1, 0.7, -0.2, 0.3;
    const auto body = deform<held>(pressure_gas{1.4, 1, 2, 2}, shear, 1, 0.1);
    CHECK(std::abs((*body.begin())[field::pressure{}] / (2 - 0.1 * 1.4 * 2 * 0.4) - 1) < 1e-14);
}

TEST_CASE("pressure gas: what makes no sense gets a sentence") {
    const auto made = [](const pressure_gas& gas) {
        return complaint([&] {
            solver mpm{uniform_grid{{0.}, {1.}, 1.}, linear{}};
            mpm.make_body(gas, everywhere, per_cell{2});
        });
    };
    CHECK(names(made({0.9, 1, 1}), "pressure_gas", "gamma is 0.9", "give 1"));
    CHECK(names(made({1, 0, 1}), "pressure_gas", "density is 0", "positive"));
    CHECK(names(made({1, 1, 0}), "pressure_gas", "pressure is 0", "positive"));
    CHECK(names(made({1, 1, 1, NAN}), "pressure_gas", "ambient", "finite"));

    solver mpm{uniform_grid{{0.}, {1.}, 1.}, linear{}};
    auto body = mpm.make_body(pressure_gas{1, 1, 1}, everywhere, per_cell{2});
    for (auto p : body) p[field::pressure{}] = -1;
    CHECK(names(complaint([&] { mpm.step(bodies(body), 1e-3); }), "particle 0", "pressure is -1", "positive"));

    // A step that empties a fixed point, p' = p (1 - 1.4): `integrate` asks the law.
    const auto swelling = prescribed{everywhere, [](const auto& at, auto) { return at.eval(); }};
    solver still{uniform_grid{{0.}, {1.}, 1.}, linear{}, held{}, swelling};
    auto point = still.make_body(pressure_gas{1.4, 1, 1}, everywhere, per_cell{1});
    const auto run = [&] { integrate(still, bodies(point), {0, 1}, fixed_steps{1, 10}); };
    CHECK(names(complaint(run), "particle 0", "step 1", "pressure is -0.4", "steps short enough"));
}
