#include <tamis/run/solver.hpp>
#include <tamis/shape/gimp.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

using grid = uniform_grid<2, double>;
template <class... P> using composed = detail::composition<grid, P...>;
template <class A, class B> constexpr bool same = std::is_same_v<A, B>;

constexpr auto left = [](const auto& at) { return at[0] <= 0; };
using wall = fixed<decltype(left)>;
using weight = gravity<point<2, double>>;

/// A user's own policies are known by their members.
struct tent {
    static constexpr int support = 2;
    static constexpr double shift = 0;
    template <class T> axis_weights<T, 2> on_axis(const T& r) const { return linear{}.on_axis(r); }
};
struct piston {
    bool holds(const auto& at) const { return at[0] <= 0; }
    auto velocity(const auto& at, auto) const { return (at * 0).eval(); }
};

}  // namespace

TEST_CASE("composition: policies are told apart by their members, in any order") {
    using one = composed<linear, fmpm<2>, usf, wall, weight, held, serial, one_lane, leaving_clamps>;
    using other = composed<leaving_clamps, weight, serial, wall, usf, one_lane, held, fmpm<2>, linear>;
    STATIC_REQUIRE(same<one::shape, linear>);
    STATIC_REQUIRE(same<one::transfer, fmpm<2>>);
    STATIC_REQUIRE(same<one::order, usf>);
    STATIC_REQUIRE(same<one::boundary, wall>);
    STATIC_REQUIRE(same<one::load, weight>);
    STATIC_REQUIRE(same<one::motion, held>);
    STATIC_REQUIRE(same<one::execution, serial>);
    STATIC_REQUIRE(same<one::lane_policy, one_lane>);
    STATIC_REQUIRE(same<one::leaving, leaving_clamps>);
    STATIC_REQUIRE(same<detail::schedule_of<one>::layout, detail::schedule_of<other>::layout>);
    STATIC_REQUIRE(same<one::step_fields, other::step_fields>);
    STATIC_REQUIRE(same<one::S, other::S>);
}

TEST_CASE("composition: what is left out takes its default") {
    using plain = composed<>;
    STATIC_REQUIRE(same<plain::shape, quadratic_spline>);
    STATIC_REQUIRE(same<plain::transfer, flip>);
    STATIC_REQUIRE(same<plain::order, usl_plus>);
    STATIC_REQUIRE(same<plain::boundary, unbounded>);
    STATIC_REQUIRE(same<plain::load, unloaded>);
    STATIC_REQUIRE(same<plain::motion, moving>);
    STATIC_REQUIRE(same<plain::execution, serial>);
    STATIC_REQUIRE(same<plain::lane_policy, native_lanes>);
    STATIC_REQUIRE(same<plain::leaving, leaving_stops>);
    STATIC_REQUIRE_FALSE(plain::loaded);
    // Functions that change with the strain of moving particles are read before that.
    STATIC_REQUIRE(same<composed<cpgimp>::order, usl_minus>);
    STATIC_REQUIRE(same<composed<cpgimp, held>::order, usl_plus>);
    STATIC_REQUIRE(same<composed<ugimp>::order, usl_plus>);
}

TEST_CASE("composition: a user's shape and condition take their roles") {
    using own = composed<piston, tent>;
    STATIC_REQUIRE(same<own::shape, tent>);
    STATIC_REQUIRE(same<own::boundary, piston>);
}

TEST_CASE("composition: held particles keep weights, moving ones a place") {
    STATIC_REQUIRE(stores<composed<linear>::step_fields, field::position>);
    STATIC_REQUIRE_FALSE(stores<composed<linear, held>::step_fields, field::position>);
    STATIC_REQUIRE(stores<composed<linear, held>::step_fields, detail::held_weights<linear>>);
    STATIC_REQUIRE(stores<composed<usl_plus>::step_fields, field::step_displacement>);
    STATIC_REQUIRE_FALSE(stores<composed<usl_plus, held>::step_fields, field::step_displacement>);
    STATIC_REQUIRE_FALSE(stores<composed<usl_minus>::step_fields, field::step_displacement>);
}
