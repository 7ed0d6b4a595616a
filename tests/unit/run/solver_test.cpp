#include <tamis/tamis.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const linear_elastic law{.young = 4, .poisson = 0, .density = 1};

struct weightless {
    double density = 0;
    double wave_speed() const { return 1; }
};

using place = point<1, double>;
const uniform_grid<1, double> line{{0.}, {1.}, 0.25};
using line_solver = solver<uniform_grid<1, double>, linear>;

/// A bar of four particles, changed by `change`; what stepping it by dt says.
template <class Change> std::string step_says(Change change, double dt = 0.01) {
    line_solver mpm{line, linear{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{1});
    long k = 0;
    for (auto p : bar) change(k++, p);
    return complaint([&] { mpm.step(bodies(bar), dt); });
}
const auto no_change = [](long, auto) {};

}  // namespace

TEST_CASE("solver: a body needs particles") {
    const line_solver mpm{line, linear{}};
    const auto nowhere = [](const auto&) { return false; };
    CHECK(names(complaint([&] { mpm.make_body(law, nowhere, per_cell{2}); }), "make_body", "region holds no particle"));
    CHECK(names(complaint([&] { mpm.make_body_at(law, {}, 0.1); }), "make_body", "no particle", "one point"));
    CHECK(names(complaint([&] { mpm.make_body(law, everywhere, per_cell{0}); }), "make_body", "0 particles per cell",
                "per_cell{1}"));
    CHECK(names(complaint([&] { mpm.make_body(law, everywhere, per_cell{-2}); }), "-2 particles per cell"));
}

TEST_CASE("solver: particles are created in the grid, with a volume") {
    const line_solver mpm{line, linear{}};
    const std::string outside = complaint([&] { mpm.make_body_at(law, {place(0.5), place(1.25)}, 0.1); });
    CAPTURE(outside);
    CHECK(names(outside, "make_body", "particle at (1.25)", "outside the grid", "(0) to (1)"));
    CHECK(names(complaint([&] { mpm.make_body_at(law, {place(not_a_number)}, 0.1); }), "particle at (",
                "outside the grid"));
    for (const double volume : {0., -1., not_a_number, infinity})
        CHECK(names(complaint([&] { mpm.make_body_at(law, {place(0.5)}, volume); }), "make_body", "volume is",
                    "positive"));
    CHECK(mpm.make_body_at(law, {place(0), place(1)}, 0.1).size() == 2);
}

TEST_CASE("solver: any law needs a density") {
    const line_solver mpm{line, linear{}};
    CHECK(names(complaint([&] { mpm.make_body(weightless{}, everywhere, per_cell{1}); }), "make_body", "density is 0"));
    CHECK(names(complaint([&] { mpm.make_body(weightless{not_a_number}, everywhere, per_cell{1}); }), "density is"));
}

TEST_CASE("solver: a time step is a positive number") {
    CHECK(step_says(no_change) == "nothing");
    for (const double dt : {0., -0.5, not_a_number}) {
        CAPTURE(dt);
        CHECK(names(step_says(no_change, dt), "time step is", "positive"));
    }
}

TEST_CASE("solver: what a user made of the particles is checked before the step, by particle, step and time") {
    const std::string velocity = step_says([](long k, auto p) {
        if (k == 2) p[v][0] = not_a_number;
    });
    CAPTURE(velocity);
    CHECK(names(velocity, "particle 2 at (0.625)", "step 0", "t = 0", "velocity is not finite", "initial velocity"));
    CHECK(names(step_says([](long, auto p) { p[v][0] = infinity; }), "particle 0", "velocity is not finite"));

    const std::string mass = step_says([](long k, auto p) {
        if (k == 1) p[m] = 0;
    });
    CAPTURE(mass);
    CHECK(names(mass, "particle 1 at (0.375)", "step 0", "t = 0", "mass is 0", "positive"));
    for (const double bad : {-1., not_a_number, infinity})
        CHECK(names(step_says([&](long, auto p) { p[m] = bad; }), "particle 0", "mass is"));
    for (const double bad : {0., -1., not_a_number, infinity})
        CHECK(names(step_says([&](long, auto p) { p[V] = bad; }), "particle 0", "volume is"));
}

TEST_CASE("solver: a later change is checked as well, and told with its step and time") {
    line_solver mpm{line, linear{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{1});
    mpm.start_at(2);
    mpm.step(bodies(bar), 0.25);
    mpm.step(bodies(bar), 0.25);
    for (auto p : bar) p[m] = -1;
    CHECK(names(complaint([&] { mpm.step(bodies(bar), 0.25); }), "particle 0", "step 2", "t = 2.5", "mass is -1"));
}

TEST_CASE("solver: time and steps go on; a step may be told where it ends") {
    line_solver mpm{line, linear{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{1});
    CHECK(mpm.time() == 0);
    mpm.start_at(1);
    CHECK(mpm.time() == 1);
    mpm.step(bodies(bar), 0.25);
    CHECK(mpm.time() == 1.25);
    mpm.step(bodies(bar), 0.25, 1.75);
    CHECK(mpm.time() == 1.75);
    CHECK(mpm.steps() == 2);
}

TEST_CASE("solver: reactions are of the nodes that conditions hold") {
    solver mpm{line, linear{}, fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    for (auto p : bar) p[sigma](0, 0) = 3;
    mpm.step(bodies(bar), 1e-3);
    const auto ends = mpm.reactions();
    REQUIRE(ends.size() == 2);
    CHECK(ends[0].at[0] == 0);
    CHECK(ends[1].at[0] == 1);
    // A bar under tension pulls its ends inwards; they are held against that.
    CHECK(std::abs(ends[0].reaction[0] + 3) < 1e-14);
    CHECK(std::abs(ends[1].reaction[0] - 3) < 1e-14);
    CHECK(mpm.boundary_work() == 0);
}
