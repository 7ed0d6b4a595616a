#pragma once
#include <tamis/grid/node_table.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/solver/composition.hpp>
#include <tamis/transfer/body_load.hpp>
#include <tamis/transfer/gather.hpp>
#include <tamis/transfer/scatter.hpp>
#include <tamis/transfer/strain.hpp>

namespace tamis::detail {

/// Weights of the particles of one tile: made from their places, or recalled where they are held.
template <class C> struct tile_weights {
    using S = typename C::S;
    using shape = typename C::shape;
    const shape& functions;
    typename S::scalar inverse_spacing;
    bool at_wall;
    wall_lanes<S> walls;

    tile_weights(const shape& the_functions, const lattice<S, shape>& lattice, const tile& t)
        : functions(the_functions),
          inverse_spacing(lattice.inverse_spacing()),
          at_wall(C::moves && lattice.at_wall(t.at)) {
        if (at_wall) walls = lattice.walls_of(t.at);
    }
    template <class Slot> TAMIS_INLINE void operator()(stencil<S, shape::support>& st, const Slot& slot) const {
        if constexpr (C::moves) {
            st.set(functions, slot.template get<field::position>(), inverse_spacing);
            if constexpr (ghosts < shape >> 0)
                if (at_wall) st.fold(walls);
        } else
            held_weights<shape>::template recall<S>(st, slot.template get<held_weights<shape>>(), inverse_spacing);
    }
};

/// Passes over nodes, and over the particles of one body, for a composition C.
template <class C> class sweeps {
  public:
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename S::real;
    using shape = typename C::shape;
    using lattice_type = lattice<S, shape>;
    using nodes_type = node_table<S, typename C::node_fields>;
    using execution = typename C::execution;
    static constexpr int D = S::dim, W = S::width, N = shape::support;

    sweeps(const shape& functions, const lattice_type& lattice, const execution& run)
        : functions_(functions), lattice_(lattice), run_(run), nodes_(lattice.size()) {}

    nodes_type& nodes() { return nodes_; }
    const nodes_type& nodes() const { return nodes_; }

    /// kernel(i) for all active nodes, W at a time; i shows the fields of the list.
    template <class... F, class Kernel> void each_node(fields<F...>, Kernel kernel) {
        constexpr std::size_t chunk = 256;
        const auto& active = nodes_.active();
        run_.for_each((active.size() + chunk - 1) / chunk, [&](std::size_t k) {
            node_blocks<fields<F...>>(active.data() + k * chunk, std::min(chunk, active.size() - k * chunk), kernel);
        });
    }

    /// Sums over the particles of a body: kernel(p, near, made) adds to node fields `ToNodes`, made = make(slot,
    /// stencil, frame).
    template <class Shown, class ToNodes, class Body, class Make, class Kernel>
    void scatter(Body& body, Make make, Kernel kernel) {
        auto& store = body.store();
        const bool mail = store.has_mail();
        const std::size_t slabs = store.slabs();
        // Slabs k and k + 2 share no node: even ones first, then odd ones, whatever the number of threads.
        for (std::size_t colour = 0; colour < 2 && colour < slabs; ++colour)
            run_.for_each((slabs - colour + 1) / 2, [&](std::size_t k) {
                store.each_tile(2 * k + colour, [&](std::size_t j) {
                    tile& t = store.tiles[j];
                    if (mail) store.deliver(t);
                    const tile_weights<C> weigh(functions_, lattice_, t);
                    scatter_tile<Shown, ToNodes>(lattice_, nodes_, store.slots.data(), t, lattice_.frame_of(t.at),
                                                 weigh, make, kernel);
                });
            });
        if (mail) store.mail_delivered();
    }

    /// SdV = S^T M S dv.
    template <class Body> void spread_increment(Body& body) {
        using namespace symbols;
        using list = fields<field::increment>;
        scatter_gathered<fields<const field::mass>, list, fields<field::image>>(
            body, [](auto p, auto near, const auto& dv_p) {
                for (const auto& [i, w, dw] : near) i[Sdv] += w * p[m] * dv_p.sums.template get<field::increment>();
            });
    }

    /// Gathers for every slot of a body: act(slot, occupied, frame, gathered). Particles that are in another cell then
    /// are posted.
    template <class Sums, class Gradient, class Body, class Act> void gather_each(Body& body, Act act) {
        auto& store = body.store();
        run_.for_each(store.slabs(), [&](std::size_t k) {
            store.each_tile(k, [&](std::size_t j) {
                [[maybe_unused]] const bool left = gather_tile<Sums, Gradient>(store, store.tiles[j], act);
                if constexpr (C::moves)
                    if (left) [[unlikely]]
                        post_leavers(store, k, j);
            });
        });
    }

  private:
    const shape& functions_;
    const lattice_type& lattice_;
    const execution& run_;
    nodes_type nodes_;

    template <class Shown, class Kernel>
    TAMIS_FLATTEN void node_blocks(const std::uint32_t* blocks, std::size_t count, Kernel& kernel) {
        using L = lane<T>;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t place = blocks[k] * static_cast<std::size_t>(W);
            values<S, Shown> local;
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = std::remove_const_t<typename decltype(tag)::type>;
                unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    component<S>(local.template get<F>(), c) = L::load(nodes_.template column<F>(c) + place);
                });
            });
            kernel(view<values<S, Shown>, Shown>{local});
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = typename decltype(tag)::type;
                if constexpr (!std::is_const_v<F>)
                    unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                        L::store(nodes_.template column<F>(c) + place, component<S>(local.template get<F>(), c));
                    });
            });
        }
    }

    template <class Shown, class Read, class ToNodes, class Body, class Kernel>
    void scatter_gathered(Body& body, Kernel kernel) {
        auto& store = body.store();
        const std::size_t slabs = store.slabs();
        for (std::size_t colour = 0; colour < 2 && colour < slabs; ++colour)
            run_.for_each((slabs - colour + 1) / 2, [&](std::size_t k) {
                store.each_tile(2 * k + colour, [&](std::size_t j) {
                    const tile& t = store.tiles[j];
                    const tile_weights<C> weigh(functions_, lattice_, t);
                    auto make = [&](const auto&, const stencil<S, N>& st, const auto&) TAMIS_INLINE_LAMBDA {
                        gathered<S, Read> g;
                        gather<no_field>(lattice_, nodes_, st, t.node, g);
                        return g;
                    };
                    scatter_tile<Shown, ToNodes>(lattice_, nodes_, store.slots.data(), t, lattice_.frame_of(t.at),
                                                 weigh, make, kernel);
                });
            });
    }

    template <class Sums, class Gradient, class Store, class Act>
    TAMIS_FLATTEN bool gather_tile(Store& store, const tile& t, Act& act) {
        const tile_weights<C> weigh(functions_, lattice_, t);
        const frame<S> at = lattice_.frame_of(t.at);
        bool left = false;
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
            auto& slot = store.slots[s];
            stencil<S, N> st;
            weigh(st, slot);
            gathered<S, Sums> g;
            gather<Gradient>(lattice_, nodes_, st, t.node, g);
            act(slot, store.occupied[s], at, g);
            if (store.occupied[s] != Store::full) clear_empty(slot);
            if constexpr (C::moves) left = left || may_have_left(slot, weigh);
        }
        return left;
    }
    /// Empty lanes stay exactly empty, whatever the law made of them: by select, for 0 times NaN is NaN.
    template <class Slot> TAMIS_INLINE static void clear_empty(Slot& slot) {
        const T zero(real(0));
        const auto keep = slot.template get<field::mass>() > zero;
        auto* component = reinterpret_cast<T*>(&slot);
        for (int c = 0; c < Slot::components; ++c) component[c] = select(keep, component[c], zero);
    }
    static bool both(bool a, bool b) { return a && b; }
    template <class Mask> TAMIS_INLINE static Mask both(const Mask& a, const Mask& b) { return a & b; }
    /// True also for NaN.
    template <class Slot> TAMIS_INLINE static bool may_have_left(const Slot& slot, const tile_weights<C>& weigh) {
        const auto& r = slot.template get<field::position>();
        const T zero(real(0)), one(real(1));
        auto stays = both(r[0] >= zero, r[0] < one);
        unroll<D - 1>([&](auto d) TAMIS_INLINE_LAMBDA { stays = both(stays, both(r[d + 1] >= zero, r[d + 1] < one)); });
        if constexpr (shape::shift > 0)
            if (weigh.at_wall)
                unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA {
                    const T shift = constant<T>(shape::shift);
                    stays = both(stays, both(r[d] >= weigh.walls.low[d] * shift,
                                             r[d] <= one - weigh.walls.high[d] * (one - shift)));
                });
        return lane<T>::any(!stays);
    }

    template <class Store> TAMIS_NOINLINE void post_leavers(Store& store, std::size_t slab, std::size_t index) {
        tile& t = store.tiles[index];
        constexpr int first = Store::slot::template first<field::position>();
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s)
            for (int l = 0; l < W; ++l) {
                if (!(store.occupied[s] >> l & 1u)) continue;
                real* const p = store.lane_of(s, l) + first * W;
                const std::array<int, 3> from{t.at[0] * W + l, t.at[1], t.at[2]};
                std::array<int, 3> cell = from;
                point<D, real> local;
                bool stays = true;
                for (int d = 0; d < D; ++d) {
                    local[d] = p[d * W];
                    stays = stays && settle(local[d], cell[static_cast<std::size_t>(d)], lattice_.bins(d));
                }
                if (stays && lattice_.inside(cell, local))
                    for (int d = 0; d < D; ++d) p[d * W] = local[d];
                else
                    cell[0] = Store::outside;
                if (cell != from) store.post(slab, s, l, from, cell);
            }
        store.shrink(slab, t);
    }
    /// Brings a place into [0, 1) by going to a neighbouring cell; at the upper wall 1 stays. False if that is outside,
    /// or if the place is not a number.
    static bool settle(real& r, int& cell, int bins) {
        if (!(r > real(-1000000) && r < real(1000000))) return false;
        int k = lane<real>::floor(r);
        real rest = r - real(k);
        if (rest >= real(1)) {
            rest = real(0);
            ++k;
        }
        if (shape::shift == 0 && cell + k == bins && !(rest > real(0))) {
            --k;
            rest = real(1);
        }
        r = rest;
        cell += k;
        return cell >= 0 && cell < bins;
    }
};

}  // namespace tamis::detail
