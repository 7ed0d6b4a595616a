#pragma once
#include <tamis/core/space.hpp>

#include <concepts>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tamis {

/// A condition on the velocity of nodes. `holds(at)`: does it apply to the node there? `velocity(at, t)`: the velocity
/// it gives (in 1D a number will do), asked only where it holds. With `normal(at)`, a unit vector, only that direction
/// is held: v.n = velocity.n; else all.
template <class B, class Point>
concept BoundaryCondition = requires(const B& condition, const Point& at, double t) {
    { condition.holds(at) } -> std::convertible_to<bool>;
    condition.velocity(at, t);
};

/// No condition: the body is free.
struct unbounded {
    static constexpr bool never = true;
    bool holds(const auto&) const { return false; }
    auto velocity(const auto& at, auto) const { return (at * 0).eval(); }
};

namespace detail {

/// Is it a vector, and so no region?
template <class Region> inline constexpr bool is_direction = std::is_arithmetic_v<Region> || requires {
    Region::SizeAtCompileTime;
};

}  // namespace detail

/// Every place.
inline constexpr auto everywhere = [](const auto&) { return true; };

/// Nodes of a region, a predicate of the place, do not move.
template <class Region> struct fixed {
    Region region;
    bool holds(const auto& at) const { return region(at); }
    auto velocity(const auto& at, auto) const { return (at * 0).eval(); }
};
template <class Region> fixed(Region) -> fixed<Region>;

/// Nodes of a region do not move along `direction` (a unit vector); the rest is free.
template <class Region, class Direction> struct slip {
    static_assert(!detail::is_direction<Region>,
                  "tamis: slip{region, direction} has its arguments exchanged; give the region, a function of the "
                  "place, first and the unit vector after it");
    Region region;
    /// The direction that is held, a unit vector.
    Direction direction;
    bool holds(const auto& at) const { return region(at); }
    auto velocity(const auto& at, auto) const { return (at * 0).eval(); }
    auto normal(const auto&) const { return direction; }
};
template <class Region, class Direction> slip(Region, Direction) -> slip<Region, Direction>;

/// Every component of the velocity.
struct all_directions {};

/// Nodes of a region move with a given velocity(at, t), or take its part along `direction` (a unit vector) and are free
/// across.
template <class Region, class Velocity, class Direction = all_directions> struct prescribed {
    static_assert(
        !detail::is_direction<Region> && !detail::is_direction<Velocity>,
        "tamis: prescribed{region, velocity, direction} has its arguments in another order, or a plain vector "
        "for the velocity; give functions region(at) and velocity(at, t) first, then the unit vector");
    Region region;
    /// Velocity (m/s) at a place (m) and time (s).
    Velocity value;
    /// The only direction that is held, a unit vector; if it is left out, all are.
    [[no_unique_address]] Direction direction{};
    bool holds(const auto& at) const { return region(at); }
    auto velocity(const auto& at, auto t) const { return value(at, t); }
    auto normal(const auto&) const requires(!std::same_as<Direction, all_directions>) { return direction; }
};
template <class Region, class Velocity> prescribed(Region, Velocity) -> prescribed<Region, Velocity>;
template <class Region, class Velocity, class Direction> prescribed(Region, Velocity, Direction)
    -> prescribed<Region, Velocity, Direction>;

/// Several conditions at once; at a node they must hold different directions, or agree.
template <class... Condition> struct conditions {
    /// The conditions.
    std::tuple<Condition...> all;
    /// Of one condition or more.
    constexpr explicit conditions(Condition... each) : all(std::move(each)...) {}
};
template <class... Condition> conditions(Condition...) -> conditions<Condition...>;

namespace detail {

template <class B> inline constexpr bool is_conditions = false;
template <class... C> inline constexpr bool is_conditions<conditions<C...>> = true;

/// A condition, or several, as a tuple of references.
template <class B> auto each_condition(const B& condition) {
    if constexpr (is_conditions<B>)
        return std::apply([](const auto&... c) { return std::tie(c...); }, condition.all);
    else
        return std::tie(condition);
}

}  // namespace detail
}  // namespace tamis
