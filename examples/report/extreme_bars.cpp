#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tamis;
using namespace tamis::symbols;

/// Two bars end to end that a wave crosses: energy, and what comes back and goes on.
extreme_outcome two_bars(const std::string& name, double young, double density, int cells, double tolerance,
                         const std::string& why) {
    const linear_elastic soft{.young = 1, .poisson = 0, .density = 1};
    const linear_elastic hard{.young = young, .poisson = 0, .density = density};
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / cells}, linear{}, flip{}, usl_minus{}, ends, held{}};
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

extreme_outcome huge_courant() {
    std::string sentence = "nothing";
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.125}, linear{}, flip{}, usl_minus{}, ends, held{}};
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

}  // namespace

std::vector<extreme_case> extreme_bars() {
    const auto density = [](int cells, const std::string& why) {
        return two_bars("density ratio 1e4, " + std::to_string(cells) + " cells", 1, 1e4, cells, 0.01, why);
    };
    return {{"modulus ratio", false,
             [] { return two_bars("modulus ratio 1e6", 1e6, 1, 100, 0.01, "The step is that of the faster bar."); }},
            {"density ratio", true,
             [=] {
                 return density(
                     200,
                     "Waves in the heavy bar are 100 times slower: what goes on is 0.002 long, 0.4 of a cell, and the "
                     "grid cannot show it. Smaller steps change nothing.");
             }},
            {"density ratio, fine", false, [=] { return density(2000, "What goes on is 4 cells long."); }},
            {"huge Courant", true, huge_courant}};
}
