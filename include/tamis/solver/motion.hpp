#pragma once
#include <tamis/core/fields.hpp>

#include <string_view>

namespace tamis {

/// Particles move with the material.
struct moving {
    static constexpr std::string_view name = "moving";
    static constexpr bool moves = true;
};
/// Particles are held where they are: their weights, and the nodes' masses, are made once.
struct held {
    static constexpr std::string_view name = "held";
    static constexpr bool moves = false;
};

/// What happens to a particle that leaves the grid: the run stops with an error.
struct leaving_stops {
    enum class choice { stop, clamp, remove };
    static constexpr choice when_leaving = choice::stop;
};
/// ... it is put back on the wall, its velocity unchanged.
struct leaving_clamps {
    static constexpr auto when_leaving = leaving_stops::choice::clamp;
};
/// ... it is removed, with its mass and momentum.
struct leaving_removes {
    static constexpr auto when_leaving = leaving_stops::choice::remove;
};

/// Node fields that the step makes for the user to read, by `mpm.on_node(field, index)` after it.
///
///     solver mpm{grid, fmpm<4>{}, read_out<field::full_acceleration>{}};
template <class... F> struct read_out { using read_from_nodes = fields<F...>; };

namespace detail {

/// What a particle's way through the step is added to: nothing, what is kept until the step's end, or its place.
enum class where_to { nowhere, displacement, position };

}  // namespace detail
}  // namespace tamis
