#pragma once
#include <tamis/engine/terms.hpp>
#include <tamis/engine/tile.hpp>
#include <tamis/grid/lattice.hpp>

#include <algorithm>
#include <type_traits>

namespace tamis::detail {

/// Numbers that stay in registers while slots go by; four more hold what is added to them.
inline constexpr int sums_in_registers = TAMIS_VECTOR_REGISTERS - 4;
/// Numbers for all rows of nodes that are summed at once: some that go to memory cost less than weights kept there and
/// read again for every row. By benchmarks/step_2d with sixteen registers: 20 sums (linear functions) are faster at
/// once, 45 (quadratic) are not.
inline constexpr int sums_at_once = std::max(sums_in_registers, 24);

/// How many rows of N nodes, of the N that lie side by side, have their sums in registers at the same time: what rows
/// share is then loaded once.
constexpr int rows_together(int N, int components) {
    for (int rows = N; rows > 1; --rows)
        if (N % rows == 0 && rows * N * components <= sums_in_registers) return rows;
    return 1;
}

/// The fields of a list in groups whose sums, `nodes` for each component, fit into registers.
template <class S, int Nodes, class List> struct in_groups;
template <class S, int Nodes, class... F> struct in_groups<S, Nodes, fields<F...>> {
    static constexpr int count = sizeof...(F);
    static constexpr auto group_of = [] {
        constexpr int sums[] = {F::template components<S> * Nodes...};
        std::array<int, static_cast<std::size_t>(count)> group{};
        int current = 0, used = 0;
        for (int k = 0; k < count; ++k) {
            if (used > 0 && used + sums[k] > sums_in_registers) {
                ++current;
                used = 0;
            }
            used += sums[k];
            group[static_cast<std::size_t>(k)] = current;
        }
        return group;
    }();
    template <int G, std::size_t... K> static auto members(std::index_sequence<K...>) ->
        typename concatenate<fields<>, fields_if<group_of[K] == G, F>...>::type;
    template <int G> using group = decltype(members<G>(std::make_index_sequence<sizeof...(F)>{}));
    static constexpr int groups = group_of[static_cast<std::size_t>(count - 1)] + 1;
};

/// Sums of a group; what a kernel adds to other fields is for another time, and compilers leave it out.
template <class S, class Group, class All> struct group_sums {
    values<S, Group>& sums;
    values<S, All> unused;
    TAMIS_INLINE explicit group_sums(values<S, Group>& to) : sums(to) { unused.set_zero(); }
    template <class F> TAMIS_INLINE auto& get() {
        if constexpr (contains<Group, F>)
            return sums.template get<F>();
        else
            return unused.template get<F>();
    }
};

/// give(block, sum) for the blocks of W nodes that a row of sums belongs to; sum_of(a), First <= a <= Last, are W sums
/// for the places from a on. Unaligned adds at x, x + 1, x + 2 would each wait for the store before to leave the core,
/// so lanes are shifted in registers and added to whole blocks.
template <class S, int First, int Last, class Sum, class Give>
TAMIS_INLINE void add_along_row(const Sum& sum_of, const Give& give) {
    using T = typename S::scalar;
    using L = lane<T>;
    constexpr int W = S::width;
    if constexpr (W == 1)
        unroll<Last - First + 1>(
            [&](auto k) TAMIS_INLINE_LAMBDA { give(First + k, sum_of(std::integral_constant<int, First + k>{})); });
    else {
        constexpr int first_block = First / W, last_block = (Last + W - 1) / W;
        unroll<last_block - first_block + 1>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int block = first_block + k;
            // Those that begin in this block, and those that began in the one before.
            constexpr int from = std::max(First, (block - 1) * W + 1), to = std::min(Last, block * W + W - 1);
            const auto part = [&](auto a) TAMIS_INLINE_LAMBDA -> T {
                constexpr int shift = a - block * W;
                if constexpr (shift == 0)
                    return sum_of(a);
                else if constexpr (shift > 0)
                    return L::template up<shift>(sum_of(a));
                else
                    return L::template over<shift + W>(sum_of(a));
            };
            T sum = part(std::integral_constant<int, from>{});
            unroll<to - from>([&](auto j)
                                  TAMIS_INLINE_LAMBDA { sum += part(std::integral_constant<int, from + 1 + j>{}); });
            give(block, sum);
        });
    }
}

/// Adds a row of sums to the nodes. With a pivot, its sum is that of the whole row.
template <class S, int N, int Pivot, class Nodes, class Sums, class... F>
TAMIS_INLINE void flush(const Nodes& nodes, Sums (&sums)[N], std::size_t place, fields<F...>) {
    using T = typename S::scalar;
    using L = lane<T>;
    constexpr int W = S::width;
    const auto column = [&](auto tag, auto c) TAMIS_INLINE_LAMBDA {
        using G = typename decltype(tag)::type;
        T sum[N];
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sum[a] = component<S>(sums[a].template get<G>(), c); });
        if constexpr (Pivot >= 0)
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                if constexpr (a != Pivot) sum[Pivot] -= sum[a];
            });
        add_along_row<S, 0, N - 1>([&](auto a) TAMIS_INLINE_LAMBDA { return sum[a]; },
                                   [&](int block, const T& sum_of_block) TAMIS_INLINE_LAMBDA {
                                       auto* const p =
                                           nodes.template block<G>(place + static_cast<std::size_t>(block * W), c);
                                       L::store(p, L::load(p) + sum_of_block);
                                   });
    };
    (unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA { column(std::type_identity<F>{}, c); }), ...);
}

/// What a node is to a particle: its weight, slope, and weight times offset.
template <class T, class Slope, class Offset> struct node_factors {
    T w;
    Slope dw;
    Offset wx;
};

/// Adds to the nodes what all slots of a tile give them. `make(slot, stencil, frame)` gives a slot's terms (terms.hpp),
/// for sums of the fields `ToNodes`; `Slopes`, `Offsets`: does anybody look at those of weights? `SumsBySlopes`: do the
/// terms? `fetch(k)` asks for slot k of a tile that comes soon, `fetch(k, part, parts)`, if there, for a part of it.
/// Where the sums of all rows of nodes are too many at once, slots' weights are kept while rows go by, and a row is
/// flushed once per chunk.
template <class ToNodes, bool Slopes, bool Offsets, bool SumsBySlopes, class S, class Shape, class Nodes, class Slot,
          class Weigh, class Fetch, class Make>
TAMIS_FLATTEN void scatter_tile(const lattice<S, Shape>& lattice, const Nodes& nodes, Slot* slots, const tile& t,
                                const frame<S>& at, Weigh& weigh, Fetch& fetch, Make& make) {
    constexpr int N = Shape::support, rows = tamis::detail::lattice<S, Shape>::rows;
    constexpr int pivot = rows > 1 ? pivot_of<Shape> : -1;
    using T = typename S::scalar;
    using stencil_type = stencil<S, N, Slopes, Offsets>;
    Slot* slot = slots + t.first;
    const auto add = [&](auto group, auto& sums, const stencil_type& st, int r, const auto& made) TAMIS_INLINE_LAMBDA {
        using sums_type = group_sums<S, typename std::remove_cvref_t<decltype(group)>::type, ToNodes>;
        auto across = st.row(r);
        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
            sums_type to(sums[a]);
            if constexpr (a == pivot) {
                auto dw = st.slope_of_sum(across);
                auto wx = st.offset_of_sum(r);
                made.add(to, node_factors<T, decltype(dw), decltype(wx)>{across.w, dw, wx});
            } else {
                auto dw = st.slope(a, across);
                auto wx = st.offset(a, across, r);
                made.add(to, node_factors<T, decltype(dw), decltype(wx)>{st.weight(a, across), dw, wx});
            }
        });
    };
    if constexpr (rows == 1 || rows * N * values<S, ToNodes>::components <= sums_at_once) {
        values<S, ToNodes> sums[rows][N];
        unroll<rows>(
            [&](auto r) TAMIS_INLINE_LAMBDA { unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[r][a].set_zero(); }); });
        for (std::uint32_t s = 0; s < t.count; ++s) {
            if constexpr (rows > 1) fetch(s);
            stencil_type st;
            weigh(st, slot[s]);
            const auto made = make(slot[s], st, at);
            unroll<rows>([&](auto r) TAMIS_INLINE_LAMBDA { add(std::type_identity<ToNodes>{}, sums[r], st, r, made); });
        }
        unroll<rows>([&](auto r) TAMIS_INLINE_LAMBDA {
            flush<S, N, pivot>(nodes, sums[r], t.node + lattice.row_offset(r), ToNodes{});
        });
    } else {
        using groups = in_groups<S, N, ToNodes>;
        // Slopes, and what they are multiplied by, want those registers themselves: of two rows sums are spilled, also
        // where that takes 1 % fewer instructions (linear functions, and yet 4 to 6 % more time).
        constexpr int together = SumsBySlopes ? 1 : rows_together(N, values<S, ToNodes>::components);
        // What asks for a part with each slot and group of rows holds the core up less than what asks for all before,
        // but it wants registers itself.
        constexpr bool in_parts = TAMIS_VECTOR_REGISTERS >= 32 && std::is_invocable_v<Fetch&, std::uint32_t, int, int>;
        constexpr int chunk = 16;
        for (std::uint32_t done = 0; done < t.count; done += chunk, slot += chunk) {
            const int n = static_cast<int>(std::min<std::uint32_t>(chunk, t.count - done));
            stencil_type st[chunk];
            using made_type = decltype(make(*slot, st[0], at));
            made_type made[chunk];
            for (int s = 0; s < n; ++s) {
                if constexpr (!in_parts) fetch(done + static_cast<std::uint32_t>(s));
                weigh(st[s], slot[s]);
                // In place: copies would go through memory in smaller pieces.
                new (&made[s]) made_type(make(slot[s], st[s], at));
            }
            [[maybe_unused]] constexpr int parts = rows / together * groups::groups;
            for (int r = 0; r < rows; r += together)
                unroll<groups::groups>([&](auto g) TAMIS_INLINE_LAMBDA {
                    using group = typename groups::template group<g>;
                    values<S, group> sums[together][N];
                    unroll<together>([&](auto k) TAMIS_INLINE_LAMBDA {
                        unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[k][a].set_zero(); });
                    });
                    for (int s = 0; s < n; ++s) {
                        if constexpr (in_parts)
                            fetch(done + static_cast<std::uint32_t>(s), r / together * groups::groups + g, parts);
                        unroll<together>([&](auto k) TAMIS_INLINE_LAMBDA {
                            add(std::type_identity<group>{}, sums[k], st[s], r + k, made[s]);
                        });
                    }
                    unroll<together>([&](auto k) TAMIS_INLINE_LAMBDA {
                        flush<S, N, pivot>(nodes, sums[k], t.node + lattice.row_offset(r + k), group{});
                    });
                });
        }
    }
}

}  // namespace tamis::detail
