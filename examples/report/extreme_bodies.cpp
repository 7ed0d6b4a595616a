#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include "shock_tube_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace tamis;
using namespace tamis::symbols;

/// A square of an elastic solid between held walls, in which a vortex is started: a motion without divergence.
template <class Order> extreme_outcome vortex(double nu, int cells, const Order& order, const std::string& order_name,
                                              const std::string& why) {
    const linear_elastic law{.young = 1, .poisson = nu, .density = 1};
    const fixed walls{[](const auto& at) { return at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1; }};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 1. / cells}, quadratic_spline{}, flip{}, order, walls};
    auto square = mpm.make_body(law, everywhere, per_cell{2});
    set_velocity_of(square, [](const auto& at) {
        const double px = std::numbers::pi * at[0], py = std::numbers::pi * at[1];
        return point<2, double>(1e-3 * std::pow(std::sin(px), 2) * std::sin(2 * py),
                                -1e-3 * std::pow(std::sin(py), 2) * std::sin(2 * px));
    });
    const auto energy = [&] { return kinetic_energy(square) + elastic_energy(square); };
    const double before = energy();
    const long steps = integrate(mpm, bodies(square), interval{0, 2}, courant{0.4});
    const double change = energy() / before - 1;
    double largest = 0;
    for (const auto p : std::as_const(square)) largest = std::max(largest, p[v].norm());
    return {
        "Poisson's ratio " + std::to_string(nu).substr(0, 6) + ", 2D, FLIP, " + order_name + ", " +
            std::to_string(cells) + " cells",
        "energy within 1 %; no speed above twice the start's",
        "energy " + short_number(change) + ", speed " + short_number(largest) + ", " + std::to_string(steps) + " steps",
        std::abs(change) < 0.01 && largest < 2e-3, why};
}

extreme_outcome spinning(const std::string& scheme_name, const auto& scheme, const std::string& why) {
    const neo_hookean law{.young = 1, .poisson = 0.3, .density = 1};
    solver mpm{uniform_grid{{0., 0.}, {16., 16.}, 1.}, quadratic_spline{}, scheme, usavg_plus{}};
    auto square = mpm.make_body(
        law, [](const auto& at) { return std::abs(at[0] - 8) < 4 && std::abs(at[1] - 8) < 4; }, per_cell{2});
    const double omega = 0.05;
    set_velocity_of(square,
                    [&](const auto& at) { return point<2, double>(-omega * (at[1] - 8), omega * (at[0] - 8)); });
    const auto spin = [&] {
        return sum_over(square,
                        [](const auto& p) { return p[m] * ((p[x][0] - 8) * p[v][1] - (p[x][1] - 8) * p[v][0]); });
    };
    const double before = spin();
    std::string failure;
    try {
        integrate(mpm, bodies(square), interval{0, 10 * 2 * std::numbers::pi / omega}, courant{0.4},
                  [](const warning&) {});
    } catch (const error& e) {
        failure = e.what();
    }
    const double kept = failure.empty() ? spin() / before : 0;
    return {"a square spins for 10 turns, " + scheme_name, "no more than 5 % of the angular momentum lost",
            failure.empty() ? short_number(kept) + " of it is left" : failure, kept > 0.95 && kept < 1.01, why};
}

extreme_outcome strong_shock() {
    tube set;
    set.left = {1, 0, 1e5};
    set.right = {1, 0, 1};
    set.time = 0.2 / std::sqrt(1e5);
    const tube_result found = shock_tube::run<quadratic_spline>(set, flip{}, usavg_minus{});
    // Means over the middle half of what lies between contact and shock.
    const riemann::solution exact(set.gamma, set.left, set.right);
    const double from = 0.5 + exact.velocity() * set.time, to = 0.5 + exact.right_front() * set.time;
    double pressure = 0, velocity = 0, count = 0;
    for (const auto& p : found.particles)
        if (p.x > from + 0.25 * (to - from) && p.x < to - 0.25 * (to - from)) {
            pressure += p.pressure;
            velocity += p.velocity;
            count += 1;
        }
    pressure = pressure / count / exact.pressure() - 1;
    velocity = velocity / count / exact.velocity() - 1;
    return {"shock of pressure ratio 1e5", "pressure and velocity behind it within 2 %",
            "pressure " + short_number(pressure) + ", velocity " + short_number(velocity),
            std::abs(pressure) < 0.02 && std::abs(velocity) < 0.02, "With artificial viscosity 0.5 and 2."};
}

extreme_outcome near_vacuum() {
    tube set;
    set.left = {1, 0, 1};
    set.right = {1e-6, 0, 1e-6};
    set.time = 0.1;
    const tube_result found = shock_tube::run<quadratic_spline>(set, flip{}, usavg_minus{});
    double least = 1e300;
    for (const auto& p : found.particles) least = std::min({least, p.density, p.energy});
    const double change = found.energy_end / found.energy_start - 1;
    return {"gas beside one of 1e-6 of its density and pressure", "densities and energies positive; energy within 1 %",
            "least " + short_number(least) + ", energy " + short_number(change), least > 0 && std::abs(change) < 0.01,
            "A gas that expands into next to nothing pulls its own particles apart."};
}

}  // namespace

std::vector<extreme_case> extreme_bodies() {
    const std::string loss =
        "FLIP with USL- takes the share A (w dt)^2 of every wave's energy in a step (docs/stability.md, Energy over "
        "many "
        "steps): of this vortex at Poisson's ratio 0.3, of the P waves that come with it on so coarse a grid at "
        "0.4999. "
        "Locking costs no energy: USAVG+ keeps it.";
    const std::string kept = "Strained by what particles have, every wave keeps its energy.";
    const std::string no_update_keeps_it =
        " No update here keeps angular momentum (APIC does); docs/open-questions.md, Rotation.";
    return {{"nu 0.4999, USL-", true, [=] { return vortex(0.4999, 8, usl_minus{}, "USL-", loss); }},
            {"nu 0.3, USL-", true, [=] { return vortex(0.3, 8, usl_minus{}, "USL-", loss); }},
            {"nu 0.4999, USAVG+", true, [=] { return vortex(0.4999, 8, usavg_plus{}, "USAVG+", kept); }},
            {"nu 0.3, USAVG+", true, [=] { return vortex(0.3, 8, usavg_plus{}, "USAVG+", kept); }},
            {"nu 0.4999, fine", false,
             [] {
                 return vortex(0.4999, 32, usl_minus{}, "USL-",
                               "Finer grids have a smaller A, and the vortex brings less of the P waves.");
             }},
            {"spin FLIP", true,
             [=] {
                 return spinning("FLIP", flip{},
                                 "Forces act by the lumped mass, whose moment at the edge is another than theirs. That "
                                 "costs 10 % in the first turn, at Courant numbers of 0.4 and 0.1 alike; 1.6 % with 16 "
                                 "cells and 0.3 % with 32." +
                                     no_update_keeps_it);
             }},
            {"spin FMPM(8)", false,
             [=] {
                 return spinning("FMPM(8)", fmpm<dynamic>{8},
                                 "Updates by S v lose a share of the rotation at the edge in every step, smaller steps "
                                 "more of it: what is left after the first turn is 0.77 at a Courant number of 0.3 and "
                                 "0.48 at 0.1." +
                                     no_update_keeps_it);
             }},
            {"strong shock", true, strong_shock},
            {"near vacuum", true, near_vacuum}};
}
