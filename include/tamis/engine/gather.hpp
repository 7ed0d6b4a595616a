#pragma once
#include <tamis/engine/node_table.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/shape/stencil.hpp>

#include <concepts>

namespace tamis::detail {

/// What particles gather from nodes: sums S F, gradients sum F (x) grad w, and moments sum w F (x) (x_i - X).
template <class Sums = fields<>, class Gradients = fields<>, class Moments = fields<>> struct gathers {
    using sums = Sums;
    using gradients = Gradients;
    using moments = Moments;
    static constexpr bool by_slopes = !std::same_as<Gradients, fields<>>;
    static constexpr bool by_offsets = !std::same_as<Moments, fields<>>;
    /// The node fields that are looked at.
    using looks_at = merge<Sums, Gradients, Moments>;
};
/// All that several parts of a pass gather, each once.
template <class... G> using merge_gathers =
    gathers<merge<typename G::sums...>, merge<typename G::gradients...>, merge<typename G::moments...>>;

/// Eigen wants single rows by rows.
template <class S, class F> using slopes_of_field =
    Eigen::Matrix<typename S::scalar, F::template components<S>, S::dim,
                  S::align | (F::template components<S> == 1 && S::dim > 1 ? Eigen::RowMajor : Eigen::ColMajor)>;
template <class S, class F> struct gradient_value { slopes_of_field<S, F> value; };
template <class S, class F> struct moment_value { slopes_of_field<S, F> value; };

/// What one slot's particles gathered.
template <class S, class Gathers> struct gathered;
template <class S, class Sums, class... G, class... M> struct gathered<S, gathers<Sums, fields<G...>, fields<M...>>>
    : gradient_value<S, G>..., moment_value<S, M>... {
    values<S, Sums> sums;
    /// sum w (x_i - X)^2 along each axis, where there are moments.
    typename S::scalar second_moment[sizeof...(M) > 0 ? S::dim : 1];

    template <class F> TAMIS_INLINE auto& sum() { return sums.template get<F>(); }
    template <class F> TAMIS_INLINE const auto& sum() const { return sums.template get<F>(); }
    /// (c, d): slope along axis d of component c.
    template <class F> TAMIS_INLINE auto& gradient() { return gradient_value<S, F>::value; }
    template <class F> TAMIS_INLINE const auto& gradient() const { return gradient_value<S, F>::value; }
    template <class F> TAMIS_INLINE auto& moment() { return moment_value<S, F>::value; }
    template <class F> TAMIS_INLINE const auto& moment() const { return moment_value<S, F>::value; }
};

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
    /// Said in a loop over slots: the values stay where they are. A compiler would take their loads out of the loop,
    /// into registers that are not there, and so copy all of them once for each tile.
    TAMIS_INLINE void stay_in_memory() {
#if defined(__GNUC__)
        if constexpr (values<S, List>::components * rows * N > TAMIS_VECTOR_REGISTERS / 2) asm("" : "+m"(value_));
#endif
    }
    /// Component c of F, N values for each row.
    template <class F> TAMIS_INLINE auto values_of(int c) const { return value_ + place<F>(c); }
    /// Other values for lane l, at the N nodes of a row.
    template <class F> void put_row(int c, int row, int l, const typename S::real (&values_of_nodes)[N]) {
        for (int a = 0; a < N; ++a) {
            auto* const lanes_of_node = reinterpret_cast<typename S::real*>(&value_[place<F>(c) + row][a]);
            lanes_of_node[l] = values_of_nodes[a];
            if (pivot >= 0 && a != pivot) lanes_of_node[l] -= values_of_nodes[pivot < 0 ? 0 : pivot];
        }
    }

  private:
    template <class F, class Nodes>
    TAMIS_INLINE static void take_row(T* to, const Nodes& nodes, std::size_t first, int c) {
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            to[a] = at_shifted<S, F, a>(nodes, static_cast<std::ptrdiff_t>(first), c);
        });
    }
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

/// A component's value, slopes and moments at W particles, from the axes up to one.
template <class T> struct local_value { T value, slope[3], moment[3]; };

/// Axis by axis, x first: the tensor product is never multiplied out.
template <int Axes, bool Slope, bool Moment, class Shape, class Stencil>
TAMIS_INLINE local_value<typename Stencil::T> at_particles(const Stencil& st,
                                                           const typename Stencil::T (*nodes)[Shape::support]) {
    using T = typename Stencil::T;
    constexpr int N = Shape::support;
    const auto& axis = st.axis[Axes - 1];
    local_value<T> at;
    if constexpr (Axes == 1) {
        // With a pivot the others are differences: weights add up to 1, slopes and moments to 0.
        constexpr int pivot = pivot_of<Shape>;
        const T* const u = nodes[0];
        constexpr int first = pivot == 0 ? 1 : 0;
        at.value = axis.w[first] * u[first];
        if constexpr (pivot >= 0) at.value += u[pivot];
        if constexpr (Slope) at.slope[0] = axis.dw[first] * u[first];
        if constexpr (Moment) at.moment[0] = axis.wx[first] * u[first];
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            if constexpr (a != pivot && a != first) {
                at.value += axis.w[a] * u[a];
                if constexpr (Slope) at.slope[0] += axis.dw[a] * u[a];
                if constexpr (Moment) at.moment[0] += axis.wx[a] * u[a];
            }
        });
    } else {
        constexpr int stride = power(N, Axes - 2);
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            auto inner = at_particles<Axes - 1, Slope, Moment, Shape>(st, nodes + a * stride);
            if constexpr (a == 0) {
                at.value = axis.w[0] * inner.value;
                if constexpr (Slope) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.slope[d] = axis.w[0] * inner.slope[d]; });
                    at.slope[Axes - 1] = axis.dw[0] * inner.value;
                }
                if constexpr (Moment) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.moment[d] = axis.w[0] * inner.moment[d]; });
                    at.moment[Axes - 1] = axis.wx[0] * inner.value;
                }
            } else {
                at.value += axis.w[a] * inner.value;
                if constexpr (Slope) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.slope[d] += axis.w[a] * inner.slope[d]; });
                    at.slope[Axes - 1] += axis.dw[a] * inner.value;
                }
                if constexpr (Moment) {
                    unroll<Axes - 1>([&](auto d) TAMIS_INLINE_LAMBDA { at.moment[d] += axis.w[a] * inner.moment[d]; });
                    at.moment[Axes - 1] += axis.wx[a] * inner.value;
                }
            }
        });
    }
    return at;
}

/// Gathers what `to` lists. Components go by one after the other: were they side by side, compilers would move all
/// loads of nodes out of the loop over slots, into registers that are not there.
template <class S, class Shape, class List, class Stencil, class Sums, class Gradients, class Moments>
TAMIS_INLINE void gather(const nodes_around<S, Shape, List>& around, const Stencil& st,
                         [[maybe_unused]] const typename S::scalar& spacing,
                         gathered<S, gathers<Sums, Gradients, Moments>>& to) {
    constexpr int D = S::dim;
    each_field<typename gathers<Sums, Gradients, Moments>::looks_at>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
        using G = typename decltype(tag)::type;
        constexpr bool slope = contains<Gradients, G>, moment = contains<Moments, G>;
        TAMIS_KEEP_LOOP
        for (int c = 0; c < G::template components<S>; ++c) {
            auto at = at_particles<D, slope, moment, Shape>(st, around.template values_of<G>(c));
            if constexpr (contains<Sums, G>) component<S>(to.template sum<G>(), c) = at.value;
            if constexpr (slope)
                unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA { to.template gradient<G>()(c, int(d)) = at.slope[d]; });
            if constexpr (moment)
                unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA { to.template moment<G>()(c, int(d)) = at.moment[d]; });
        }
    });
    if constexpr (!std::same_as<Moments, fields<>>)
        unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA { to.second_moment[d] = st.second_moment(d, spacing); });
}

}  // namespace tamis::detail
