#include "bar.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("quadratic, moving, native lanes, further updates: the bar agrees with the reference",
                   "[reference_matrix]", modified_flip, graphics_blend, xpic<dynamic>) {
    bar::check_all_orders<double, native_lanes, quadratic_spline, moving, TestType>();
}

TEMPLATE_TEST_CASE("linear, held, one lane, further updates: the bar agrees with the reference", "[reference_matrix]",
                   modified_flip, graphics_blend, xpic<dynamic>) {
    bar::check_orders<double, lanes<1>, linear, held, TestType, usl_minus, usavg_plus>();
}

TEMPLATE_TEST_CASE("cubic, moving, native lanes: the bar agrees with the reference", "[reference_matrix]", pic, flip,
                   xpic<2>, fmpm<2>) {
    bar::check_orders<double, native_lanes, cubic_spline, moving, TestType, usf, usl_minus, usavg_plus>();
}

TEMPLATE_TEST_CASE("cubic, held, native lanes: the bar agrees with the reference", "[reference_matrix]", flip,
                   fmpm<2>) {
    bar::check_orders<double, native_lanes, cubic_spline, held, TestType, usl_minus>();
}

TEMPLATE_TEST_CASE("cubic, moving, one lane: the bar agrees with the reference", "[reference_matrix]", flip, fmpm<2>) {
    bar::check_orders<double, lanes<1>, cubic_spline, moving, TestType, usl_minus>();
}

TEMPLATE_TEST_CASE("cubic, moving, native lanes of float: the bar agrees with the reference", "[reference_matrix]",
                   flip, fmpm<2>) {
    bar::check_orders<float, native_lanes, cubic_spline, moving, TestType, usl_minus>();
}
