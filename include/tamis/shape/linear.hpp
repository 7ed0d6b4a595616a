#pragma once
#include <tamis/shape/axis_weights.hpp>

namespace tamis {

/// Piecewise linear functions (tents), the original MPM. First slopes jump at nodes: moving particles that cross a node
/// feel a kick.
struct linear {
    static constexpr std::string_view name = "linear";
    static constexpr int support = 2;
    static constexpr double shift = 0;
    static constexpr bool constant_slope = true;
    template <class T> TAMIS_INLINE axis_weights<T, 2> on_axis(const T& r) const {
        return {{T(1) - r, r}, {T(-1), T(1)}};
    }
};

}  // namespace tamis
