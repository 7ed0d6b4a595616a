// What a step of FLIP does to the energy of a gas without ends: docs/gas.md, "Energy".
#include <tamis/tamis.hpp>

#include "catch.hpp"

#include <cmath>
#include <vector>

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct state {
    double x, v, m, V, tau, e;
};
template <class Body> std::vector<state> states_of(const Body& gas) {
    std::vector<state> all;
    for (const auto p : gas) all.push_back({p[x][0], p[v][0], p[m], p[V], p[sigma](0, 0), p[field::internal_energy{}]});
    return all;
}
double kinetic_of(const std::vector<state>& all) {
    double sum = 0;
    for (const state& p : all) sum += p.m * p.v * p.v / 2;
    return sum;
}

}  // namespace

TEST_CASE("energy of a gas: stress gives the particles what it takes, less what FLIP cannot see, to round-off") {
    constexpr int cells = 20;
    const double h = 1. / cells, dt = 0.1 * h;
    solver mpm{uniform_grid{{0.}, {1.}, h}, linear{}, flip{}, usl_minus{}};
    const artificial_viscosity q{.length = h};
    auto gas = mpm.make_body(
        shocked_gas{1.4, 1, 1, q}, [](const auto& at) { return at[0] > 0.3 && at[0] < 0.7; }, per_cell{3});
    set_velocity_of(gas, [](const auto& at) { return std::sin(40 * at[0]) - at[0]; });
    double lost = 0;
    for (int n = 0; n < 15; ++n) {
        const std::vector<state> before = states_of(std::as_const(gas));
        // The nodes' masses, momenta and forces by hand.
        std::vector<double> mass(cells + 1), momentum(cells + 1), force(cells + 1);
        const auto each_node = [&](const state& p, auto visit) {
            const auto i = static_cast<std::size_t>(p.x / h);
            const double w = p.x / h - static_cast<double>(i);
            visit(i, 1 - w, -1 / h);
            visit(i + 1, w, 1 / h);
        };
        for (const state& p : before)
            each_node(p, [&](std::size_t i, double w, double dw) {
                mass[i] += w * p.m;
                momentum[i] += w * p.m * p.v;
                force[i] -= dw * p.V * p.tau;
            });
        double work = 0, unseen = 0;
        for (std::size_t i = 0; i <= cells; ++i)
            if (mass[i] > 0) {
                const double gain = force[i] / mass[i];
                work += dt * force[i] * (momentum[i] / mass[i] + dt * gain / 2);
                unseen += dt * dt / 2 * mass[i] * gain * gain;
            }
        for (const state& p : before) {
            double felt = 0;
            each_node(p, [&](std::size_t i, double w, double) { felt += w * force[i] / mass[i]; });
            unseen -= dt * dt / 2 * p.m * felt * felt;
        }
        CHECK(unseen >= 0);
        mpm.step(bodies(gas), dt);
        const double gain = kinetic_energy(std::as_const(gas)) - kinetic_of(before);
        CHECK(std::abs(gain - (work - unseen)) < 1e-14);
        lost += unseen;
    }
    CHECK(lost > 1e-6);
}

TEST_CASE("energy of a fluid: what is left of the budget falls with the step") {
    // A closed tube rings. Without a pressure at rest, whose quadrature by moving particles makes noise that FLIP
    // damps.
    const auto off = [](const auto& order, double number) {
        const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
        solver mpm{uniform_grid{{0.}, {1.}, 0.02}, quadratic_spline{}, flip{}, order, ends};
        auto tube = mpm.make_body(tait{.bulk = 1.4, .exponent = 1.4, .density = 1}, everywhere, per_cell{2});
        set_velocity_of(tube, [](const auto& at) { return 0.01 * std::sin(std::acos(-1.) * at[0]); });
        const auto energy = [&] { return kinetic_energy(std::as_const(tube)) + elastic_energy(std::as_const(tube)); };
        const double start = energy();
        double most = 0;
        integrate(mpm, bodies(tube), {0, 0.6}, courant{number},
                  every(5, [&](double) { most = std::max(most, std::abs(energy() / start - 1)); }));
        CHECK(mpm.boundary_work() == 0);
        return most;
    };
    const double first = off(usl_minus{}, 0.2), half = off(usl_minus{}, 0.1);
    CAPTURE(first, half);
    CHECK(first / half > 1.7);
    CHECK(first < 0.02);
    const double averaged = off(usavg_minus{}, 0.2);
    CAPTURE(averaged);
    CHECK(averaged < 0.2 * first);
}
