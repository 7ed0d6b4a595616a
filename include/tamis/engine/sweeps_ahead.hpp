#pragma once
#include <tamis/engine/running_sums.hpp>
#include <tamis/engine/sweeps.hpp>

#include <vector>

namespace tamis::detail {

/// In 1D, besides: a pass that updates particles and makes the sums that the next step begins with, while particles are
/// in registers.
template <class S, class Shape, class Layout, class Execution, bool Moves> class sweeps_ahead
    : public sweeps<S, Shape, Layout, Execution, Moves> {
    using base = sweeps<S, Shape, Layout, Execution, Moves>;
    using base::functions_;
    using base::lattice_;
    using base::nodes_;
    using base::runner_;

  public:
    using typename base::lattice_type;
    using typename base::real;
    using typename base::T;
    using typename base::weigh_type;
    static constexpr int N = Shape::support;
    using base::base;

    /// As `gather_each`, and where `ahead`, as `scatter` does with what `give` makes of the particles after it; the
    /// sums must be in columns that are not gathered. False if those sums were not made, or lack particles that went to
    /// other cells.
    template <class Body, class Kernel, class Give>
    bool gather_and_scatter(Body& body, Kernel kernel, Give give, bool ahead) {
        using row_type = running_sums<S, N, typename Give::sums>;
        auto& store = body.store();
        ++store.updates;
        // Those look at the masses of nodes, which the sums would write over.
        if (store.has_edges()) ahead = false;
        const auto run_row = [&](std::size_t k, row_type& row) {
            return gather_and_scatter_row(store, k, kernel, give, ahead, row);
        };
        const std::size_t slabs = store.slabs();
        if (slabs == 1) {
            row_type row;
            const bool some_left = run_row(0, row);
            // A body may have lost all its particles.
            if (ahead && row.next() != row_type::nowhere) row.write_waiting(nodes_.columns());
            return ahead && !some_left;
        }
        // Where one slab's row ends the next may begin: what waits there is added when both are done.
        struct alignas(64) part {
            row_type row;
            bool some_left;
        };
        static_assert(std::is_trivially_destructible_v<part>);
        if (scratch_.size() < slabs * sizeof(part)) scratch_.resize(slabs * sizeof(part));
        auto* const parts = reinterpret_cast<part*>(scratch_.data());
        runner_.execution().for_each(slabs, [&](std::size_t k) {
            part& mine = *new (parts + k) part;
            mine.some_left = run_row(k, mine.row);
        });
        bool some_left = false;
        for (std::size_t k = 0; k < slabs; ++k) {
            some_left = some_left || parts[k].some_left;
            const row_type& row = parts[k].row;
            if (!ahead || row.next() == row_type::nowhere) continue;
            std::size_t after = k + 1;
            while (after < slabs && parts[after].row.next() == row_type::nowhere) ++after;
            if (after < slabs && store.first_place(after) == row.next())
                row.add_waiting(nodes_.columns());
            else
                row.write_waiting(nodes_.columns());
        }
        return ahead && !some_left;
    }

  private:
    std::vector<char, aligned_allocator<char>> scratch_;  // of gather_and_scatter, kept from step to step

    /// The tiles of slab k one after the other; true if particles left their cells. All that the loop needs is
    /// copied: what is stored might, for all the compiler knows, change anything else.
    template <class Store, class Kernel, class Give, class Row>
    TAMIS_FLATTEN bool gather_and_scatter_row(Store& store, std::size_t k, const Kernel& the_kernel,
                                              const Give& the_give, bool ahead, Row& row_out) {
        using sums_type = typename Row::sums_type;
        using G = typename Kernel::gathers;
        const auto columns = nodes_.columns();
        const lattice_type lattice = lattice_;
        Kernel kernel = the_kernel;
        const Give give = the_give;
        auto* const slots = store.slots.data();
        const std::uint32_t* const occupied = store.occupied.data();
        const tile* const tiles = store.tiles.data();
        Row row;
        bool some_left = false;
        for (const std::uint32_t j : store.row(k)) {
            const tile& t = tiles[j];
            const std::size_t place = t.node;
            if (t.marks != 0) [[unlikely]] {
                const auto [after, left] = gather_and_add(row, store, k, j, the_kernel, the_give, ahead);
                row = after;
                some_left = some_left || left;
                continue;
            }
            const std::uint32_t first = t.first, last = first + t.count;
            weigh_type weigh(functions_, lattice, t);
            frame<S> at = lattice.frame_of(t.at);
            nodes_around<S, Shape, typename G::looks_at> around(lattice, columns, place);
            sums_type sums[N];
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[a].set_zero(); });
            auto stay = T(real(0)) >= T(real(0));
            for (std::uint32_t s = first; s < last; ++s) {
                auto& slot = slots[s];
                stencil<S, N, true, G::by_offsets || Give::sums_by_offsets> st;
                weigh(st, slot);
                gathered<S, G> g;
                gather(around, st, T(at.spacing), g);
                kernel.update(slot, occupied[s], at, g, no_look{});
                if (occupied[s] != Store::full) base::clear_empty(slot);
                if constexpr (Moves) stay = stay & weigh.stays(slot);
                if (!ahead) continue;
                if constexpr (Moves) weigh(st, slot);
                const auto made = give.make(slot, at, gathered<S, typename Give::gathers>{});
                unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                    auto across = st.row(0);
                    auto dw = st.slope(a, across);
                    auto wx = st.offset(a, across, 0);
                    made.add(sums[a], node_factors<T, decltype(dw), decltype(wx)>{st.weight(a, across), dw, wx});
                });
            }
            if (ahead) row.add(sums, columns, place);
            // A tile has few slots here: which of them are left is not worth a jump in each.
            if constexpr (Moves)
                if (lane<T>::any(!stay)) [[unlikely]]
                    some_left = post_all(store, k, j) || some_left;
        }
        row_out = row;
        return some_left;
    }

    /// The same for a tile that takes a longer way. The row comes and goes by value: its sums stay in registers
    /// elsewhere.
    template <class Row> struct row_and_left {
        Row row;
        bool some_left;
    };
    template <class Row, class Store, class Kernel, class Give>
    TAMIS_NOINLINE row_and_left<Row> gather_and_add(Row row, Store& store, std::size_t k, std::size_t j, Kernel kernel,
                                                    const Give& give, bool ahead) {
        const tile& t = store.tiles[j];
        const bool had_edges = t.has(tile::on_edges);
        const some_slots left = base::gather_tile(store, k, t, store.slots.data() + t.first, kernel);
        if (ahead) {
            typename Row::sums_type sums[N];
            for (auto& sum : sums) sum.set_zero();
            weigh_type weigh(functions_, lattice_, t);
            frame<S> at = lattice_.frame_of(t.at);
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
                const auto& slot = std::as_const(store.slots[s]);
                stencil<S, N, true, Give::sums_by_offsets> st;
                weigh(st, slot);
                const auto made = give.make(slot, at, gathered<S, typename Give::gathers>{});
                for (int a = 0; a < N; ++a) {
                    auto across = st.row(0);
                    auto dw = st.slope(a, across);
                    auto wx = st.offset(a, across, 0);
                    made.add(sums[a], node_factors<T, decltype(dw), decltype(wx)>{st.weight(a, across), dw, wx});
                }
            }
            row.add(sums, nodes_.columns(), t.node);
        }
        return {row, (had_edges || left.any()) && post_all(store, k, j)};
    }
    /// Posts the particles of a tile that are in another cell; are there any, or any on an edge?
    template <class Store> TAMIS_NOINLINE bool post_all(Store& store, std::size_t k, std::size_t j) {
        if constexpr (Moves) {
            tile& t = store.tiles[j];
            weigh_type weigh(functions_, lattice_, t);
            bool any = t.has(tile::on_edges);
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s)
                any = any || lane<T>::any(!weigh.or_empty(weigh.stays(store.slots[s]), store.slots[s]));
            if (!any) return false;  // only lanes without a particle
            t.set(tile::on_edges, false);
            return post_leavers(store, lattice_, k, j, some_slots::all()) || t.has(tile::on_edges);
        } else
            return false;
    }
};

}  // namespace tamis::detail
