#pragma once

namespace tamis {

/// Every step stops with an `error` that names the particle if a stress, a load or anything else that acts on nodes is
/// not a number. The default. It costs an addition for each component at each node.
struct checked {
    /// Are steps looked at?
    static constexpr bool checks_steps = true;
};
/// Steps are not looked at: for who measures what that costs. Places are, where particles move.
struct unchecked {
    /// Are steps looked at?
    static constexpr bool checks_steps = false;
};

}  // namespace tamis
