#include "reference_matrix/bar.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("linear, moving, native lanes of float: the bar agrees with the reference", "[reference_matrix]",
                   pic, flip, blend, xpic<2>, xpic<3>, fmpm<1>, fmpm<2>, fmpm<4>, fmpm<dynamic>) {
    bar::check_all_orders<float, native_lanes, linear, moving, TestType>();
}
