#pragma once
#include "two_bars.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>

/// Runs until both pulses are clear of the middle: the one that comes back is centred at 0.3.
template <class Shape, class Scheme, class Order, class Motion>
two_bars_result run_two_bars(const two_bars& set, const Shape& shape, const Scheme& scheme, const Order& order,
                             const Motion& motion) {
    using namespace tamis;
    using namespace tamis::symbols;
    const linear_elastic soft{.young = 1, .poisson = 0, .density = 1};
    const linear_elastic hard{.young = set.young, .poisson = 0, .density = set.density};
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / set.cells}, shape, scheme, order, motion, ends};
    auto left = mpm.make_body(
        soft, [](const auto& at) { return at[0] < 0.5; }, per_cell{set.per_cell});
    auto right = mpm.make_body(
        hard, [](const auto& at) { return at[0] > 0.5; }, per_cell{set.per_cell});
    // Its centre is at 0.3 when the run begins. A wave to the right has the strain -v/c.
    const auto start = [&](const auto& at) { return set.amplitude * pulse(at[0] - 0.2); };
    set_velocity_of(left, start);
    set_strain_of(left, [&](const auto& at) { return -start(at); });
    const auto energy = [&] {
        return kinetic_energy(left) + kinetic_energy(right) + elastic_energy(left) + elastic_energy(right);
    };
    two_bars_result result;
    const double energy_before = energy(), arrives = 0.2, end = 0.4;
    const auto clock = std::chrono::steady_clock::now();
    result.steps = integrate(mpm, bodies(left, right), interval{0, end}, courant{set.courant});
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    result.particle_count = left.size() + right.size();
    result.energy_gain = energy() / energy_before - 1;

    // Amplitude of a known shape, and what it does not explain.
    const auto fit = [&](const auto& bar, const auto& form, double& amplitude, double& rest) {
        double both = 0, square = 0;
        for (const auto p : bar) {
            const double part = form(p[x][0]);
            both += p[v][0] * part;
            square += part * part;
        }
        const double found = both / square;
        amplitude = found / set.amplitude;
        for (const auto p : bar) rest = std::max(rest, std::abs(p[v][0] - found * form(p[x][0])) / set.amplitude);
    };
    fit(
        std::as_const(left), [](double at) { return pulse(0.4 - at); }, result.reflected, result.rest_left);
    const double c = set.speed(), centre = 0.5 + c * (end - arrives);
    fit(
        std::as_const(right), [&](double at) { return pulse((at - centre) / c + 0.1); }, result.transmitted,
        result.rest_right);

    // Strains of waves to the right and to the left are -v/c and v/c.
    double velocity = 0, strain = 0, whole = 0;
    const auto compare = [&](const auto& bar, double young, double density, const auto& exact, double sign) {
        const double speed = std::sqrt(young / density);
        for (const auto p : bar) {
            const double v_exact = exact(p[x][0]), e_exact = sign * v_exact / speed;
            const double v_off = p[v][0] - v_exact, e_off = p[sigma](0, 0) / young - e_exact;
            velocity += density * p[V] * v_off * v_off;
            strain += young * p[V] * e_off * e_off;
            whole += density * p[V] * v_exact * v_exact + young * p[V] * e_exact * e_exact;
        }
    };
    compare(
        std::as_const(left), 1., 1., [&](double at) { return set.amplitude * set.reflected() * pulse(0.4 - at); }, 1.);
    compare(
        std::as_const(right), set.young, set.density,
        [&](double at) { return set.amplitude * set.transmitted() * pulse((at - centre) / c + 0.1); }, -1.);
    result.velocity_l2 = std::sqrt(2 * velocity / whole);
    result.strain_l2 = std::sqrt(2 * strain / whole);
    return result;
}
