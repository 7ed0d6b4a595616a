#include <tamis/engine/node_table.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

template <class T> void only_active_blocks_are_cleared() {
    using S = space<2, T>;
    constexpr auto W = static_cast<std::size_t>(S::width);
    detail::node_table<S, fields<field::mass, field::velocity>> nodes(20 * W);
    STATIC_REQUIRE(nodes.components == 3);
    for (std::size_t k = 0; k < 20 * W; ++k) {
        CHECK(nodes.template at<field::velocity>(k, 1) == 0);
        nodes.template at<field::mass>(k) = 1;
        nodes.template at<field::velocity>(k, 0) = 2;
        nodes.template at<field::velocity>(k, 1) = 3;
    }
    nodes.set_active({1, 2, 3, 7, 19});
    CHECK(nodes.active().size() == 5);
    nodes.template set_zero<field::velocity>();
    for (std::size_t k = 0; k < 20 * W; ++k) {
        const std::size_t block = k / W;
        const bool active = (block >= 1 && block <= 3) || block == 7 || block == 19;
        CHECK(nodes.template at<field::mass>(k) == 1);
        CHECK(nodes.template at<field::velocity>(k, 0) == (active ? 0 : 2));
        CHECK(nodes.template at<field::velocity>(k, 1) == (active ? 0 : 3));
    }
}

}  // namespace

TEST_CASE("node_table: columns of their own, zero at first; only active blocks are cleared") {
    only_active_blocks_are_cleared<double>();
    only_active_blocks_are_cleared<native_lanes::type<double>>();
}

TEST_CASE("node_table: fields that share a column are one") {
    using namespace detail;
    using layout = shared_columns<fields<field::mass, field::velocity>, shares<field::mass, field::mass>,
                                  shares<field::inverse_mass, field::mass>, shares<field::velocity, field::velocity>,
                                  shares<field::momentum, field::velocity>>;
    STATIC_REQUIRE(stores<layout, field::momentum>);
    STATIC_REQUIRE_FALSE(stores<layout, field::force>);
    STATIC_REQUIRE(node_table<space<2, double>, layout>::components == 3);
    node_table<space<1, double>, layout> nodes(8);
    CHECK(nodes.block<field::inverse_mass>(0) == nodes.block<field::mass>(0));
    CHECK(nodes.block<field::momentum>(0) == nodes.block<field::velocity>(0));
    CHECK(nodes.block<field::mass>(0) != nodes.block<field::velocity>(0));
}
