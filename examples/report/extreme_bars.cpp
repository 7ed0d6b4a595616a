#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
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
    int cells = 20, per_cell = 2, k = 2;
    double courant = 0.1, periods = 1;
};
struct wave_answer {
    double energy_change = 0, velocity_error = 0;  // relative
    std::vector<double> velocities;                // in units of length/time, from left to right
    long steps = 0;
    double seconds = 0;
};

/// By linear functions, FMPM(k), USL- and held particles.
template <class Real> wave_answer run_wave(const wave& set) {
    const Real L = static_cast<Real>(set.length), h = L / static_cast<Real>(set.cells);
    // In one dimension a modulus is a force, and a density a mass per length.
    const linear_elastic law{.young = set.young * set.mass * set.length / (set.time * set.time),
                             .poisson = 0,
                             .density = set.density * set.mass / set.length};
    const fixed ends{[L](const auto& at) { return at[0] <= 0 || at[0] >= L; }};
    solver mpm{uniform_grid{{Real(0)}, {L}, h}, linear{}, fmpm<dynamic>{set.k}, ends, held{}};
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
    for (long n = 0; n < steps; ++n) mpm.step(bodies(bar), static_cast<Real>(dt));
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

extreme_outcome scales_exactly(const std::string& name, const wave& scaled, const std::string& what) {
    const wave_answer one = run_wave<double>({}), other = run_wave<double>(scaled);
    double largest = 0;
    bool same = true;
    for (std::size_t k = 0; k < one.velocities.size(); ++k) {
        const double difference = other.velocities[k] - one.velocities[k];
        largest = std::max(largest, std::abs(difference));
        same = same && difference == 0;
    }
    return {name, "velocities over their unit are the same, bit for bit",
            same ? "the same" : "off by " + short_number(largest), same, what};
}

/// Two bars end to end that a wave crosses: energy, and what comes back and goes on.
extreme_outcome two_bars(const std::string& name, double young, double density, int cells, double tolerance,
                         const std::string& why) {
    const linear_elastic soft{.young = 1, .poisson = 0, .density = 1};
    const linear_elastic hard{.young = young, .poisson = 0, .density = density};
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / cells}, linear{}, flip{}, ends, held{}};
    auto left = mpm.make_body(
        soft, [](const auto& at) { return at[0] < 0.5; }, per_cell{2});
    auto right = mpm.make_body(
        hard, [](const auto& at) { return at[0] > 0.5; }, per_cell{2});
    const auto pulse = [](const auto& at) {
        const double s = (at[0] - 0.1) / 0.2;
        return s > 0 && s < 1 ? 0.01 * std::pow(std::sin(std::numbers::pi * s), 2) : 0.;
    };
    set_velocity_of(left, pulse);
    set_strain_of(left, [&](const auto& at) { return -pulse(at); });
    const auto energy = [&] {
        return kinetic_energy(left) + kinetic_energy(right) + elastic_energy(left) + elastic_energy(right);
    };
    const double before = energy();
    // Its middle comes from 0.2 to the boundary at 0.3 s, and back to 0.3 at 0.5 s.
    const long steps = integrate(mpm, bodies(left, right), interval{0, 0.5}, courant{0.4});
    double both = 0, square = 0;
    for (const auto p : std::as_const(left)) {
        const double s = (0.4 - p[x][0]) / 0.2;
        const double form = s > 0 && s < 1 ? std::pow(std::sin(std::numbers::pi * s), 2) : 0;
        both += form * p[v][0];
        square += form * form;
    }
    const double impedance = std::sqrt(young * density), theory = (1 - impedance) / (1 + impedance);
    const double found = both / square / 0.01, change = energy() / before - 1;
    return {name,
            "amplitude that comes back " + short_number(theory) + " within " + short_number(tolerance) +
                "; energy within 1 %",
            short_number(found) + "; energy " + short_number(change) + "; " + std::to_string(steps) + " steps",
            std::abs(found - theory) < tolerance && std::abs(change) < 0.01, why};
}

extreme_outcome particle_on_node() {
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    std::string found;
    bool good = true;
    const double ulp = std::numeric_limits<double>::epsilon();
    for (const double place : {0.5, std::nextafter(0.5, 0.), std::nextafter(0.5, 1.), ulp, 0., 1 - ulp / 2, 1.}) {
        solver mpm{uniform_grid{{0.}, {1.}, 0.125}, quadratic_spline{}, flip{}, ends};
        auto bar = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0, .density = 1},
                                    std::vector<point<1, double>>{point<1, double>(place)}, 0.0625);
        const auto where = [&] { return (*std::as_const(bar).begin())[x][0]; };
        const double start = where();
        for (int n = 0; n < 100; ++n) mpm.step(bodies(bar), 0.05);
        good = good && where() == start && std::abs(start - place) <= ulp;
    }
    found = good ? "all 7 stay" : "one moved";
    return {"particle on a node, on a wall, and an ulp beside",
            "put there to an ulp of the box, and at rest it stays, exactly", found, good,
            "A place is kept as cell and offset, so that a point on a wall belongs to the cell inside."};
}

/// A free bar whose last particle reaches a node by `weight` only: growth of a rough start in `steps`.
template <class Order> double light_end(double weight, int k, double courant, long steps, const Order& order) {
    const double offset = 4.25 + weight;
    std::vector<point<1, double>> places;
    for (int p = 0; p < 16; ++p) places.push_back(point<1, double>(offset + (p + 0.5) / 2));
    solver mpm{uniform_grid{{0.}, {20.}, 1.}, linear{}, fmpm<dynamic>{k}, order, held{}};
    auto bar = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0, .density = 1}, places, 0.5);
    int number = 0;
    for (auto p : bar) p[v][0] = 1e-3 * std::sin(1 + 2.3 * number * number), ++number;
    const double before = kinetic_energy(bar);
    for (long n = 0; n < steps; ++n) {
        mpm.step(bodies(bar), courant);
        const double now = kinetic_energy(bar) + elastic_energy(bar);
        if (!(now < 1e12 * before)) return std::numeric_limits<double>::infinity();
    }
    return (kinetic_energy(bar) + elastic_energy(bar)) / before;
}

extreme_outcome light_node() {
    const double last = light_end(1e-6, 4, 0.2, 2000, usl_minus{}), plus = light_end(1e-6, 4, 0.2, 2000, usl_plus{});
    return {"node with 1e-6 of a particle's weight, FMPM(4), linear",
            "USL- grows and is warned of by integrate; USL+ does not grow",
            "USL- by " + short_number(last) + ", USL+ by " + short_number(plus), !(last < 1e6) && plus < 10,
            "USL- answers the force on the node with a velocity of the size of force over mass, and strains the "
            "particle by it at once. USL+ strains by velocities that particles had."};
}
/// What integrate says of it.
extreme_outcome light_node_is_told() {
    std::vector<point<1, double>> places;
    for (int p = 0; p < 16; ++p) places.push_back(point<1, double>(4.25 + 1e-6 + (p + 0.5) / 2));
    solver mpm{uniform_grid{{0.}, {20.}, 1.}, linear{}, fmpm<dynamic>{4}, usl_minus{}, held{}};
    auto bar = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0, .density = 1}, places, 0.5);
    std::vector<warning> told;
    integrate(mpm, bodies(bar), interval{0, 1}, courant{0.2}, [&](const warning& w) { told.push_back(w); });
    const bool one = told.size() == 1;
    return {"the same, by integrate", "one warning with composition, limit and cause",
            one ? told.front().sentence : std::to_string(told.size()) + " warnings",
            one && told.front().limit < 1e-3 && told.front().sentence.find("fmpm(4)") != std::string::npos,
            "Below the limit inside the body a step may be right, for a moving particle leaves such a place again."};
}

extreme_outcome many_per_cell(int per_cell) {
    wave set;
    set.per_cell = per_cell;
    set.k = per_cell == 1 ? 1 : 4;
    set.courant = 0.05;
    const wave_answer found = run_wave<double>(set);
    const bool damped = per_cell == 1;
    // One particle in the middle of a cell: FMPM(1) damps by design.
    return {std::to_string(per_cell) + " particles per cell",
            damped ? "finite, energy does not grow" : "velocity error below 1 %",
            "velocity error " + short_number(found.velocity_error) + ", energy " + short_number(found.energy_change),
            damped ? found.energy_change <= 1e-9 : found.velocity_error < 0.01,
            damped ? "FMPM(1) is PIC, which damps." : "More particles than the grid can see do no harm."};
}

extreme_outcome stretched() {
    solver mpm{uniform_grid{{0.}, {64.}, 1.}, quadratic_spline{}, flip{}};
    auto bar = mpm.make_body(
        linear_elastic{.young = 1, .poisson = 0, .density = 1}, [](const auto& at) { return at[0] > 28 && at[0] < 36; },
        per_cell{2});
    set_velocity_of(bar, [](const auto& at) { return 0.5 * (at[0] - 32); });
    const double momentum = total_momentum(bar)[0];
    integrate(mpm, bodies(bar), interval{0, 12}, courant{0.2}, [](const warning&) {});
    double largest = 0, low = 64, high = 0;
    for (const auto p : std::as_const(bar)) {
        largest = std::max(largest, std::abs(p[v][0]));
        low = std::min(low, p[x][0]);
        high = std::max(high, p[x][0]);
    }
    const double change = std::abs(total_momentum(bar)[0] - momentum);
    return {"a bar pulled to several times its length", "finite; momentum kept to 1e-12; no speed above the start's 2",
            "length 8 to " + short_number(high - low) + "; momentum " + short_number(change) + "; speed " +
                short_number(largest),
            std::isfinite(largest) && change < 1e-12 && largest < 2.1,
            "Where a cell between two particles is empty nothing pulls them together any more: numerical fracture, "
            "which is MPM's, not an error of the step."};
}

extreme_outcome high_order(int k) {
    wave set;
    set.k = k;
    set.courant = 0.1;
    const wave_answer found = run_wave<double>(set);
    return {"FMPM(" + std::to_string(k) + ")", "velocity error below 1 %, energy within 1 %",
            "velocity error " + short_number(found.velocity_error) + ", energy " + short_number(found.energy_change),
            found.velocity_error < 0.01 && std::abs(found.energy_change) < 0.01,
            "Increments lose no digits with k; sums with binomials would lose k log10(2)."};
}

extreme_outcome drift() {
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.125}, linear{}, fmpm<dynamic>{8}, ends, held{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .poisson = 0, .density = 1}, everywhere, per_cell{2});
    set_velocity_of(bar, [](const auto& at) { return 0.01 * std::sin(std::numbers::pi * at[0]); });
    const auto energy = [&] { return kinetic_energy(bar) + elastic_energy(bar); };
    const double before = energy();
    double least = 1, most = 1;
    for (int n = 0; n < 1000000; ++n) {
        mpm.step(bodies(bar), 0.2 / 8);
        if (n % 97 == 0) {
            const double now = energy() / before;
            least = std::min(least, now);
            most = std::max(most, now);
        }
    }
    return {"1e6 steps (12500 periods), FMPM(8)", "energy between 0.95 and 1.05 of the start's at all times",
            "between " + short_number(least) + " and " + short_number(most), least > 0.95 && most < 1.05,
            "A step loses (1 - lambda)^8 of the wave, lambda near 1 for waves that the grid resolves. FLIP loses 1e-3 "
            "of its energy in every period of so coarse a bar, and all of it in 12500."};
}

extreme_outcome float_against_double() {
    wave set;
    set.k = 4;
    const wave_answer wide = run_wave<double>(set), narrow = run_wave<float>(set);
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
        const double usual = run_wave<double>(normal).seconds;
        ratio = std::min(ratio, run_wave<double>(tiny).seconds / usual);
    }
    return {"denormal velocities (1e-312 m/s)", "the same run takes at most twice as long",
            "ratio " + short_number(ratio), ratio < 2,
            "Best of five pairs of runs, one after the other. The library does not switch denormals off: that is the "
            "program's choice (-ffast-math or the processor's register)."};
}

extreme_outcome huge_courant() {
    std::string sentence = "nothing";
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.125}, linear{}, flip{}, ends, held{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .poisson = 0, .density = 1}, everywhere, per_cell{2});
    try {
        integrate(mpm, bodies(bar), interval{0, 1}, courant{1e6});
    } catch (const error& e) {
        sentence = e.what();
    }
    return {"Courant number 1e6", "refused with a sentence that names composition and limit", sentence,
            sentence.find("linear, flip, usl-") != std::string::npos && sentence.find("limit") != std::string::npos,
            "The limit is the table's of critical Courant numbers."};
}
extreme_outcome tiny_courant(int k) {
    wave set;
    set.cells = 8;
    set.courant = 1e-4;
    set.periods = 0.25;
    set.k = k;
    const wave_answer found = run_wave<double>(set);
    return {"Courant number 1e-4, FMPM(" + std::to_string(k) + ")", "energy within 1 %, velocity error below 2 %",
            "energy " + short_number(found.energy_change) + ", velocity error " + short_number(found.velocity_error) +
                ", " + std::to_string(found.steps) + " steps",
            std::abs(found.energy_change) < 0.01 && found.velocity_error < 0.02,
            "FMPM(k) loses a share (1 - lambda)^k of a wave in every step, whatever its length: many tiny steps lose "
            "much where k is small. Smaller steps ask for a higher k, or FLIP."};
}

}  // namespace

std::vector<extreme_case> extreme_bars() {
    std::vector<extreme_case> all;
    const auto add = [&](const std::string& name, std::function<extreme_outcome()> run, bool quick = true) {
        all.push_back({name, quick, std::move(run)});
    };
    add(
        "modulus ratio",
        [] { return two_bars("modulus ratio 1e6", 1e6, 1, 100, 0.01, "The step is that of the faster bar."); }, false);
    add("density ratio", [] {
        return two_bars("density ratio 1e4", 1, 1e4, 200, 0.02,
                        "Waves in the heavy bar are 100 times slower, so what goes on is 0.4 of a cell long: the "
                        "grid does not resolve it, which costs 0.015 of what comes back.");
    });
    const auto scaled = [](double mass, double time, double length) {
        wave set;
        set.mass = mass;
        set.time = time;
        set.length = length;
        return set;
    };
    add("E small", [=] {
        return scales_exactly("modulus 2^-40 (1e-12) Pa, SI", scaled(1, 0x1p20, 1),
                              "All numbers are multiplied by powers of two.");
    });
    add("E large", [=] {
        return scales_exactly("modulus 2^40 (1e12) Pa, SI", scaled(1, 0x1p-20, 1),
                              "All numbers are multiplied by powers of two.");
    });
    add("tiny units", [=] {
        return scales_exactly("lengths of 2^-30 (1e-9) m, times of 2^-40 s, masses of 2^-60 kg",
                              scaled(0x1p-60, 0x1p-40, 0x1p-30), "All numbers are multiplied by powers of two.");
    });
    add("on a node", particle_on_node);
    add("light node", light_node);
    add("light node told", light_node_is_told);
    add("1 per cell", [] { return many_per_cell(1); });
    add("100 per cell", [] { return many_per_cell(100); });
    add("stretched", stretched);
    add("k 1000", [] { return high_order(1000); });
    add("drift", drift, false);
    add("float", float_against_double);
    add("denormals", denormal_speed, false);
    add("huge Courant", huge_courant);
    add("tiny Courant, FMPM(2)", [] { return tiny_courant(2); });
    add("tiny Courant, FMPM(8)", [] { return tiny_courant(8); });
    return all;
}
