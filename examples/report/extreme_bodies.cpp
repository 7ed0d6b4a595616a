#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include "shock_tube_run.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace tamis;
using namespace tamis::symbols;

/// A square of an almost incompressible solid between held walls, disturbed smoothly.
extreme_outcome nearly_incompressible(double nu) {
    const linear_elastic law{.young = 1, .poisson = nu, .density = 1};
    const fixed walls{[](const auto& at) { return at[0] <= 0 || at[0] >= 1 || at[1] <= 0 || at[1] >= 1; }};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.125}, quadratic_spline{}, flip{}, usl_minus{}, walls};
    auto square = mpm.make_body(law, everywhere, per_cell{2});
    // Without divergence: a vortex.
    set_velocity_of(square, [](const auto& at) {
        const double px = std::numbers::pi * at[0], py = std::numbers::pi * at[1];
        return point<2, double>(1e-3 * std::pow(std::sin(px), 2) * std::sin(2 * py),
                                -1e-3 * std::pow(std::sin(py), 2) * std::sin(2 * px));
    });
    const auto energy = [&] { return kinetic_energy(square) + elastic_energy(square); };
    const double before = energy();
    const long steps = integrate(mpm, bodies(square), interval{0, 2}, courant{0.4}, [](const warning&) {});
    const double change = energy() / before - 1;
    double largest = 0;
    for (const auto p : std::as_const(square)) largest = std::max(largest, p[v].norm());
    return {
        "Poisson's ratio " + std::to_string(nu).substr(0, 6) + ", 2D",
        "finite; energy does not grow; no speed above twice the start's",
        "energy " + short_number(change) + ", speed " + short_number(largest) + ", " + std::to_string(steps) + " steps",
        change < 0.01 && largest < 2e-3,
        "P waves are " + short_number(law.wave_speed(2)) +
            " m/s and set the step. The grid resolves a vortex of 8 cells badly, and locks: it loses energy."};
}

extreme_outcome spinning(const std::string& scheme_name, const auto& scheme, double share_kept) {
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
    return {
        "a square spins for 10 turns, " + scheme_name,
        "no more than " + short_number(100 * (1 - share_kept)) + " % of the angular momentum lost",
        failure.empty() ? short_number(kept) + " of it is left" : failure, kept > share_kept && kept < 1.01,
        "Forces act by the lumped mass, whose moment at the edge is another than theirs, and updates by S v lose a "
        "share of the rotation in every step (docs/open-questions.md, Rotation). There is no update here that keeps "
        "angular momentum (APIC does)."};
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
    return {{"nu", true, [] { return nearly_incompressible(0.4999); }},
            {"spin FLIP", false, [] { return spinning("FLIP", flip{}, 0.95); }},
            {"spin FMPM(8)", false, [] { return spinning("FMPM(8)", fmpm<dynamic>{8}, 0.95); }},
            {"strong shock", true, strong_shock},
            {"near vacuum", true, near_vacuum}};
}

std::vector<extreme_case> extreme_cases() {
    std::vector<extreme_case> all = extreme_bars();
    for (auto& one : extreme_bodies()) all.push_back(std::move(one));
    return all;
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}
