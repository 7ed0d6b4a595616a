#include <tamis/update/schemes.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

TEST_CASE("schemes: parameters that make no sense are refused by name") {
    CHECK(names(complaint([] { fmpm<dynamic>{0}; }), "FMPM(k)", "k is 0", "k >= 1"));
    CHECK(names(complaint([] { xpic<dynamic>{-3}; }), "XPIC(k)", "k is -3", "k >= 1"));
    CHECK(names(complaint([] { blend{1.5}; }), "blend", "alpha is 1.5", "PIC", "FLIP"));
    CHECK(names(complaint([] { blend{-0.1}; }), "blend", "alpha is -0.1"));
    CHECK(names(complaint([] { blend{NAN}; }), "blend", "alpha is"));
    CHECK(names(complaint([] { graphics_blend{2}; }), "blend", "alpha is 2"));
    CHECK(names(complaint([] { modified_flip{NAN}; }), "modified_flip", "psi", "finite"));
    CHECK(complaint([] { blend{0}, blend{1}, graphics_blend{0.5}, modified_flip{-1}, fmpm<dynamic>{1}; }) == "nothing");
}

TEST_CASE("schemes: the order is known when compiled, or carried along") {
    STATIC_REQUIRE(fmpm<3>{}.mass.terms() == 3);
    STATIC_REQUIRE(xpic<5>{}.mass.terms() == 5);
    CHECK(fmpm<dynamic>{7}.mass.terms() == 7);
    CHECK(xpic<dynamic>{2}.mass.terms() == 2);
}

TEST_CASE("schemes: a scheme without a parameter takes no room, and FMPM(1) no sweep") {
    STATIC_REQUIRE(std::is_empty_v<pic>);
    STATIC_REQUIRE(std::is_empty_v<flip>);
    STATIC_REQUIRE(std::is_empty_v<fmpm<4>>);
    STATIC_REQUIRE_FALSE(fmpm<1>::mass_type::full);
    STATIC_REQUIRE(std::is_same_v<on_nodes_t<fmpm<1>::mass_type>, fields<>>);
    STATIC_REQUIRE(fmpm<2>::mass_type::full);
}
