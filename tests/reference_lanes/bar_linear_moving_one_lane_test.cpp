#include "reference_matrix/bar.hpp"
#include "catch.hpp"

using namespace tamis;

TEMPLATE_TEST_CASE("linear, moving, one lane: the bar agrees with the reference", "[reference_matrix]", pic, flip,
                   blend, xpic<2>, xpic<3>, fmpm<1>, fmpm<2>, fmpm<4>, fmpm<dynamic>) {
    bar::check_all_orders<double, lanes<1>, linear, moving, TestType>();
}
