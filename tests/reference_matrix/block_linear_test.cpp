#include "block.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("2D, linear, moving, native lanes: the block agrees with the reference", "[reference_matrix]", flip,
                   fmpm<2>, fmpm<3>, xpic<2>, xpic<3>, pic) {
    block::check_orders<2, native_lanes, linear, TestType, usl_minus, usavg_plus, usf>();
}
