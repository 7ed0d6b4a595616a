#pragma once
#include <tamis/core/config.hpp>

#include <cstddef>

namespace tamis::detail {

/// Asks for the first bytes of something that will be needed soon, to be read or to be written; of `parts` calls each
/// asks for some of its cache lines. Lines asked for to be written are taken from other processors and may count as
/// changed, so that they go back to memory: what is only read is not asked for in that way.
template <bool Writes, class Thing> TAMIS_INLINE void prefetch([[maybe_unused]] const Thing* at,
                                                               [[maybe_unused]] std::size_t bytes,
                                                               [[maybe_unused]] int part, [[maybe_unused]] int parts) {
#if defined(__GNUC__)
    constexpr std::size_t line = 64;
    const char* const first = reinterpret_cast<const char*>(at);
    const int lines = static_cast<int>((bytes + line - 1) / line);
    for (int l = part; l < lines; l += parts) __builtin_prefetch(first + static_cast<std::size_t>(l) * line, Writes);
    // Things that begin in the middle of a line end in one more.
    if constexpr (sizeof(Thing) % line != 0)
        if (part == 0) __builtin_prefetch(first + bytes - 1, Writes);
#endif
}

}  // namespace tamis::detail
