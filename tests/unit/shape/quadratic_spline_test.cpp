#include <tamis/shape/quadratic_spline.hpp>

#include "unit/shape/functions.hpp"

using namespace tamis;

TEST_CASE("quadratic_spline: functions that sum to one, give places back, and have continuous slopes") {
    check_functions(quadratic_spline{});
    CHECK(slopes_are_continuous(quadratic_spline{}));
    STATIC_REQUIRE(detail::ghosts<quadratic_spline> == 1);
    STATIC_REQUIRE_FALSE(detail::constant_slope<quadratic_spline>);
}

TEST_CASE("quadratic_spline: 3/4 at its node, 1/8 half-way to the ends") {
    const auto at = quadratic_spline{}.on_axis(0.5);
    CHECK(at.w[1] == 0.75);
    CHECK(at.w[0] == 0.125);
    CHECK(at.w[2] == 0.125);
}
