#include <tamis/stress/order.hpp>

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
