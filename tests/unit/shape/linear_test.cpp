#include <tamis/shape/linear.hpp>

#include "unit/shape/functions.hpp"

using namespace tamis;

TEST_CASE("linear: tents that sum to one, give places back, and whose slopes jump at nodes") {
    check_functions(linear{});
    CHECK_FALSE(slopes_are_continuous(linear{}));
    STATIC_REQUIRE(detail::ghosts<linear> == 0);
    STATIC_REQUIRE(detail::constant_slope<linear>);
}
