#pragma once
#include <tamis/tamis.hpp>

#include <cmath>
#include <numbers>

/// A bar of two elastic materials, 0 <= x <= 1 m, that meet at 1/2. A pulse of velocity comes from the left, where
/// E = rho = 1 and c = 1; part of it goes on and part goes back.
struct two_bars {
    /// E and rho of the right half; its impedance is sqrt(E rho).
    double young = 100, density = 100;
    int cells = 400, per_cell = 2;
    double courant = 0.2, amplitude = 1e-4;

    double speed() const { return std::sqrt(young / density); }
    double impedance() const { return std::sqrt(young * density); }
    /// By theory, over the pulse's own amplitude.
    double reflected() const { return (1 - impedance()) / (1 + impedance()); }
    double transmitted() const { return 2 / (1 + impedance()); }
};

struct two_bars_result {
    double reflected = 0, transmitted = 0;  // amplitudes over that of the pulse, by least squares
    /// Largest velocity that neither pulse explains, over the pulse's amplitude: left and right.
    double rest_left = 0, rest_right = 0;
    double energy_gain = 0;  // relative
    long steps = 0;
};

/// The pulse of length 1/5, s from its tail to its head.
inline double pulse(double s) {
    const double part = std::sin(std::numbers::pi * s / 0.2);
    return s > 0 && s < 0.2 ? part * part : 0;
}

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
    result.steps = integrate(mpm, bodies(left, right), interval{0, end}, courant{set.courant});
    result.energy_gain = energy() / energy_before - 1;

    // Amplitude of a known shape, and what it does not explain.
    const auto fit = [&](const auto& bar, const auto& form, double& amplitude, double& rest) {
        double both = 0, square = 0;
        for (const auto p : bar) {
            const double f = form(p[x][0]);
            both += p[v][0] * f;
            square += f * f;
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
    return result;
}
