#pragma once
#include <tamis/shape/stencil.hpp>

namespace tamis::detail {

/// Weights kept with a particle that never moves: per axis N weights, and N slopes where the shape's slopes vary.
template <class Shape> struct held_weights {
    static constexpr std::string_view name = "weights";
    static constexpr int per_axis = Shape::support * (constant_slope<Shape> ? 1 : 2);
    template <class S> using value = Eigen::Matrix<typename S::scalar, S::dim * per_axis, 1, S::align>;
    template <class S> static constexpr int components = (S::dim * per_axis);

    template <class S> TAMIS_INLINE static void keep(value<S>& to, const stencil<S, Shape::support>& from) {
        constexpr int N = Shape::support;
        unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
            unroll<N>([&](auto k) TAMIS_INLINE_LAMBDA {
                to[d * per_axis + k] = from.axis[d].w[k];
                if constexpr (!constant_slope<Shape>) to[d * per_axis + N + k] = from.axis[d].dw[k];
            });
        });
    }
    template <class S, bool Slopes, bool Offsets>
    TAMIS_INLINE static void recall(stencil<S, Shape::support, Slopes, Offsets>& to, const value<S>& from,
                                    const typename S::scalar& inverse_spacing) {
        constexpr int N = Shape::support;
        unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
            unroll<N>([&](auto k) TAMIS_INLINE_LAMBDA {
                to.axis[d].w[k] = from[d * per_axis + k];
                if constexpr (!Slopes)
                    return;
                else if constexpr (constant_slope<Shape>) {
                    static_assert(N == 2, "tamis: only two functions with constant slopes are a partition of unity");
                    to.axis[d].dw[k] = k == 0 ? -inverse_spacing : inverse_spacing;
                } else
                    to.axis[d].dw[k] = from[d * per_axis + N + k];
            });
        });
    }
    /// Place in the cell along axis d, from component(c) of what was kept: the functions reproduce it (linear
    /// reproduction).
    template <class S, class Component> TAMIS_INLINE static auto place(int d, const Component& component) {
        using number = std::remove_cvref_t<decltype(component(0))>;
        number r(typename S::real(Shape::shift - ghosts<Shape>));
        for (int k = 1; k < Shape::support; ++k) r += number(typename S::real(k)) * component(d * per_axis + k);
        return r;
    }
};

}  // namespace tamis::detail
