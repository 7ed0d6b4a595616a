#pragma once
#include <tamis/core/names.hpp>
#include <tamis/engine/node_table.hpp>
#include <tamis/shape/held_weights.hpp>

#include <memory>
#include <utility>

namespace tamis::detail {

/// Mean over the particles around a node, by volume, of the field that a law carries, and the sum of their volumes.
struct carried : scalar_field {
    static constexpr std::string_view name = "carried";
};
struct carried_volume : scalar_field {
    static constexpr std::string_view name = "carried_volume";
};
/// That mean times the node's velocity.
struct carried_flow : vector_field {
    static constexpr std::string_view name = "carried_flow";
};

/// Does a body need the slope of what its law carries? Particles that are held do, as the flow goes past them; moving
/// ones where the law says `carries_when_moving`.
template <class Law, class Shape, class List> inline constexpr bool needs_flow = false;
template <class Law, class Shape, class List>
requires requires { typename Law::carries; }
inline constexpr bool needs_flow<Law, Shape, List> =
    (contains<List, held_weights<Shape>> && !keeps_first_place<List>) || requires {
    requires Law::carries_when_moving;
};

/// Scratch of a body for that, made when it is first needed. A copy of the body makes its own.
template <class S, bool Needed> struct carried_nodes {};
template <class S> struct carried_nodes<S, true> {
    using table_type = node_table<S, fields<carried, carried_volume, carried_flow>>;
    std::unique_ptr<table_type> table;

    carried_nodes() = default;
    carried_nodes(carried_nodes&&) = default;
    carried_nodes(const carried_nodes&) {}
    carried_nodes& operator=(carried_nodes&&) = default;
    carried_nodes& operator=(const carried_nodes&) {
        table.reset();
        return *this;
    }
};

}  // namespace tamis::detail
