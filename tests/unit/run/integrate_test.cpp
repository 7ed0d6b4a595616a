#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;
using Catch::Matchers::WithinAbs;

namespace {

using grid = uniform_grid<1, double>;
const grid line{{0.}, {1.}, 0.25};
/// Waves of speed 2: a Courant number of 1 is a time step of 1/8.
const linear_elastic law{.young = 4, .poisson = 0, .density = 1};

/// A bar of particles that are held, at rest.
struct scene {
    solver<grid, linear, usl_minus, held> mpm{line, linear{}, usl_minus{}, held{}};
    decltype(mpm)::body_for<linear_elastic> bar = mpm.make_body(law, everywhere, per_cell{1});
};
template <class Pace> std::string refusal(interval span, Pace pace) {
    scene s;
    return complaint([&] { integrate(s.mpm, bodies(s.bar), span, pace); });
}

}  // namespace

TEST_CASE("integrate: a number of equal steps, the last of which ends at the end") {
    scene s;
    std::vector<double> times;
    std::vector<long> steps;
    const long done = integrate(
        s.mpm, bodies(s.bar), {0.3, 1}, fixed_steps{7, 1}, [&](double t) { times.push_back(t); },
        every(3, [&](const progress_state& state) {
            CHECK(state.steps == 7);
            CHECK(state.span.begin == 0.3);
            CHECK(state.time == s.mpm.time());
            steps.push_back(state.step);
        }));
    CHECK(done == 7);
    CHECK(s.mpm.steps() == 7);
    CHECK(s.mpm.time() == 1);
    REQUIRE(times.size() == 8);
    CHECK(times.front() == 0.3);
    CHECK(times.back() == 1);
    CHECK(std::abs(times[3] - 0.6) < 1e-15);
    CHECK(steps == std::vector<long>{0, 3, 6});
}

TEST_CASE("integrate: steps by the Courant number of the law's waves") {
    scene s;
    CHECK(integrate(s.mpm, bodies(s.bar), {0, 1}, courant{0.5}) == 16);
    CHECK(s.mpm.time() == 1);
    CHECK(integrate(s.mpm, bodies(s.bar), {0, 1}, courant{0.45}) == 18);
    CHECK(s.mpm.time() == 1);
}

TEST_CASE("integrate: moving particles carry waves along") {
    solver mpm{grid{{0.}, {16.}, 0.25}};
    auto bar = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 2; }, per_cell{2});
    for (auto p : bar) p[v][0] = 6;
    const long steps = integrate(mpm, bodies(bar), {0, 1}, courant{0.5});
    // (2 + 6) dt/h = 1/2.
    CHECK(steps == 64);
}

TEST_CASE("integrate: spans and paces that make no sense are refused") {
    CHECK(names(refusal({1, 1}, fixed_steps{5}), "integrate", "a later, finite end"));
    CHECK(names(refusal({1, 0}, courant{0.5}), "integrate", "a later, finite end"));
    CHECK(names(refusal({0, std::numeric_limits<double>::infinity()}, courant{0.5}), "a later, finite end"));
    CHECK(names(refusal({0, 1}, fixed_steps{0}), "integrate", "0 steps", "fixed_steps{1}"));
    CHECK(names(refusal({0, 1}, courant{0}), "integrate", "Courant number is 0", "positive"));
    CHECK(names(refusal({0, 1}, courant{std::numeric_limits<double>::quiet_NaN()}), "Courant number is"));
    CHECK(names(complaint([] { every(0, [](double) {}); }), "every", "n is 0"));
}

TEST_CASE("integrate: steps beyond the stability limit are refused, with the step that would do") {
    const std::string text = refusal({0, 1}, fixed_steps{4});
    CAPTURE(text);
    CHECK(names(text, "step 0, t = 0", "Courant number", "is 2 with dt = 0.25", "limit of 0.707", "linear, flip, usl-",
                "inside the body", "at most 0.088375"));
    CHECK(names(refusal({0, 1}, courant{1.5}), "Courant number", "1.5", "limit of 0.707"));
    CHECK(names(refusal({0, 1}, fixed_steps{4, 1.5}), "above the limit of 1.5", "that was given"));
    CHECK(refusal({0, 1}, fixed_steps{4, 3}) == "nothing");
    CHECK(refusal({0, 1}, courant{1.5, 2}) == "nothing");
}

TEST_CASE("integrate: without a number steps are a share of the composition's limit") {
    scene s;
    // Waves of speed 2, cells of 1/4: 8 steps at a Courant number of 1. FLIP with one particle per cell: sqrt(1/2).
    CHECK(integrate(s.mpm, bodies(s.bar), {0, 1}, courant{}) == 13);               // 8/(0.9 0.707)
    CHECK(integrate(s.mpm, bodies(s.bar), {0, 1}, courant{.safety = 0.5}) == 23);  // 8/(0.5 0.707)
    CHECK(integrate(s.mpm, bodies(s.bar), {0, 1}, courant{{}, 0.5, 0.5}) == 32);   // 8/(0.5 0.5)
    CHECK(s.mpm.warnings().empty());
    CHECK(names(refusal({0, 1}, courant{.safety = 1.5}), "safety factor is 1.5"));
    // The limit of orders that are not in the table is 1, which is told.
    solver other{line, linear{}, euler{}, held{}};
    auto bar = other.make_body(law, everywhere, per_cell{1});
    std::vector<warning> told;
    const auto listen = [&](const warning& one) { told.push_back(one); };
    CHECK(integrate(other, bodies(bar), {0, 1}, courant{1. / 2}, listen) == 16);
    CHECK(told.empty());
    CHECK(integrate(other, bodies(bar), {0, 1}, courant{}, listen) == 9);  // 8/0.9
    REQUIRE(told.size() == 1);
    CHECK(names(told[0].sentence, "linear, flip, euler", "nothing is known", "Courant number 0.9", "courant{0.3}"));
    CHECK(integrate(other, bodies(bar), {1, 2}, courant{}, listen) == 9);
    CHECK(told.size() == 1);
}

TEST_CASE("integrate: steps too large for a free end are told once, to whom it concerns") {
    solver mpm{grid{{0.}, {8.}, 0.25}, linear{}, fmpm<2>{}, usl_minus{}, held{}};
    // The last particle is beyond a node by a hundredth of a cell: that node has 1/200 of an inner one's mass.
    std::vector<point<1, double>> places;
    for (int p = 0; p < 17; ++p) places.push_back(point<1, double>(2 + 0.0025 + p / 8.));
    auto bar = mpm.make_body_at(law, places, 0.125);
    std::vector<warning> told;
    const auto listen = [&](const warning& one) { told.push_back(one); };
    const auto run = [&](double number) { integrate(mpm, bodies(bar), {0, 1}, courant{number}, listen); };
    // sqrt(2 n s/k): n particles per cell, s the node's share of mass.
    const double limit = std::sqrt(2 * 2 * 0.005 / 2);
    run(0.9 * limit);
    CHECK(told.empty());
    run(1.1 * limit);
    REQUIRE(told.size() == 1);
    CHECK(std::abs(told[0].limit / limit - 1) < 0.03);
    CHECK(std::abs(told[0].number / limit - 1.1) < 0.001);
    CHECK(names(told[0].sentence, "linear, fmpm(2), usl-", "free end", "0.005", "inner node's mass", "at most"));
    run(1.1 * limit);
    CHECK(told.size() == 1);
    REQUIRE(mpm.warnings().size() == 1);
    CHECK(mpm.warnings()[0] == told[0].sentence);
    // An automatic step keeps to it.
    told.clear();
    solver fresh{grid{{0.}, {8.}, 0.25}, linear{}, fmpm<2>{}, usl_minus{}, held{}};
    auto same = fresh.make_body_at(law, places, 0.125);
    integrate(fresh, bodies(same), {0, 1}, courant{}, listen);
    CHECK(told.empty());
    CHECK(static_cast<double>(fresh.steps()) > 8 / limit);
}

TEST_CASE("integrate: a held particle that is no longer a number is told with its place, step and time") {
    scene s;
    for (auto p : s.bar) p[sigma](0, 0) = p[x][0] > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 0;
    const std::string text = complaint([&] { integrate(s.mpm, bodies(s.bar), {2, 3}, fixed_steps{20}); });
    CAPTURE(text);
    CHECK(names(text, "particle 2 at (0.625)", "step 0, t = ", "not a number", "stability limit"));
}

TEST_CASE("integrate: chosen steps are no larger than a damping or a viscosity allows") {
    double largest = 0, last = 0;
    const auto look = [&](double t) {
        largest = std::max(largest, t - last);
        last = t;
    };
    // Waves allow steps of 0.1; the damping alone would turn velocities round above 0.02.
    solver damped{line, quadratic_spline{}, usl_plus{}, grid_damping{50.}, fixed{everywhere}};
    auto bar = damped.make_body(law, everywhere, per_cell{2});
    integrate(damped, bodies(bar), {0, 1}, courant{}, look);
    CHECK(largest <= 0.9 * 0.02 * (1 + 1e-12));
    CHECK(largest > 0.8 * 0.02);

    largest = last = 0;
    solver viscous{line, quadratic_spline{}, usl_plus{}, fixed{everywhere}};
    const newtonian<neo_hookean> thick{{.young = 4, .poisson = 0, .density = 1}, 3., 1.};
    CHECK_THAT(thick.largest_step(0.25, 1), WithinAbs(0.25 * 0.25 / (2 * (4. + 1.)), 1e-15));
    auto flow = viscous.make_body(thick, everywhere, per_cell{2});
    integrate(viscous, bodies(flow), {0, 0.1}, courant{}, look);
    CHECK(largest <= 0.9 * thick.largest_step(0.25, 1) * (1 + 1e-12));
    CHECK(largest > 0.8 * thick.largest_step(0.25, 1));
}
