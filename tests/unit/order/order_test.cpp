#include <tamis/material/linear_elastic.hpp>
#include <tamis/order/order.hpp>
#include <tamis/run/initial.hpp>
#include <tamis/run/solver.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;

namespace order_test {

struct twice {
    static constexpr double before = 1, after = 1;
    static constexpr bool remap = false, explicit_euler = false;
};

}  // namespace order_test

TEST_CASE("order: every stress order strains the particles once a step") {
    STATIC_REQUIRE(StressOrder<usf>);
    STATIC_REQUIRE(StressOrder<usl_minus>);
    STATIC_REQUIRE(StressOrder<usl_plus>);
    STATIC_REQUIRE(StressOrder<usavg_minus>);
    STATIC_REQUIRE(StressOrder<usavg_plus>);
    STATIC_REQUIRE(StressOrder<euler>);
    STATIC_REQUIRE_FALSE(StressOrder<order_test::twice>);
}

TEST_CASE("order: a step strains by the whole of it, in one part or in two halves") {
    const auto check = [](auto order, double before, double after) {
        CHECK(order.before == before);
        CHECK(order.after == after);
        // A bar that is held to a rate of strain of 3.
        const prescribed all{everywhere, [](const auto& at, auto) { return (3 * at).eval(); }};
        solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, held{}, order, all};
        auto bar = mpm.make_body(linear_elastic{.young = 2, .density = 1}, everywhere, per_cell{1});
        set_velocity_of(bar, [](const auto& at) { return 3 * at[0]; });
        mpm.step(bodies(bar), 0.01);
        for (const auto p : std::as_const(bar)) CHECK(std::abs(p[symbols::sigma](0, 0) - 2 * 3 * 0.01) < 1e-15);
    };
    check(usf{}, 1, 0);
    check(usl_minus{}, 0, 1);
    check(usavg_minus{}, 0.5, 0.5);
    check(usavg_plus{}, 0.5, 0.5);
}
