#include "block.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("2D, quadratic, moving: the block by affine transfers agrees with the reference",
                   "[reference_matrix]", apic, tpic, affine_flip) {
    block::check_orders<2, native_lanes, quadratic_spline, TestType, usl_minus, usavg_plus, usf>();
}
TEST_CASE("affine transfers agree with the reference one lane wide, by linear functions and in 3D",
          "[reference_matrix]") {
    block::check_orders<2, one_lane, quadratic_spline, apic, usl_plus>();
    block::check_orders<2, native_lanes, linear, affine_flip, usl_minus>();
    block::check_orders<2, native_lanes, linear, apic, usavg_minus>();
    block::check_orders<3, native_lanes, quadratic_spline, apic, usl_plus>();
    block::check_orders<3, native_lanes, quadratic_spline, affine_flip, usl_minus>();
}
