#pragma once
#include <tamis/engine/absent.hpp>
#include <tamis/engine/gather.hpp>
#include <tamis/engine/leavers.hpp>
#include <tamis/engine/massless.hpp>
#include <tamis/engine/node_sweeps.hpp>
#include <tamis/engine/scatter.hpp>
#include <tamis/engine/weigh.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>

namespace tamis::detail {

/// Passes over nodes, and over the particles of one body. They depend on as little of a composition as they can, so
/// that compositions of one program share them.
///
/// A pass over particles is said by a kernel: `gathers`, what particles gather from nodes; `update(slot, occupied,
/// frame, gathered)`, what becomes of them, if it `updates`; `sums`, the node fields that they add to; `make(slot,
/// frame, gathered)`, the terms they give (terms.hpp); `reads`, the particle fields that it looks at; `look()`, other
/// nodes that it looks at, or `no_look`; `moves`: does it change places?; `fence()`: what they may not pass then.
/// Weights are made from `Places` that particles store, or kept.
template <class S, class Shape, class Layout, class Execution, bool Moves, bool Places = Moves> class sweeps
    : public node_sweeps<S, Shape, Layout, Execution> {
    using base = node_sweeps<S, Shape, Layout, Execution>;

  protected:
    using base::lattice_;
    using base::nodes_;
    using base::runner_;

  public:
    using typename base::lattice_type;
    using typename base::nodes_type;
    using typename base::real;
    using typename base::T;
    using weigh_type = tile_weights<S, Shape, Places>;
    static constexpr int W = S::width, N = Shape::support;

    sweeps(const Shape& functions, const lattice_type& lattice, const Execution& run)
        : base(lattice, run), functions_(functions) {}

    /// Sums over the particles of a body: what `kernel.make` gives is added to the nodes, after what the kernel gathers
    /// and updates.
    template <class Body, class Kernel> void scatter(Body& body, Kernel kernel) { scatter_onto(nodes_, body, kernel); }
    /// The same, and what the particles have in the full mass matrix, added to its entries while they are at hand.
    template <class Body, class Kernel> void scatter_and_assemble(Body& body, Kernel kernel) {
        auto& store = body.store();
        scatter_onto(nodes_, body, kernel, [this, &store](const tile& t, const weigh_type& weigh) {
            const auto at_hand = [](std::uint32_t) TAMIS_INLINE_LAMBDA {};
            matrix_of_tile<S, Shape>::add(lattice_, nodes_, store.slots.data(), t, weigh, at_hand);
        });
    }
    /// The same onto another table of nodes; `also(tile, its weights)` follows for each tile.
    template <class Table, class Body, class Kernel, class Also = no_more>
    void scatter_onto(Table& table, Body& body, Kernel kernel, Also also = {}) {
        auto& store = body.store();
        using G = typename Kernel::gathers;
        constexpr bool looks = !std::same_as<typename G::looks_at, fields<>>;
        constexpr int ahead = ask_ahead<typename Body::store_type, Kernel>;
        static_assert(!Kernel::moves, "particles move in a pass that does not sum: weights are those of their places");
        const bool mail = store.has_mail();
        if constexpr (Kernel::updates) ++store.updates;
        each_tile_by_colour<ahead>(store, [this, &table, &store, mail, kernel, also](tile& t, const auto* soon) {
            if (mail) store.deliver(t);
            weigh_type weigh(functions_, lattice_, t);
            const auto fetch = fetcher<Kernel>(store, soon);
            frame<S> at = lattice_.frame_of(t.at);
            constexpr bool slopes = G::by_slopes || Kernel::sums_by_slopes;
            constexpr bool offsets = G::by_offsets || Kernel::sums_by_offsets;
            constexpr bool sums_by = Kernel::sums_by_slopes || Kernel::sums_by_offsets;
            const auto sum = [&](auto& make) TAMIS_INLINE_LAMBDA {
                scatter_tile<typename Kernel::sums, slopes, offsets, sums_by>(lattice_, table, store.slots.data(), t,
                                                                              at, weigh, fetch, make);
            };
            if constexpr (!looks && !Kernel::updates) {
                const auto make = [&](const auto& slot, const auto&, const auto& in)
                                      TAMIS_INLINE_LAMBDA { return kernel.make(slot, in, gathered<S, G>{}); };
                sum(make);
            } else {
                auto around = around_of<G>(nodes_, t);
                [[maybe_unused]] const auto flow_around = kernel.look().around(lattice_, t.node);
                const auto make = [&](auto& slot, const auto& st, const auto& in) TAMIS_INLINE_LAMBDA {
                    gathered<S, G> g;
                    around.stay_in_memory();
                    gather(around, st, T(lattice_.grid().spacing()), g);
                    if constexpr (Kernel::updates) {
                        const auto s = static_cast<std::uint32_t>(&slot - store.slots.data());
                        kernel.update(slot, store.occupied[s], in, g, kernel.look()(around, flow_around, st));
                        if (store.occupied[s] != std::remove_reference_t<decltype(store)>::full) clear_empty(slot);
                    }
                    return kernel.make(std::as_const(slot), in, g);
                };
                sum(make);
            }
            also(t, weigh);
        });
        if (mail) runner_.at_end([&store] { store.mail_delivered(); });
    }

    /// Adds what the particles of a body have in the full mass matrix to its entries at the nodes.
    template <class Body> void assemble_matrix(Body& body) {
        auto& store = body.store();
        using reads = merge<typename weigh_type::reads, fields<field::mass>>;
        each_tile_by_colour<tiles_ahead>(store, [this, &store](const tile& t, const auto* soon) {
            weigh_type weigh(functions_, lattice_, t);
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads{}); };
            matrix_of_tile<S, Shape>::add(lattice_, nodes_, store.slots.data(), t, weigh, fetch);
        });
    }

    /// f(i, j, S_pi M_p S_pj) for every particle of a body and all storage places i, j of nodes around it; one thread.
    template <class Body, class F> void each_weight_pair(const Body& body, F f) {
        constexpr int D = S::dim, count = power(N, D);
        const auto& store = body.store();
        for (const tile& t : store.tiles) {
            const weigh_type weigh(functions_, lattice_, t);
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
                stencil<S, N, false> st;
                weigh(st, store.slots[s]);
                real mass[W], weight[count][W];
                lane<T>::store(mass, store.slots[s].template get<field::mass>());
                for (int k = 0; k < count; ++k) lane<T>::store(weight[k], st.weight(k % N, st.row(k / N)));
                const auto place = [&](int k, int l) {
                    return t.node + lattice_.row_offset(k / N) + static_cast<std::size_t>(k % N + l);
                };
                for (int l = 0; l < W; ++l)
                    for (int i = 0; i < count && (store.occupied[s] >> l & 1u); ++i)
                        for (int j = 0; j < count; ++j)
                            f(place(i, l), place(j, l), weight[i][l] * mass[l] * weight[j][l]);
            }
        }
    }

    /// Gathers for every slot of a body and updates it. Particles that are in another cell then are posted.
    template <class Body, class Kernel> void gather_each(Body& body, Kernel kernel) {
        auto& store = body.store();
        ++store.updates;
        runner_.over_slabs(store.slabs(), [this, &store, kernel](std::size_t k) {
            Kernel own = kernel;
            store.template each_tile_and_soon<tiles_ahead>(k, [&](std::size_t j, const auto* soon) {
                [[maybe_unused]] some_slots left = gather_tile(store, k, store.tiles[j], soon, own);
                if constexpr (Moves && Kernel::moves) {
                    // Those that were on an edge may be there no more.
                    tile& t = store.tiles[j];
                    if (t.has(tile::on_edges)) left = some_slots::all();
                    t.set(tile::on_edges, false);
                    if (left.any()) [[unlikely]]
                        post_leavers(store, lattice_, k, j, left);
                }
            });
        });
    }

  protected:
    const Shape& functions_;

    // Nodes without mass take no part in gradients.
    using mass_field = std::conditional_t<Moves, field::mass, field::inverse_mass>;
    template <class G> static constexpr bool mends = G::by_slopes&& stores<Layout, mass_field>;
    /// Values of nodes around a tile.
    template <class G, class Nodes> TAMIS_INLINE auto around_of(const Nodes& nodes, const tile& t) const {
        using around_type = nodes_around<S, Shape, typename G::looks_at>;
        around_type around(lattice_, nodes, t.node);
        if constexpr (mends<G>)
            if (t.has(tile::on_edges)) [[unlikely]]
                around = massless<S, Shape, mass_field, typename G::gradients>::template mended<around_type>(lattice_,
                                                                                                             nodes_, t);
        return around;
    }

    /// Empty lanes stay exactly empty, whatever the law made of them: by select, for 0 times NaN is NaN.
    template <class Slot> TAMIS_INLINE static void clear_empty(Slot& slot) {
        const T zero(real(0));
        const auto keep = slot.template get<field::mass>() > zero;
        auto* component = reinterpret_cast<T*>(&slot);
        for (int c = 0; c < Slot::components; ++c) component[c] = select(keep, component[c], zero);
    }

    template <class Store, class Kernel>
    TAMIS_FLATTEN some_slots gather_tile(Store& store, std::size_t slab, const tile& t,
                                         const typename Store::slot* soon, Kernel& kernel) {
        using G = typename Kernel::gathers;
        weigh_type weigh(functions_, lattice_, t);
        frame<S> at = lattice_.frame_of(t.at);
        auto around = around_of<G>(nodes_, t);
        [[maybe_unused]] const auto flow_around = kernel.look().around(lattice_, t.node);
        some_slots left;
        const auto fence = fence_of<Moves>(kernel);
        if constexpr (fence.there)
            if (t.has(tile::fenced)) [[unlikely]]
                fence.keep(store, slab, t);
        auto* const slots = store.slots.data() + t.first;
        const auto* const occupied = store.occupied.data() + t.first;
        for (std::size_t k = 0, count = t.count; k < count; ++k) {
            auto& slot = slots[k];
            if constexpr (S::dim > 1) store.fetch_to_write(soon + k);
            stencil<S, N, true, G::by_offsets> st;
            weigh(st, slot);
            gathered<S, G> g;
            around.stay_in_memory();
            gather(around, st, T(at.spacing), g);
            kernel.update(slot, occupied[k], at, g, kernel.look()(around, flow_around, st));
            if constexpr (Moves && Kernel::moves) {
                auto stay = weigh.stays(slot);
                if (occupied[k] != Store::full) {
                    clear_empty(slot);
                    stay = weigh.or_empty(stay, slot);
                }
                if (lane<T>::any(!stay)) left.add(static_cast<std::uint32_t>(k));
            } else if (occupied[k] != Store::full)
                clear_empty(slot);
        }
        if constexpr (fence.there)
            if (t.has(tile::fenced)) [[unlikely]]
                fence.stop(store, lattice_, slab, t);
        return left;
    }

  private:
    // How many tiles before their turn slots are asked for: whole slots, two tiles ahead, take much of a core's own
    // cache; half a slot or less comes late one tile ahead.
    static constexpr int tiles_ahead = 1, tiles_ahead_of_few_fields = 3;

    template <class Kernel> using reads_of = merge<typename weigh_type::reads, typename Kernel::reads>;
    /// Does a kernel only gather and sum, so that it asks for few fields, early and in parts?
    template <class Kernel> static constexpr bool only_spreads =
        !Kernel::updates && !std::same_as<typename Kernel::gathers::looks_at, fields<>>;
    template <class Store, class Kernel>
    static constexpr int ask_ahead = only_spreads<Kernel> &&
                                             2 * Store::components_to(reads_of<Kernel>{}) <= Store::components
                                         ? tiles_ahead_of_few_fields
                                         : tiles_ahead;
    template <class Kernel, class Store, class Slot> static auto fetcher(const Store& store, const Slot* soon) {
        if constexpr (Kernel::updates)
            return [&store, soon](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch_to_write(soon + k); };
        else if constexpr (only_spreads<Kernel>)
            return [&store, soon](std::uint32_t k, int part = 0, int parts = 1)
                       TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads_of<Kernel>{}, part, parts); };
        else
            return [&store, soon](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads_of<Kernel>{}); };
    }
    template <int Ahead, class Store, class F> void each_tile_by_colour(Store& store, F f) {
        runner_.by_colour(store.slabs(), [&store, f](std::size_t k) {
            store.template each_tile_and_soon<Ahead>(k,
                                                     [&](std::size_t j, const auto* soon) { f(store.tiles[j], soon); });
        });
    }
};

}  // namespace tamis::detail
