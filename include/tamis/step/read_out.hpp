#pragma once
#include <tamis/core/fields.hpp>

namespace tamis {

/// Node fields that the step makes for the user to read, by `mpm.on_node(field, index)` after it.
///
///     solver mpm{grid, fmpm<4>{}, read_out<field::full_acceleration>{}};
template <class... F> struct read_out {
    /// The fields.
    using read_from_nodes = fields<F...>;
};

}  // namespace tamis
