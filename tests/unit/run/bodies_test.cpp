#include <tamis/tamis.hpp>

#include <cmath>
#include <optional>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
using grid = uniform_grid<1, double>;
const grid line{{0.}, {1.}, 0.05};
constexpr double dt = 1e-3;

/// Deviation of a body's velocities from 1.
template <class Body> double unevenness(const Body& body) {
    double most = 0;
    for (const auto p : body) most = std::max(most, std::abs(p[v][0] - 1));
    return most;
}
template <class Body> void set_velocities(Body& body) {
    for (auto p : body) p[v][0] = 1;
}
template <class Motion> struct two_bodies {
    solver<grid, linear, pic, Motion> mpm{line, linear{}, pic{}, Motion{}};
    typename decltype(mpm)::template body_for<linear_elastic> left = mpm.make_body(
                                                                  law, [](const auto&at) { return at[0] < 0.5; },
                                                                  per_cell{2}),
                                                              right = mpm.make_body(
                                                                  law, [](const auto&at) { return at[0] > 0.4; },
                                                                  per_cell{2});
    two_bodies() {
        set_velocities(left);
        set_velocities(right);
    }
};

}  // namespace

TEMPLATE_TEST_CASE("bodies: one that is no longer in the step is no longer felt", "", held, moving) {
    two_bodies<TestType> s;
    s.mpm.step(bodies(s.left, s.right), dt);
    CHECK(unevenness(s.left) < 1e-12);
    s.mpm.step(bodies(s.left), dt);
    CHECK(unevenness(s.left) < 1e-12);
}

TEMPLATE_TEST_CASE("bodies: by turns, each feels itself only", "", held, moving) {
    two_bodies<TestType> s;
    for (auto p : s.right) p[v][0] = -1;
    for (int k = 0; k < 3; ++k) {
        s.mpm.step(bodies(s.left), dt);
        s.mpm.step(bodies(s.right), dt);
    }
    CHECK(unevenness(s.left) < 1e-12);
    for (const auto p : std::as_const(s.right)) CHECK(std::abs(p[v][0] + 1) < 1e-12);
}

TEST_CASE("bodies: a body may go to another solver, also to one in the place of the last") {
    std::optional<solver<grid, linear, pic>> mpm;
    mpm.emplace(line, linear{}, pic{});
    auto bar = mpm->make_body(law, everywhere, per_cell{2});
    set_velocities(bar);
    mpm->step(bodies(bar), dt);
    mpm.emplace(line, linear{}, pic{});
    mpm->step(bodies(bar), dt);
    CHECK(unevenness(bar) < 1e-12);
}

TEST_CASE("bodies: a copy goes on from where it was made, wherever the original went") {
    solver mpm{grid{{0.}, {8.}, 0.05}, quadratic_spline{}, pic{}};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 1.5; }, per_cell{2});
    set_velocities(block);
    mpm.step(bodies(block), 0.02);
    auto kept = block;
    for (auto p : kept) p[v][0] = -1;
    for (int k = 0; k < 250; ++k) mpm.step(bodies(block), 0.02);
    mpm.step(bodies(kept), 0.02);
    for (const auto p : std::as_const(kept)) {
        CHECK(std::abs(p[v][0] + 1) < 1e-12);
        CHECK(p[x][0] < 1.6);
    }
}

TEST_CASE("bodies: a body that goes on leaves few empty tiles behind") {
    solver mpm{uniform_grid{{0., 0.}, {120., 4.}, 1.}, quadratic_spline{}, flip{}};
    auto block = mpm.make_body(
        linear_elastic{.young = 1e-3, .poisson = 0, .density = 1},
        [](const auto& at) { return at[0] > 2 && at[0] < 6 && at[1] > 1 && at[1] < 3; }, per_cell{2});
    for (auto p : block) p[v][0] = 1;
    for (int k = 0; k < 1100; ++k) mpm.step(bodies(block), 0.1);
    CHECK((*std::as_const(block).begin())[x][0] > 110);
    const auto& store = block.store();
    int empty = 0;
    for (const auto& t : store.tiles) {
        std::uint32_t occupied = 0;
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s) occupied |= store.occupied[s];
        empty += t.count > 0 && occupied == 0 ? 1 : 0;
    }
    CHECK(empty <= 16);
}
