#pragma once
#include <tamis/shape/axis_weights.hpp>

namespace tamis {

/// Quadratic B-splines on the nodes' spacing: continuous slopes. In the half cell at a wall the function of the ghost
/// node beyond it is folded in by u_ghost = 2 u_wall - u_next, which leaves the linear functions there
/// (docs/method.md).
struct quadratic_spline {
    static constexpr std::string_view name = "quadratic";
    static constexpr int support = 3;
    static constexpr double shift = 0.5;
    static constexpr int pivot = 1;  // at least 1/2, at walls too
    template <class T> TAMIS_INLINE axis_weights<T, 3> on_axis(const T& r) const {
        const T s = T(1) - r, f = r - T(0.5);
        return {{T(0.5) * s * s, T(0.75) - f * f, T(0.5) * r * r}, {-s, -(f + f), r}};
    }
};

}  // namespace tamis
