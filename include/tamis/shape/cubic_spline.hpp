#pragma once
#include <tamis/shape/axis_weights.hpp>

namespace tamis {

/// Cubic B-splines on the nodes' spacing: continuous second derivatives. In the cell at a wall the function of the
/// ghost node beyond it is folded in by u_ghost = 2 u_wall - u_next, the end of a natural spline (docs/method.md).
struct cubic_spline {
    static constexpr std::string_view name = "cubic";
    static constexpr int support = 4;
    static constexpr double shift = 0;
    template <class T> TAMIS_INLINE axis_weights<T, 4> on_axis(const T& r) const {
        const T s = T(1) - r, r2 = r * r, s2 = s * s;
        using real = typename lane<T>::real;
        const T half = constant<T>(0.5), sixth(real(1) / real(6)), two_thirds(real(2) / real(3)),
                three_halves = constant<T>(1.5);
        return {{sixth * s2 * s, two_thirds - r2 + half * r2 * r, two_thirds - s2 + half * s2 * s, sixth * r2 * r},
                {-half * s2, three_halves * r2 - (r + r), (s + s) - three_halves * s2, half * r2}};
    }
};

}  // namespace tamis
