#pragma once
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

}  // namespace tamis
