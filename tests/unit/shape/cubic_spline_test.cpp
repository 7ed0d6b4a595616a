#include <tamis/shape/cubic_spline.hpp>

#include "unit/shape/functions.hpp"

using namespace tamis;

TEST_CASE("cubic_spline: functions that sum to one, give places back, and have continuous slopes") {
    check_functions(cubic_spline{});
    CHECK(slopes_are_continuous(cubic_spline{}));
    STATIC_REQUIRE(detail::ghosts<cubic_spline> == 1);
}

TEST_CASE("cubic_spline: 2/3 at its node, 1/6 at the next, 23/48 half-way") {
    const auto at_node = cubic_spline{}.on_axis(0.), half_way = cubic_spline{}.on_axis(0.5);
    CHECK(std::abs(at_node.w[0] - 1. / 6) < 1e-16);
    CHECK(std::abs(at_node.w[1] - 2. / 3) < 1e-16);
    CHECK(std::abs(half_way.w[1] - 23. / 48) < 1e-16);
}
