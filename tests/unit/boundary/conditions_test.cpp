#include <tamis/boundary/conditions.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

using place = point<2, double>;

template <class B> constexpr bool has_normal = requires(const B& b, const place& at) { b.normal(at); };

const auto left = [](const auto& at) { return at[0] <= 0; };
const auto swirl = [](const auto& at, auto t) { return place(-t * at[1], t * at[0]); };

}  // namespace

TEST_CASE("conditions: each says where it holds, what velocity it gives, and along what") {
    const place on(0, 2), off(1, 2);

    CHECK_FALSE(unbounded{}.holds(on));

    const fixed wall{left};
    CHECK(wall.holds(on));
    CHECK_FALSE(wall.holds(off));
    CHECK(place(wall.velocity(on, 3.)) == place(0, 0));

    const slip plane{left, place(1, 0)};
    CHECK(plane.holds(on));
    CHECK(place(plane.velocity(on, 3.)) == place(0, 0));
    CHECK(plane.normal(on) == place(1, 0));

    const prescribed mover{left, swirl};
    CHECK_FALSE(mover.holds(off));
    CHECK(place(mover.velocity(on, 3.)) == place(-6, 0));
    STATIC_REQUIRE_FALSE(has_normal<decltype(mover)>);

    const prescribed pusher{left, swirl, place(0, 1)};
    CHECK(place(pusher.velocity(on, 3.)) == place(-6, 0));
    CHECK(pusher.normal(on) == place(0, 1));
    STATIC_REQUIRE(has_normal<decltype(pusher)>);
}

TEST_CASE("conditions: everywhere is everywhere") { CHECK(everywhere(place(1e9, -1e9))); }

TEST_CASE("conditions: all of them, and plain structs of a user, are boundary conditions") {
    struct piston {
        bool holds(const place& at) const { return at[0] > 1; }
        place velocity(const place&, double t) const { return {t, 0}; }
    };
    STATIC_REQUIRE(BoundaryCondition<piston, place>);
    STATIC_REQUIRE(BoundaryCondition<unbounded, place>);
    STATIC_REQUIRE(BoundaryCondition<fixed<decltype(left)>, place>);
    STATIC_REQUIRE(BoundaryCondition<prescribed<decltype(left), decltype(swirl)>, place>);
    STATIC_REQUIRE_FALSE(BoundaryCondition<int, place>);
}

TEST_CASE("conditions: one, or several, come as a list") {
    const fixed wall{left};
    const conditions both{wall, slip{everywhere, place(0, 1)}};
    STATIC_REQUIRE(std::tuple_size_v<decltype(detail::each_condition(wall))> == 1);
    STATIC_REQUIRE(std::tuple_size_v<decltype(detail::each_condition(both))> == 2);
    CHECK(&std::get<0>(detail::each_condition(wall)) == &wall);
}
