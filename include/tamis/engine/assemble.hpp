#pragma once
#include <tamis/core/lanes.hpp>
#include <tamis/engine/mass_entries.hpp>
#include <tamis/engine/gather.hpp>
#include <tamis/engine/scatter.hpp>

#include <algorithm>

namespace tamis::detail {

/// Adds what the slots of a tile have in the full mass matrix, S_pi M_p S_pj, to its entries at the nodes.
///
/// Weights are products over the axes, and so are those of pairs of nodes: N (N + 1)/2 products per axis do for both
/// orders of a pair, hence 9 sums in 2D with linear functions, not 16 pairs of nodes. Sums over the slots are made for
/// the pairs along the inner axes at once, as many as registers hold; slots' products are kept while the others go by.
template <class S, class Shape> class matrix_of_tile {
    static constexpr int D = S::dim, N = Shape::support, W = S::width;
    using T = typename S::scalar;
    using entries = matrix_entries<D, N>;
    using matrix = field::mass_entries<N>;
    static constexpr int pairs = N * (N + 1) / 2;
    static constexpr int inner_axes = D > 1 && power(pairs, 2) <= sums_in_registers ? 2 : 1;
    static constexpr int inner = power(pairs, inner_axes), outer = power(pairs, D - inner_axes);
    struct pair {
        int low, high;
    };
    static constexpr auto pair_at = [] {
        std::array<pair, static_cast<std::size_t>(pairs)> all{};
        std::size_t k = 0;
        for (int a = 0; a < N; ++a)
            for (int b = a; b < N; ++b) all[k++] = {a, b};
        return all;
    }();
    static constexpr int place_of(int a, int b) {
        const int low = std::min(a, b), high = std::max(a, b);
        return low * N - low * (low - 1) / 2 + high - low;
    }
    struct products {
        T of[D][pairs];
    };

  public:
    template <class Nodes, class Slot, class Weigh, class Fetch>
    static TAMIS_FLATTEN void add(const lattice<S, Shape>& lattice, const Nodes& nodes, const Slot* slots,
                                  const tile& t, const Weigh& weigh, const Fetch& fetch) {
        const Slot* slot = slots + t.first;
        const auto multiply = [&](products& to, const Slot& from) TAMIS_INLINE_LAMBDA {
            stencil<S, N, false> st;
            weigh(st, from);
            const T m = from.template get<field::mass>();
            unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA {
                unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                    T w = st.axis[d].w[a];
                    if constexpr (d == 0) w *= m;
                    unroll<N - a>([&](auto b) TAMIS_INLINE_LAMBDA {
                        to.of[d][place_of(a, a + b)] = w * st.axis[d].w[int(a) + int(b)];
                    });
                });
            });
        };
        if constexpr (outer == 1) {
            T sums[inner];
            unroll<inner>([&](auto k) TAMIS_INLINE_LAMBDA { sums[k] = T(real(0)); });
            for (std::uint32_t s = 0; s < t.count; ++s) {
                if constexpr (D > 1) fetch(s);
                products of_slot;
                multiply(of_slot, slot[s]);
                sum(sums, of_slot, 0);
            }
            give(lattice, nodes, t.node, sums, 0);
        } else {
            constexpr int chunk = 16;
            for (std::uint32_t done = 0; done < t.count; done += chunk, slot += chunk) {
                const int n = static_cast<int>(std::min<std::uint32_t>(chunk, t.count - done));
                products of_slots[chunk];
                for (int s = 0; s < n; ++s) {
                    fetch(done + static_cast<std::uint32_t>(s));
                    multiply(of_slots[s], slot[s]);
                }
                for (int o = 0; o < outer; ++o) {
                    T sums[inner];
                    unroll<inner>([&](auto k) TAMIS_INLINE_LAMBDA { sums[k] = T(real(0)); });
                    for (int s = 0; s < n; ++s) sum(sums, of_slots[s], o);
                    give(lattice, nodes, t.node, sums, o);
                }
            }
        }
    }

  private:
    using real = typename S::real;

    /// Adds a slot's products, those of the outer axes of pair o.
    static TAMIS_INLINE void sum(T (&sums)[inner], const products& of_slot, int o) {
        const auto& x = of_slot.of[0];
        const auto add_row = [&](auto first, const T& factor) TAMIS_INLINE_LAMBDA {
            unroll<pairs>([&](auto k) TAMIS_INLINE_LAMBDA { sums[first * pairs + k] += factor * x[k]; });
        };
        if constexpr (D == 1)
            unroll<pairs>([&](auto k) TAMIS_INLINE_LAMBDA { sums[k] += x[k]; });
        else if constexpr (inner_axes == 2)
            unroll<pairs>([&](auto j) TAMIS_INLINE_LAMBDA {
                if constexpr (D == 2)
                    add_row(j, of_slot.of[1][j]);
                else
                    add_row(j, of_slot.of[1][j] * of_slot.of[D - 1][o]);
            });
        else if constexpr (D == 2)
            add_row(std::integral_constant<int, 0>{}, of_slot.of[1][o]);
        else
            add_row(std::integral_constant<int, 0>{}, of_slot.of[1][o % pairs] * of_slot.of[D - 1][o / pairs]);
    }
    /// Adds sums to the nodes of all pairs of rows that they belong to.
    template <class Nodes> static TAMIS_INLINE void give(const lattice<S, Shape>& lattice, const Nodes& nodes,
                                                         std::size_t first, const T (&sums)[inner], int o) {
        const auto of_rows = [&](const T* row_sums, pair y, pair z) TAMIS_INLINE_LAMBDA {
            const auto give_pair = [&](int low, int high) TAMIS_INLINE_LAMBDA {
                give_row(nodes, first + lattice.row_offset(low + z.low * N), row_sums,
                         entries::row(high - low, z.high - z.low));
            };
            give_pair(y.low, y.high);
            if (y.low != y.high && z.low != z.high) give_pair(y.high, y.low);
        };
        const auto at = [](int k) TAMIS_INLINE_LAMBDA { return pair_at[static_cast<std::size_t>(k)]; };
        if constexpr (D == 1)
            of_rows(sums, {0, 0}, {0, 0});
        else if constexpr (inner_axes == 2)
            unroll<pairs>([&](auto j) TAMIS_INLINE_LAMBDA {
                of_rows(sums + j * pairs, pair_at[j], D == 3 ? at(o) : pair{0, 0});
            });
        else
            of_rows(sums, at(o % pairs), at(o / pairs));
    }
    /// ... to the nodes of one row, whose partners are in the row-th after it.
    template <class Nodes>
    static TAMIS_INLINE void give_row(const Nodes& nodes, std::size_t first, const T* sums, int row) {
        unroll<N>([&](auto dx) TAMIS_INLINE_LAMBDA {
            give_entry<0, N - 1 - dx>(nodes, first, entries::of(row, dx),
                                      [&](auto a) TAMIS_INLINE_LAMBDA { return sums[place_of(a, a + dx)]; });
        });
        if (row == 0) return;
        unroll<N - 1>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int dx = -1 - k;
            give_entry<-dx, N - 1>(nodes, first, entries::of(row, dx),
                                   [&](auto a) TAMIS_INLINE_LAMBDA { return sums[place_of(a, a + dx)]; });
        });
    }
    /// ... one entry, of the nodes First to Last.
    template <int First, int Last, class Nodes, class Sum>
    static TAMIS_INLINE void give_entry(const Nodes& nodes, std::size_t first, int entry, const Sum& sum_of) {
        add_along_row<S, First, Last>(sum_of, [&](int block, const T& sum) TAMIS_INLINE_LAMBDA {
            auto* const p = nodes.template block<matrix>(first + static_cast<std::size_t>(block * W), entry);
            lane<T>::store(p, lane<T>::load(p) + sum);
        });
    }
};

/// use(space, nodes, place, Mf From) for blocks of W nodes, Mf the matrix whose entries are at the nodes; `steps`: from
/// a row of nodes to the others, in places.
template <class S, int N, class From, class Columns, class Steps, class Use>
TAMIS_FLATTEN void multiply_blocks(const Columns nodes, const std::uint32_t* blocks, std::size_t count,
                                   const Steps& steps, const Use& use) {
    using T = typename S::scalar;
    using matrix = field::mass_entries<N>;
    using entries = matrix_entries<S::dim, N>;
    for (std::size_t b = 0; b < count; ++b) {
        const auto place = static_cast<std::ptrdiff_t>(blocks[b]) * S::width;
        typename From::template value<S> sum;
        const auto add = [&](std::ptrdiff_t entry_row, auto entry_shift, int entry, std::ptrdiff_t row, auto dx)
                             TAMIS_INLINE_LAMBDA {
                                 const T m = at_shifted<S, matrix, entry_shift>(nodes, entry_row, entry);
                                 unroll<From::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                                     component<S>(sum, c) += m * at_shifted<S, From, dx>(nodes, row, c);
                                 });
                             };
        const std::integral_constant<int, 0> none;
        const T m = at_shifted<S, matrix, 0>(nodes, place, 0);
        unroll<From::template components<S>>(
            [&](auto c) TAMIS_INLINE_LAMBDA { component<S>(sum, c) = m * at_shifted<S, From, 0>(nodes, place, c); });
        unroll<N - 1>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr std::integral_constant<int, k + 1> after;
            constexpr std::integral_constant<int, -1 - k> before;
            add(place, none, entries::of(0, after), place, after);
            add(place, before, entries::of(0, after), place, before);
        });
        for (int row = 1; row < entries::rows; ++row) {
            const std::ptrdiff_t step = steps[static_cast<std::size_t>(row)];
            unroll<entries::across>([&](auto k) TAMIS_INLINE_LAMBDA {
                constexpr std::integral_constant<int, k - (N - 1)> dx;
                constexpr std::integral_constant<int, N - 1 - k> back;
                add(place, none, entries::of(row, dx), place + step, dx);
                add(place - step, back, entries::of(row, dx), place - step, back);
            });
        }
        use(std::type_identity<S>{}, nodes, place, sum);
    }
}

/// Mf u goes to `To`.
template <class To> struct store_product {
    template <class S, class Columns, class Product>
    TAMIS_INLINE void operator()(std::type_identity<S>, const Columns& nodes, std::ptrdiff_t place,
                                 const Product& product) const {
        unroll<To::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
            lane<typename S::scalar>::store(nodes.template block<To>(place, c), component<S>(product, c));
        });
    }
};
/// dv = A u = u - m^-1 Mf u goes to `Term`, if anybody reads it, and is added to `To`.
template <class From, class To, class Term> struct add_product_as_term {
    static_assert(!std::same_as<From, To> && !std::same_as<From, Term>);
    bool keeps;
    template <class S, class Columns, class Product>
    TAMIS_INLINE void operator()(std::type_identity<S>, const Columns& nodes, std::ptrdiff_t place,
                                 const Product& product) const {
        using T = typename S::scalar;
        using L = lane<T>;
        const T im = L::load(nodes.template block<field::inverse_mass>(place));
        unroll<From::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
            const T dv = L::load(nodes.template block<From>(place, c)) - im * component<S>(product, c);
            if (keeps) L::store(nodes.template block<Term>(place, c), dv);
            auto* const to = nodes.template block<To>(place, c);
            L::store(to, L::load(to) + dv);
        });
    }
};

}  // namespace tamis::detail
