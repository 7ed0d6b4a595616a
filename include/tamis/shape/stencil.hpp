#pragma once
#include <tamis/core/values.hpp>
#include <tamis/shape/axis_weights.hpp>

namespace tamis::detail {

/// Which lanes of a tile lie in a cell at the lower or the upper wall, as 1 and 0, per axis.
template <class S> struct wall_lanes { typename S::scalar low[S::dim], high[S::dim]; };

/// A tensor times the slope of a weight, multiplied out where it is added to something. Lives as long as its factors.
template <class S, class Tensor, class Slope> struct tensor_on_slope {
    const Tensor& t;
    const Slope& g;

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector all = S::vector::Constant(typename S::scalar(typename S::real(0)));
        all += *this;
        return all;
    }

    TAMIS_INLINE friend void operator+=(typename S::vector& to, const tensor_on_slope& product) {
        product.g.multiply(product.t, to, [](auto& sum, const auto&... a) TAMIS_INLINE_LAMBDA { sum += (a * ...); });
    }
    TAMIS_INLINE friend void operator-=(typename S::vector& to, const tensor_on_slope& product) {
        product.g.multiply(product.t, to, [](auto& sum, const auto&... a) TAMIS_INLINE_LAMBDA { sum -= (a * ...); });
    }
};

/// Slope of a weight that is a product over the axes. Times a tensor, it keeps what is the same along a row of nodes
/// apart, so that it is computed once a row.
template <class S> struct slope_of {
    using T = typename S::scalar;
    T dx, wx, w, d1, d2;  // slope and weight along x; weight over y and z, and its slopes

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector g;
        if constexpr (S::dim == 1)
            g[0] = dx;
        else {
            g[0] = dx * w;
            g[1] = wx * d1;
            if constexpr (S::dim == 3) g[2] = wx * d2;
        }
        return g;
    }
    TAMIS_INLINE T operator[](int d) const {
        const typename S::vector g = *this;
        return g[d];
    }
    template <class Tensor>
    friend TAMIS_INLINE tensor_on_slope<S, Tensor, slope_of> operator*(const Eigen::MatrixBase<Tensor>& t,
                                                                       const slope_of& g) {
        return {t.derived(), g};
    }
    /// to += sign t g, components in two fused operations.
    template <class Tensor, class Fused>
    TAMIS_INLINE void multiply(const Tensor& t, typename S::vector& to, Fused add) const {
        unroll<S::dim>([&](auto index) TAMIS_INLINE_LAMBDA {
            constexpr int c = index;
            if constexpr (S::dim == 1)
                add(to[c], t(c, 0), dx);
            else {
                add(to[c], T(t(c, 0) * w), dx);
                if constexpr (S::dim == 2)
                    add(to[c], T(t(c, 1) * d1), wx);
                else
                    add(to[c], T(t(c, 1) * d1 + t(c, 2) * d2), wx);
            }
        });
    }
};

/// As slope_of, of the sum of all weights of a row, which does not change along x.
template <class S> struct slope_of_row {
    using T = typename S::scalar;
    T d1, d2;

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector g;
        g[0] = T(typename S::real(0));
        if constexpr (S::dim > 1) g[1] = d1;
        if constexpr (S::dim == 3) g[2] = d2;
        return g;
    }
    template <class Tensor>
    friend TAMIS_INLINE tensor_on_slope<S, Tensor, slope_of_row> operator*(const Eigen::MatrixBase<Tensor>& t,
                                                                           const slope_of_row& g) {
        return {t.derived(), g};
    }
    template <class Tensor, class Fused>
    TAMIS_INLINE void multiply(const Tensor& t, typename S::vector& to, Fused add) const {
        static_assert(S::dim > 1);
        unroll<S::dim>([&](auto index) TAMIS_INLINE_LAMBDA {
            constexpr int c = index;
            if constexpr (S::dim == 2)
                add(to[c], T(t(c, 1) * d1));
            else  // as for the nodes of the row: compilers make it once
                add(to[c], T(t(c, 1) * d1 + t(c, 2) * d2));
        });
    }
};

/// In the place of a slope that nobody asked for.
struct no_slope {};
template <class T, int N> struct axis_values { T w[N]; };

/// Weights of the nodes around W particles: the product of N weights per axis. Without `Slopes` it has none to keep: a
/// pass over particles keeps stencils in memory, and compilers would write them there.
template <class S, int N, bool Slopes = true> struct stencil {
    using T = typename S::scalar;
    using real = typename S::real;
    std::conditional_t<Slopes, axis_weights<T, N>, axis_values<T, N>> axis[S::dim];

    /// Slopes come per cell side and leave per unit of length. `particle`: what shapes that depend on it see of it.
    template <class Shape, class... Particle> TAMIS_INLINE void set(const Shape& shape, const typename S::vector& local,
                                                                    const T& inverse_spacing,
                                                                    const Particle&... particle) {
        unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
            const axis_weights<T, N> from = [&]() TAMIS_INLINE_LAMBDA {
                if constexpr (sizeof...(Particle) > 0)
                    return shape.on_axis(local[int(d)], particle..., int(d));
                else
                    return shape.on_axis(local[int(d)]);
            }();
            // One by one: GCC would copy the struct by a call.
            unroll<N>([&](auto k) TAMIS_INLINE_LAMBDA {
                axis[d].w[k] = from.w[k];
                if constexpr (Slopes) axis[d].dw[k] = from.dw[k] * inverse_spacing;
            });
        });
    }

    /// Puts the weight of the ghost node beyond a wall on the nodes inside, as linear extrapolation does:
    /// u_ghost = 2 u_wall - u_next.
    TAMIS_INLINE void fold(const wall_lanes<S>& walls) {
        if constexpr (N >= 3)
            unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
                fold_end<0, 1, 2>(axis[d].w, walls.low[d]);
                fold_end<N - 1, N - 2, N - 3>(axis[d].w, walls.high[d]);
                if constexpr (Slopes) {
                    fold_end<0, 1, 2>(axis[d].dw, walls.low[d]);
                    fold_end<N - 1, N - 2, N - 3>(axis[d].dw, walls.high[d]);
                }
            });
    }

    struct weight_across {
        T w;
    };
    struct slopes_across {
        T w, d1, d2;
    };
    /// Product over y and z, and its slopes.
    using across = std::conditional_t<Slopes, slopes_across, weight_across>;
    TAMIS_INLINE across row(int r) const {
        [[maybe_unused]] const int a = r % N, b = r / N;
        if constexpr (!Slopes) {
            if constexpr (S::dim == 1)
                return {T(real(1))};
            else if constexpr (S::dim == 2)
                return {axis[1].w[r]};
            else
                return {axis[1].w[a] * axis[2].w[b]};
        } else if constexpr (S::dim == 1)
            return {T(real(1)), T(real(0)), T(real(0))};
        else if constexpr (S::dim == 2)
            return {axis[1].w[r], axis[1].dw[r], T(real(0))};
        else
            return {axis[1].w[a] * axis[2].w[b], axis[1].dw[a] * axis[2].w[b], axis[1].w[a] * axis[2].dw[b]};
    }
    TAMIS_INLINE T weight(int a, const across& q) const {
        if constexpr (S::dim == 1)
            return axis[0].w[a];
        else
            return axis[0].w[a] * q.w;
    }
    TAMIS_INLINE auto slope(int a, const across& q) const {
        if constexpr (Slopes)
            return slope_of<S>{axis[0].dw[a], axis[0].w[a], q.w, q.d1, q.d2};
        else
            return no_slope{};
    }
    /// Of the sum of a row's weights.
    TAMIS_INLINE static auto slope_of_sum(const across& q) {
        if constexpr (Slopes)
            return slope_of_row<S>{q.d1, q.d2};
        else
            return no_slope{};
    }

  private:
    template <int Ghost, int Wall, int Next> TAMIS_INLINE static void fold_end(T (&w)[N], const T& at_wall) {
        const T g = w[Ghost] * at_wall;
        w[Ghost] -= g;
        w[Wall] += g + g;
        w[Next] -= g;
    }
};

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
    template <class S, bool Slopes> TAMIS_INLINE static void recall(stencil<S, Shape::support, Slopes>& to,
                                                                    const value<S>& from,
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
