#pragma once
#include <tamis/shape/axis_weights.hpp>
#include <tamis/shape/slope.hpp>

namespace tamis::detail {

/// Which lanes of a tile lie in a cell at the lower or the upper wall, as 1 and 0, per axis.
template <class S> struct wall_lanes { typename S::scalar low[S::dim], high[S::dim]; };

/// In the place of a slope that nobody asked for.
struct no_slope {};
template <class T, int N> struct axis_values { T w[N]; };
/// With weights times the offsets of nodes from the particle, w (x_i - X).
template <class Axis, class T, int N> struct axis_with_offsets : Axis { T wx[N]; };

/// Weights of the nodes around W particles: the product of N weights per axis. Without `Slopes` it has none to keep: a
/// pass over particles keeps stencils in memory, and compilers would write them there.
/// `Offsets`: with weights times offsets of nodes too.
template <class S, int N, bool Slopes = true, bool Offsets = false> struct stencil {
    using T = typename S::scalar;
    using real = typename S::real;
    using weights = std::conditional_t<Slopes, axis_weights<T, N>, axis_values<T, N>>;
    std::conditional_t<Offsets, axis_with_offsets<weights, T, N>, weights> axis[S::dim];

    /// Slopes come per cell side and leave per unit of length. `particle`: what shapes that depend on it see of it.
    template <class Shape, class... Particle> TAMIS_INLINE void set(const Shape& shape, const typename S::vector& local,
                                                                    const T& inverse_spacing,
                                                                    const Particle&... particle) {
        unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
            axis_weights<T, N> from = [&]() TAMIS_INLINE_LAMBDA {
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

    /// Weights times offsets, from the weights: the functions reproduce places (linear reproduction), so that the
    /// offsets of an axis have no mean.
    TAMIS_INLINE void set_offsets(const T& spacing) requires Offsets {
        unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
            T place = axis[d].w[1];
            unroll<N - 2>([&](auto k) TAMIS_INLINE_LAMBDA { place += T(real(k + 2)) * axis[d].w[k + 2]; });
            unroll<N>([&](auto k)
                          TAMIS_INLINE_LAMBDA { axis[d].wx[k] = axis[d].w[k] * ((T(real(k)) - place) * spacing); });
        });
    }
    /// sum w (x_i - X)^2 along an axis.
    TAMIS_INLINE T second_moment(int d, const T& spacing) const requires Offsets {
        // The offsets have no mean, so that squares may be of the number of the node.
        T sum = axis[d].wx[1];
        unroll<N - 2>([&](auto k) TAMIS_INLINE_LAMBDA { sum += T(real(k + 2)) * axis[d].wx[k + 2]; });
        return sum * spacing;
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
    /// The weight times the offset of its node, in the form of a slope: a product over the axes of which one has the
    /// offset. `q`: the weight across, from `row`; `r`: the row's number.
    TAMIS_INLINE auto offset(int a, const across& q, int r) const {
        if constexpr (!Offsets)
            return no_slope{};
        else {
            const auto [d1, d2] = offsets_across(r);
            return slope_of<S>{axis[0].wx[a], axis[0].w[a], q.w, d1, d2};
        }
    }
    /// ... of the sum of a row's weights.
    TAMIS_INLINE auto offset_of_sum(int r) const {
        if constexpr (!Offsets)
            return no_slope{};
        else {
            const auto [d1, d2] = offsets_across(r);
            return slope_of_row<S>{d1, d2};
        }
    }
    /// Of the sum of a row's weights.
    TAMIS_INLINE static auto slope_of_sum(const across& q) {
        if constexpr (Slopes)
            return slope_of_row<S>{q.d1, q.d2};
        else
            return no_slope{};
    }

  private:
    struct two {
        T d1, d2;
    };
    TAMIS_INLINE two offsets_across(int r) const requires Offsets {
        [[maybe_unused]] const int a = r % N, b = r / N;
        if constexpr (S::dim == 1)
            return {T(real(0)), T(real(0))};
        else if constexpr (S::dim == 2)
            return {axis[1].wx[r], T(real(0))};
        else
            return {axis[1].wx[a] * axis[2].w[b], axis[1].w[a] * axis[2].wx[b]};
    }
    template <int Ghost, int Wall, int Next> TAMIS_INLINE static void fold_end(T (&w)[N], const T& at_wall) {
        const T g = w[Ghost] * at_wall;
        w[Ghost] -= g;
        w[Wall] += g + g;
        w[Next] -= g;
    }
};

}  // namespace tamis::detail
