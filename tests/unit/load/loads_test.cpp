#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 2};
using place = point<2, double>;

template <class... Policy> place velocity_after_a_step(const Policy&... policy) {
    solver mpm{uniform_grid{{0., 0.}, {3., 2.}, 0.25}, policy...};
    auto disc = mpm.make_body(
        law, [](const auto& at) { return (at - place(1.5, 1)).norm() < 0.7; }, per_cell{2});
    for (auto p : disc) p[v] << 0.5, 0.25;
    mpm.step(bodies(disc), 0.125);
    return mean(disc, v);
}

}  // namespace

TEMPLATE_TEST_CASE("loads: several add up, those for lanes and those for points", "", one_lane, native_lanes) {
    const gravity<place> down{{0, -2}};
    const body_acceleration aside{[](const auto&, const auto&, double) { return place(1, 0); }};
    const body_acceleration drag{[](const auto&, const auto& speed, double) { return (-speed).eval(); }};
    const place start(0.5, 0.25), both = velocity_after_a_step(loads{down, aside}, TestType{});
    CHECK((both - start - 0.125 * place(1, -2)).norm() < 1e-14);
    const place all = velocity_after_a_step(loads{aside, down, drag}, TestType{});
    CHECK((all - start - 0.125 * (place(1, -2) - start)).norm() < 1e-14);
    CHECK(velocity_after_a_step(loads{down}, TestType{}) == velocity_after_a_step(down, TestType{}));
}

TEST_CASE("loads: particles and nodes store what the loads ask for, and no more") {
    const auto stored = [](const auto&... policy) {
        solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, policy...};
        const auto block = mpm.make_body(law, everywhere, per_cell{1});
        return std::pair(block.bytes_per_particle(), mpm.bytes_per_node());
    };
    const auto bare = stored(), plain = stored(gravity{place(0, 1)});
    CHECK(plain == bare);
    CHECK(stored(loads{gravity{place(0, 1)}, grid_damping{1.}, particle_damping{1}}) == bare);
    const auto push = traction{everywhere, [](const auto&, const auto& n, double) { return n; }};
    CHECK(stored(push) == std::pair(bare.first + 4 * sizeof(double), bare.second));
    const auto pull = particle_force{everywhere, [](const auto& at, double) { return at; }};
    CHECK(stored(loads{pull, push, pull}) == std::pair(bare.first + 6 * sizeof(double), bare.second));
}
