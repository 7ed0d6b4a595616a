#include "block.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("3D, quadratic, moving, fmpm<2>: the block agrees with the reference", "[reference_matrix]",
                   native_lanes, lanes<1>) {
    block::check_orders<3, TestType, quadratic_spline, fmpm<2>, usavg_plus>();
}
