#pragma once
#include <tamis/transfer/near.hpp>

namespace tamis::detail {

/// What particles gather from nodes: S F for every field of a list, and the gradient of one field of so many
/// components.
template <class S, class List, int Components = S::dim> struct gathered {
    values<S, List> sums;
    // (c, d): slope along axis d of component c
    Eigen::Matrix<typename S::scalar, Components, S::dim, S::align> gradient;
};

/// No gradient is gathered.
template <class S, class List> struct gathered<S, List, 0> { values<S, List> sums; };

/// No gradient wanted.
struct no_field {};
template <class S, class Field> inline constexpr int components_of = Field::template components<S>;
template <class S> inline constexpr int components_of<S, no_field> = 0;

template <class List, class Gradient> struct with_gradient { using type = merge_as_is<List, fields<Gradient>>; };
template <class List> struct with_gradient<List, no_field> { using type = merge_as_is<List>; };

/// Component c of F at W places, from `Shift` places after a block's first one on (before it, if negative).
template <class S, class F, int Shift, class Nodes>
TAMIS_INLINE typename S::scalar at_shifted(const Nodes& nodes, std::ptrdiff_t first_of_block, int c) {
    using L = lane<typename S::scalar>;
    constexpr int W = S::width;
    if constexpr (S::dim == 1)
        return L::load(nodes.template column<F>(c) + first_of_block + Shift);
    else {
        constexpr int block = Shift >= 0 ? Shift / W : -((W - 1 - Shift) / W), k = Shift - block * W;
        const auto load = [&](int b) TAMIS_INLINE_LAMBDA {
            return L::load(nodes.template block<F>(first_of_block + b * W, c));
        };
        if constexpr (k == 0)
            return load(block);
        else
            return L::template slide<k>(load(block), load(block + 1));
    }
}

/// The values of nodes around a tile, brought together once for all its slots: nodes of a tile lie in many places, and
/// most are not aligned. Around a pivot, the other nodes' values are kept as differences from its.
template <class S, class Shape, class List> class nodes_around {
  public:
    using T = typename S::scalar;
    static constexpr int N = Shape::support, rows = lattice<S, Shape>::rows, pivot = pivot_of<Shape>;

    template <class Nodes>
    TAMIS_INLINE nodes_around(const lattice<S, Shape>& lattice, const Nodes& nodes, std::size_t first) {
        each_field<List>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
            using F = typename decltype(tag)::type;
            for (int c = 0; c < F::template components<S>; ++c)
                for (int r = 0; r < rows; ++r) {
                    T* const to = value_[place<F>(c) + r];
                    take_row<F>(to, nodes, first + lattice.row_offset(r), c);
                    if constexpr (pivot >= 0)
                        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                            if constexpr (a != pivot) to[a] -= to[pivot];
                        });
                }
        });
    }
    /// Component c of F, N values for each row.
    template <class F> TAMIS_INLINE auto values_of(int c) const { return value_ + place<F>(c); }

  private:
    template <class F, class Nodes>
    TAMIS_INLINE static void take_row(T* to, const Nodes& nodes, std::size_t first, int c) {
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            to[a] = at_shifted<S, F, a>(nodes, static_cast<std::ptrdiff_t>(first), c);
        });
    }
    /// Fields go by their own names here, those that share a column too.
    template <class F> static constexpr int place(int c) {
        int components = 0;
        bool found = false;
        each_field<List>::run([&](auto tag) {
            using G = typename decltype(tag)::type;
            found = found || std::same_as<F, G>;
            if (!found) components += G::template components<S>;
        });
        return (components + c) * rows;
    }
    T value_[values<S, List>::components * rows][N];
};

/// A component's value and slopes at W particles, from the axes up to one.
template <class T> struct local_value { T value, slope[3]; };

/// Axis by axis, x first: the tensor product is never multiplied out.
template <int Axes, bool Slope, class Shape, class S, int N, bool Slopes>
TAMIS_INLINE local_value<typename S::scalar> at_particles(const stencil<S, N, Slopes>& st,
                                                          const typename S::scalar (*nodes)[N]) {
    using T = typename S::scalar;
    const auto& axis = st.axis[Axes - 1];
    local_value<T> at;
    if constexpr (Axes == 1) {
        constexpr int pivot = pivot_of<Shape>;
        const T* const u = nodes[0];
        constexpr int first = pivot == 0 ? 1 : 0;
        at.value = axis.w[first] * u[first];
        if constexpr (pivot >= 0) at.value += u[pivot];
        if constexpr (Slope) at.slope[0] = axis.dw[first] * u[first];
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            if constexpr (a != pivot && a != first) {
                at.value += axis.w[a] * u[a];
                if constexpr (Slope) at.slope[0] += axis.dw[a] * u[a];
            }
        });
    } else {
        constexpr int stride = power(N, Axes - 2);
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            const auto inner = at_particles<Axes - 1, Slope, Shape>(st, nodes + a * stride);
            if constexpr (a == 0) {
                at.value = axis.w[0] * inner.value;
                if constexpr (Slope) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.slope[d] = axis.w[0] * inner.slope[d]; });
                    at.slope[Axes - 1] = axis.dw[0] * inner.value;
                }
            } else {
                at.value += axis.w[a] * inner.value;
                if constexpr (Slope) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.slope[d] += axis.w[a] * inner.slope[d]; });
                    at.slope[Axes - 1] += axis.dw[a] * inner.value;
                }
            }
        });
    }
    return at;
}

/// Gathers what `to` lists, and the gradient. Components go by one after the other: were they side by side, compilers
/// would move all loads of nodes out of the loop over slots, into registers that are not there.
template <class Gradient, class S, class Shape, class List, bool Slopes, class... F, int Components>
TAMIS_INLINE void gather(const nodes_around<S, Shape, List>& around, const stencil<S, Shape::support, Slopes>& st,
                         gathered<S, fields<F...>, Components>& to) {
    constexpr int D = S::dim;
    const auto field = [&](auto tag, auto wants_sum, auto& gathers) TAMIS_INLINE_LAMBDA {
        using G = std::remove_const_t<typename decltype(tag)::type>;
        constexpr bool slope = std::same_as<G, Gradient>;
        TAMIS_KEEP_LOOP
        for (int c = 0; c < G::template components<S>; ++c) {
            const auto at = at_particles<D, slope, Shape>(st, around.template values_of<G>(c));
            if constexpr (wants_sum) component<S>(gathers.sums.template get<G>(), c) = at.value;
            if constexpr (slope)
                unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA { gathers.gradient(c, int(d)) = at.slope[d]; });
        }
    };
    (field(std::type_identity<F>{}, std::true_type{}, to), ...);
    if constexpr (!std::same_as<Gradient, no_field> && !contains<fields<F...>, Gradient>)
        field(std::type_identity<Gradient>{}, std::false_type{}, to);
}

}  // namespace tamis::detail
