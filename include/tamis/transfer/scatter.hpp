#pragma once
#include <tamis/transfer/near.hpp>
#include <tamis/particles/tile.hpp>

namespace tamis::detail {

/// Adds a row of sums to the node columns. Unaligned adds at x, x + 1, x + 2 would each wait for the store before to
/// leave the core, so lanes are shifted in registers and added to two aligned vectors.
template <class S, int N, class Nodes, class Sums, class... F>
TAMIS_INLINE void flush(const Nodes& nodes, Sums (&sums)[N], std::size_t place, fields<F...>) {
    using T = typename S::scalar;
    using L = lane<T>;
    constexpr int W = S::width;
    const auto column = [&](auto tag, auto c) TAMIS_INLINE_LAMBDA {
        using G = typename decltype(tag)::type;
        auto* p = nodes.template column<G>(c) + place;
        if constexpr (W < N - 1 || W == 1) {
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                L::store(p + a, L::load(p + a) + component<S>(sums[a].template get<G>(), c));
            });
        } else {
            T low = component<S>(sums[0].template get<G>(), c) +
                    L::template up<1>(component<S>(sums[1].template get<G>(), c));
            T high = L::template over<1>(component<S>(sums[1].template get<G>(), c));
            unroll<N - 2>([&](auto a) TAMIS_INLINE_LAMBDA {
                low += L::template up<a + 2>(component<S>(sums[a + 2].template get<G>(), c));
                high += L::template over<a + 2>(component<S>(sums[a + 2].template get<G>(), c));
            });
            L::store(p, L::load(p) + low);
            L::store(p + W, L::load(p + W) + high);
        }
    };
    (unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA { column(std::type_identity<F>{}, c); }), ...);
}

/// Runs `kernel(p, near, made)`, or `kernel(p, near, made, a)` with the place a of the node in its row, for all slots
/// of a tile and adds what it put on the nodes. `make(slot, stencil, frame)` gives what is the same for every node of a
/// slot. Where there is more than one row of nodes, slots' weights are kept while rows go by, and a row is flushed once
/// per chunk.
template <class Shown, class ToNodes, class S, class Shape, class Nodes, class Slot, class Weigh, class Make,
          class Kernel>
TAMIS_FLATTEN void scatter_tile(const lattice<S, Shape>& lattice, const Nodes& nodes, Slot* slots, const tile& t,
                                const frame<S>& at, Weigh& weigh, Make& make, Kernel& kernel) {
    constexpr int N = Shape::support, rows = tamis::detail::lattice<S, Shape>::rows;
    using sums_type = values<S, ToNodes>;
    Slot* slot = slots + t.first;
    const auto add = [&](sums_type(&sums)[N], Slot& from, const stencil<S, N>& st, const auto& across,
                         const auto& made) TAMIS_INLINE_LAMBDA {
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            const one_node<S, sums_type, ToNodes> near{{{sums[a]}, st.weight(a, across), st.slope(a, across)}};
            const slot_row<S, Slot, Shown> p{from, at};
            if constexpr (requires { requires Kernel::by_place; })
                kernel(p, near, made, a);
            else
                kernel(p, near, made);
        });
    };
    if constexpr (rows == 1) {
        sums_type sums[N];
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[a].set_zero(); });
        for (std::uint32_t s = 0; s < t.count; ++s) {
            stencil<S, N> st;
            weigh(st, slot[s]);
            const auto made = make(slot[s], st, at);
            add(sums, slot[s], st, st.row(0), made);
        }
        flush<S, N>(nodes, sums, t.node, ToNodes{});
    } else {
        constexpr int chunk = 16;
        for (std::uint32_t done = 0; done < t.count; done += chunk, slot += chunk) {
            const int n = static_cast<int>(std::min<std::uint32_t>(chunk, t.count - done));
            stencil<S, N> st[chunk];
            decltype(make(*slot, st[0], at)) made[chunk];
            for (int s = 0; s < n; ++s) {
                weigh(st[s], slot[s]);
                made[s] = make(slot[s], st[s], at);
            }
            for (int r = 0; r < rows; ++r) {
                sums_type sums[N];
                unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[a].set_zero(); });
                for (int s = 0; s < n; ++s) add(sums, slot[s], st[s], st[s].row(r), made[s]);
                flush<S, N>(nodes, sums, t.node + lattice.row_offset(r), ToNodes{});
            }
        }
    }
}

}  // namespace tamis::detail
