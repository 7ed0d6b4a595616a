#pragma once
#include <tamis/core/config.hpp>

#include <cstddef>

namespace tamis::detail {

// What a pass over particles may go without.

/// Nothing follows.
struct no_more {
    TAMIS_INLINE void operator()(const auto&...) const {}
};
/// A kernel that looks at no other nodes than those it gathers from.
struct no_look {
    TAMIS_INLINE no_look around(const auto&, std::size_t) const { return {}; }
    TAMIS_INLINE no_look operator()(const auto&, const no_look&, const auto&) const { return {}; }
};

/// Nothing is in the way of particles.
struct no_fence {
    static constexpr bool there = false;
};

/// What the particles that a kernel moves may not pass.
template <bool Moves, class Kernel> auto fence_of(const Kernel& kernel) {
    if constexpr (Moves && requires { kernel.fence(); })
        return kernel.fence();
    else
        return no_fence{};
}

}  // namespace tamis::detail
