#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tamis;
using namespace tamis::symbols;

/// Standing wave of a bar between held ends, in given units of length, time and mass.
struct wave {
    double length = 1, time = 1, mass = 1;  // units
    double young = 1, density = 1, amplitude = 0.01;
    int cells = 20, per_cell = 2;
    double courant = 0.1, periods = 1;
    long look_every = 0;  // at the energy, in steps; 0: at the end only
};
struct wave_answer {
    double energy_change = 0, velocity_error = 0;  // relative
    double least_energy = 1, most_energy = 1;      // over the start's
    std::vector<double> velocities;                // in units of length/time, from left to right
    long steps = 0;
    double seconds = 0;
};

/// By linear functions and held particles.
template <class Real, class Scheme, class Order = usl_minus>
wave_answer run_wave(const wave& set, const Scheme& scheme, const Order& order = {}) {
    const Real L = static_cast<Real>(set.length), h = L / static_cast<Real>(set.cells);
    // In one dimension a modulus is a force, and a density a mass per length.
    const linear_elastic law{.young = set.young * set.mass * set.length / (set.time * set.time),
                             .poisson = 0,
                             .density = set.density * set.mass / set.length};
    const fixed ends{[L](const auto& at) { return at[0] <= 0 || at[0] >= L; }};
    solver mpm{uniform_grid{{Real(0)}, {L}, h}, linear{}, scheme, order, ends, held{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{set.per_cell});
    const double c = std::sqrt(set.young / set.density), speed = set.amplitude * set.length / set.time;
    set_velocity_of(bar, [&](const auto& at) {
        return static_cast<Real>(speed * std::sin(std::numbers::pi * (static_cast<double>(at[0]) / set.length)));
    });
    const auto energy = [&] { return static_cast<double>(kinetic_energy(bar) + elastic_energy(bar)); };
    const double before = energy(), end = set.periods * 2 / c;
    const auto steps = static_cast<long>(std::ceil(end * c * set.cells / set.courant - 1e-9));
    const double dt = end / static_cast<double>(steps) * set.time;
    wave_answer answer;
    const auto clock = std::chrono::steady_clock::now();
    for (long n = 1; n <= steps; ++n) {
        mpm.step(bodies(bar), static_cast<Real>(dt));
        if (set.look_every > 0 && n % set.look_every == 0) {
            const double now = energy() / before;
            answer.least_energy = std::min(answer.least_energy, now);
            answer.most_energy = std::max(answer.most_energy, now);
        }
    }
    answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    answer.steps = steps;
    answer.energy_change = energy() / before - 1;
    double error = 0, count = 0;
    std::vector<std::pair<double, double>> by_place;
    const double factor = std::cos(std::numbers::pi * c * end);
    for (const auto p : std::as_const(bar)) {
        const double v_now = static_cast<double>(p[v][0]) / (set.length / set.time);
        const double exact =
            set.amplitude * std::sin(std::numbers::pi * (static_cast<double>(p[x][0]) / set.length)) * factor;
        error += (v_now - exact) * (v_now - exact);
        count += 1;
        by_place.emplace_back(static_cast<double>(p[x][0]), v_now);
    }
    // How particles are stored depends on the number of lanes.
    std::sort(by_place.begin(), by_place.end());
    for (const auto& one : by_place) answer.velocities.push_back(one.second);
    answer.velocity_error = std::sqrt(error / count) / set.amplitude;
    return answer;
}
template <class Real> wave_answer run_wave(const wave& set, int k) { return run_wave<Real>(set, fmpm<dynamic>{k}); }

/// Why FLIP loses energy, or not (docs/stability.md, Energy over many steps).
const std::string flip_and_usl_minus =
    "Particles take of a force's change of the nodes' velocity only what they and the nodes both see; USL- strains by "
    "all of it, so that a step takes the share A (w dt)^2 of a wave's energy, A = 0.029 here: 1.4 % in a period. "
    "USAVG- loses "
    "half of that, and orders that strain by what particles have (USF, USL+, USAVG+) nothing.";
const std::string flip_keeps =
    "A wave that is strained by what particles have keeps its energy: the step's determinant is 1. With USL+ it goes "
    "up and down with the wave, by half of w dt.";
const std::string fmpm_loss =
    "FMPM(k) takes the share A^k of a wave's energy in every step, whatever the step's length; A = 0.029 here";

extreme_outcome scales_exactly(const std::string& name, double mass, double time, double length) {
    wave scaled;
    scaled.mass = mass;
    scaled.time = time;
    scaled.length = length;
    const wave_answer one = run_wave<double>({}, 2), other = run_wave<double>(scaled, 2);
    double largest = 0;
    bool same = true;
    for (std::size_t k = 0; k < one.velocities.size(); ++k) {
        const double difference = other.velocities[k] - one.velocities[k];
        largest = std::max(largest, std::abs(difference));
        same = same && difference == 0;
    }
    return {name, "velocities over their unit are the same, bit for bit",
            same ? "the same" : "off by " + short_number(largest), same,
            "All numbers are multiplied by powers of two."};
}

template <class Scheme>
extreme_outcome per_cell_of(int per_cell, const std::string& name, const Scheme& scheme, const std::string& why) {
    wave set;
    set.per_cell = per_cell;
    set.courant = 0.05;
    const wave_answer found = run_wave<double>(set, scheme);
    return {std::to_string(per_cell) + " per cell, " + name, "velocity error below 1 %, energy within 1 %",
            "velocity error " + short_number(found.velocity_error) + ", energy " + short_number(found.energy_change),
            found.velocity_error < 0.01 && std::abs(found.energy_change) < 0.01, why};
}

extreme_outcome all_orders() {
    const wave set;
    double worst_error = 0, worst_energy = 0;
    int worst_k = 0, worst_energy_k = 0;
    for (const int k : {2, 3, 4, 5, 8, 10, 16, 20, 32, 50, 64, 100, 128, 200, 256, 500, 512, 1000}) {
        const wave_answer found = run_wave<double>(set, k);
        // A NaN is the worst.
        if (!(found.velocity_error <= worst_error)) worst_error = found.velocity_error, worst_k = k;
        if (!(std::abs(found.energy_change) <= worst_energy))
            worst_energy = std::abs(found.energy_change), worst_energy_k = k;
    }
    return {"FMPM(k), 18 values of k from 2 to 1000", "velocity error below 1 %, energy within 1 %, for each",
            "worst velocity error " + short_number(worst_error) + " (k = " + std::to_string(worst_k) +
                "), energy off by at most " + short_number(worst_energy) + " (k = " + std::to_string(worst_energy_k) +
                ")",
            worst_error < 0.01 && worst_energy < 0.01,
            "Increments lose no digits with k; sums with binomials would lose k log10(2)."};
}
extreme_outcome first_order() {
    const wave_answer found = run_wave<double>({}, 1);
    return {"FMPM(1), the same wave", "velocity error below 1 %, energy within 1 %",
            "velocity error " + short_number(found.velocity_error) + ", energy " + short_number(found.energy_change),
            found.velocity_error < 0.01 && std::abs(found.energy_change) < 0.01,
            "FMPM(1) is PIC, which damps by design: a step takes the share A of a wave's energy."};
}

/// 1e6 steps of a bar of 8 cells.
template <class Scheme, class Order>
extreme_outcome drift(const std::string& name, const Scheme& scheme, const Order& order, const std::string& why) {
    wave set;
    set.cells = 8;
    set.courant = 0.2;
    set.periods = 12500;
    set.look_every = 97;
    const wave_answer found = run_wave<double>(set, scheme, order);
    return {"1e6 steps (12500 periods), " + name, "energy between 0.95 and 1.05 of the start's at all times",
            "between " + short_number(found.least_energy) + " and " + short_number(found.most_energy),
            found.least_energy > 0.95 && found.most_energy < 1.05, why};
}

extreme_outcome float_against_double() {
    const wave set;
    const wave_answer wide = run_wave<double>(set, 4), narrow = run_wave<float>(set, 4);
    double largest = 0;
    for (std::size_t k = 0; k < wide.velocities.size(); ++k)
        largest = std::max(largest, std::abs(wide.velocities[k] - narrow.velocities[k]) / set.amplitude);
    return {"float against double, FMPM(4)", "differ by less than 1e-4 of the amplitude after 400 steps",
            short_number(largest), largest < 1e-4 && largest > 0, "Round-off of 6e-8 a step, of random sign."};
}

extreme_outcome denormal_speed() {
    wave normal, tiny;
    normal.periods = tiny.periods = 20;
    tiny.amplitude = 1e-312;
    double ratio = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < 5; ++attempt) {
        const double usual = run_wave<double>(normal, 2).seconds;
        ratio = std::min(ratio, run_wave<double>(tiny, 2).seconds / usual);
    }
    return {"denormal velocities (1e-312 m/s)", "the same run takes at most twice as long",
            "ratio " + short_number(ratio), ratio < 2,
            "Best of five pairs of runs, one after the other. The library does not switch denormals off: that is the "
            "program's choice (-ffast-math or the processor's register)."};
}

template <class Scheme>
extreme_outcome tiny_courant(const std::string& name, const Scheme& scheme, const std::string& why) {
    wave set;
    set.cells = 8;
    set.courant = 1e-4;
    set.periods = 0.5;
    const wave_answer found = run_wave<double>(set, scheme);
    return {"Courant number 1e-4, " + name, "energy within 1 %, velocity error below 2 %",
            "energy " + short_number(found.energy_change) + ", velocity error " + short_number(found.velocity_error) +
                ", " + std::to_string(found.steps) + " steps",
            std::abs(found.energy_change) < 0.01 && found.velocity_error < 0.02, why};
}

}  // namespace

std::vector<extreme_case> extreme_waves() {
    std::vector<extreme_case> all;
    const auto add = [&](const std::string& name, bool quick, std::function<extreme_outcome()> run) {
        all.push_back({name, quick, std::move(run)});
    };
    add("E small", true, [] { return scales_exactly("modulus 2^-40 (1e-12) Pa, SI", 1, 0x1p20, 1); });
    add("E large", true, [] { return scales_exactly("modulus 2^40 (1e12) Pa, SI", 1, 0x1p-20, 1); });
    add("tiny units", true, [] {
        return scales_exactly("lengths of 2^-30 (1e-9) m, times of 2^-40 s, masses of 2^-60 kg", 0x1p-60, 0x1p-40,
                              0x1p-30);
    });
    add("1 per cell, FLIP", true,
        [] { return per_cell_of(1, "FLIP", flip{}, "A particle in each cell's middle sees all of a smooth wave."); });
    add("1 per cell, FMPM(4)", true, [] {
        return per_cell_of(1, "FMPM(4)", fmpm<dynamic>{4},
                           "The full mass matrix is singular (no particle sees velocities of 1, -1, 1, ... at the "
                           "nodes), but a smooth wave has no part of that.");
    });
    add("100 per cell", true, [] {
        return per_cell_of(100, "FMPM(4)", fmpm<dynamic>{4}, "More particles than the grid can see do no harm.");
    });
    add("k 1", true, first_order);
    add("k 2 to 1000", true, all_orders);
    add("drift, FLIP USL-", true, [] { return drift("FLIP, USL-", flip{}, usl_minus{}, flip_and_usl_minus); });
    add("drift, FLIP USAVG-", false, [] { return drift("FLIP, USAVG-", flip{}, usavg_minus{}, flip_and_usl_minus); });
    add("drift, FLIP USF", false, [] { return drift("FLIP, USF", flip{}, usf{}, flip_keeps); });
    add("drift, FLIP USL+", false, [] { return drift("FLIP, USL+", flip{}, usl_plus{}, flip_keeps); });
    add("drift, FLIP USAVG+", true, [] { return drift("FLIP, USAVG+", flip{}, usavg_plus{}, flip_keeps); });
    add("drift, FMPM(4)", false, [] {
        return drift("FMPM(4), USL-", fmpm<dynamic>{4}, usl_minus{},
                     fmpm_loss + ", A^4 = 7e-7, and there are 1e6 steps.");
    });
    add("drift, FMPM(8)", true, [] {
        return drift("FMPM(8), USL-", fmpm<dynamic>{8}, usl_minus{},
                     fmpm_loss + ", A^8 = 5e-13. The energy goes up and down with the wave, by half of w dt.");
    });
    add("float", true, float_against_double);
    add("denormals", false, denormal_speed);
    add("tiny Courant, FMPM(2)", true, [] {
        return tiny_courant(
            "FMPM(2)", fmpm<dynamic>{2},
            fmpm_loss + ": many tiny steps lose much where k is small. Smaller steps ask for a higher k, or FLIP.");
    });
    add("tiny Courant, FMPM(8)", true,
        [] { return tiny_courant("FMPM(8)", fmpm<dynamic>{8}, fmpm_loss + ", A^8 = 5e-13."); });
    add("tiny Courant, FLIP", true,
        [] { return tiny_courant("FLIP", flip{}, "What FLIP loses falls with the step."); });
    return all;
}
