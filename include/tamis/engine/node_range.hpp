#pragma once
#include <cstddef>
#include <limits>

namespace tamis::detail {

/// Nodes whose storage places are from `first` on, before `last`.
struct node_range {
    static constexpr std::size_t end = std::numeric_limits<std::size_t>::max();
    std::size_t first = 0, last = end;
};

}  // namespace tamis::detail
