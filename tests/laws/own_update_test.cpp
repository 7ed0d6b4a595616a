// Updates that a user may write, beside the library's: half PIC and half FLIP, and PIC that carries the slope.
#include <tamis/tamis.hpp>

#include "catch.hpp"

using namespace tamis;
using Catch::Matchers::WithinRel;

namespace own_update_test {

/// What blend{0.5} does.
struct half_and_half {
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::velocity, const field::acceleration>;
    static constexpr double start_share() { return 0.5; }
    auto velocity(auto p, auto near, auto dt) const {
        using namespace symbols;
        return ((p[v] + dt * near.sum(a) + near.sum(v)) / 2).eval();
    }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

/// What tpic does.
struct with_gradient : set_velocity {
    static constexpr bool carries_slope = true;
    using gradients = fields<field::velocity>;
    auto affine_velocity(auto near) const { return near.gradient(symbols::v); }
};
struct my_tpic : transfer<lumped_mass, with_gradient> {
    using carries_type = carries_affine_velocity;
};

template <class Scheme> double energy_left(const Scheme& scheme) {
    const auto ends = fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, scheme, ends, one_lane{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    set_velocity_of(bar, [](const auto& at) { return 0.01 * at[0] * (1 - at[0]); });
    for (int k = 0; k < 100; ++k) mpm.step(bodies(bar), 0.005);
    return kinetic_energy(bar) + elastic_energy(bar);
}

}  // namespace own_update_test

TEST_CASE("update: one written by a user does what the library's does") {
    using namespace own_update_test;
    CHECK_THAT((energy_left(transfer<lumped_mass, half_and_half>{})), WithinRel(energy_left(blend{0.5}), 1e-12));
    CHECK_THAT(energy_left(my_tpic{}), WithinRel(energy_left(tpic{}), 1e-12));
}
