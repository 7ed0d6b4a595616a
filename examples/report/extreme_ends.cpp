#include "extreme_cases.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace tamis;
using namespace tamis::symbols;

extreme_outcome particle_on_node() {
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    std::string found;
    bool good = true;
    const double ulp = std::numeric_limits<double>::epsilon();
    for (const double place : {0.5, std::nextafter(0.5, 0.), std::nextafter(0.5, 1.), ulp, 0., 1 - ulp / 2, 1.}) {
        solver mpm{uniform_grid{{0.}, {1.}, 0.125}, quadratic_spline{}, flip{}, usl_minus{}, ends};
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

extreme_outcome stretched() {
    solver mpm{uniform_grid{{0.}, {64.}, 1.}, quadratic_spline{}, flip{}, usl_minus{}};
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

}  // namespace

std::vector<extreme_case> extreme_ends() {
    return {{"on a node", true, particle_on_node},
            {"light node", true, light_node},
            {"light node told", true, light_node_is_told},
            {"stretched", true, stretched}};
}
