#pragma once
#include <tamis/grid/node_table.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/particles/leavers.hpp>
#include <tamis/transfer/gather.hpp>
#include <tamis/transfer/scatter.hpp>
#include <tamis/transfer/weigh.hpp>

namespace tamis::detail {

/// Passes over nodes, and over the particles of one body. They depend on as little of a composition as they can, so
/// that compositions of one program share them.
template <class S, class Shape, class NodeFields, class Execution, bool Moves> class sweeps {
  public:
    using T = typename S::scalar;
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    using nodes_type = node_table<S, NodeFields>;
    using weigh_type = tile_weights<S, Shape, Moves>;
    static constexpr int W = S::width, N = Shape::support;

    sweeps(const Shape& functions, const lattice_type& lattice, const Execution& run)
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

    /// Sums over all active nodes of the numbers that kernel(i) gives, in an order that does not depend on threads.
    template <std::size_t Count, class... F, class Kernel>
    std::array<real, Count> sum_over_nodes(fields<F...>, Kernel kernel) {
        constexpr std::size_t chunk = 256;
        const auto& active = nodes_.active();
        const std::size_t chunks = (active.size() + chunk - 1) / chunk;
        std::vector<std::array<T, Count>> parts(chunks);
        run_.for_each(chunks, [&](std::size_t k) {
            auto& part = parts[k];
            part.fill(T(real(0)));
            const auto add = [&](auto i) TAMIS_INLINE_LAMBDA {
                const std::array<T, Count> more = kernel(i);
                for (std::size_t c = 0; c < Count; ++c) part[c] += more[c];
            };
            node_blocks<fields<F...>>(active.data() + k * chunk, std::min(chunk, active.size() - k * chunk), add);
        });
        std::array<real, Count> total;
        total.fill(real(0));
        for (const auto& part : parts)
            for (std::size_t c = 0; c < Count; ++c) {
                real lanes_of_part[W];
                lane<T>::store(lanes_of_part, part[c]);
                for (int l = 0; l < W; ++l) total[c] += lanes_of_part[l];
            }
        return total;
    }

    /// Sums over the particles of a body: kernel(p, near, made) adds to node fields `ToNodes`, made = kernel.make(slot,
    /// stencil, frame).
    template <class Shown, class ToNodes, class Body, class Kernel> void scatter(Body& body, Kernel kernel) {
        auto& store = body.store();
        const bool mail = store.has_mail();
        each_tile_by_colour(store, [&](tile& t, const auto* next) {
            if (mail) store.deliver(t);
            const weigh_type weigh(functions_, lattice_, t);
            const auto make = [&](const auto& slot, const auto&, const auto& at)
                                  TAMIS_INLINE_LAMBDA { return kernel.make(slot, at); };
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(next + k); };
            scatter_tile<Shown, ToNodes>(lattice_, nodes_, store.slots.data(), t, lattice_.frame_of(t.at), weigh, fetch,
                                         make, kernel);
        });
        if (mail) store.mail_delivered();
    }

    /// As `scatter` with made = the weights of a slot's particles at the nodes of a row, in 1D.
    template <class Shown, class ToNodes, class Body, class Kernel> void scatter_weights(Body& body, Kernel kernel) {
        static_assert(S::dim == 1);
        auto& store = body.store();
        each_tile_by_colour(store, [&](const tile& t, const auto* next) {
            const weigh_type weigh(functions_, lattice_, t);
            const auto make = [&](const auto&, const stencil<S, N>& st, const auto&) TAMIS_INLINE_LAMBDA {
                std::array<T, static_cast<std::size_t>(N)> weights;
                unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { weights[a] = st.weight(a, st.row(0)); });
                return weights;
            };
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(next + k); };
            scatter_tile<Shown, ToNodes>(lattice_, nodes_, store.slots.data(), t, lattice_.frame_of(t.at), weigh, fetch,
                                         make, kernel);
        });
    }
    /// To = B From in 1D, B a symmetric matrix whose rows' diagonal and upper entries are the components of `Bands`.
    template <class Bands, class From, class To> void multiply_by_bands() {
        static_assert(S::dim == 1);
        constexpr int count = Bands::template components<S>;
        constexpr std::size_t chunk = 256;
        const auto& active = nodes_.active();
        const real* const from = nodes_.template column<From>();
        real* const to = nodes_.template column<To>();
        run_.for_each((active.size() + chunk - 1) / chunk, [&](std::size_t k) {
            for (std::size_t b = k * chunk; b < std::min(active.size(), (k + 1) * chunk); ++b) {
                const auto place = static_cast<std::ptrdiff_t>(active[b]) * W;
                T sum = lane<T>::load(nodes_.template column<Bands>(0) + place) * lane<T>::load(from + place);
                unroll<count - 1>([&](auto j) TAMIS_INLINE_LAMBDA {
                    constexpr int off = j + 1;
                    const real* const band = nodes_.template column<Bands>(off) + place;
                    sum += lane<T>::load(band) * lane<T>::load(from + place + off);
                    sum += lane<T>::load(band - off) * lane<T>::load(from + place - off);
                });
                lane<T>::store(to + place, sum);
            }
        });
    }

    /// As `scatter` with made = kernel.make(slot, gathered), gathered: S F for all node fields F of `Read`.
    template <class Shown, class Read, class ToNodes, class Body, class Kernel>
    void scatter_gathered(Body& body, Kernel kernel) {
        auto& store = body.store();
        each_tile_by_colour(store, [&](const tile& t, const auto* next) {
            const weigh_type weigh(functions_, lattice_, t);
            const nodes_around<S, Shape, merge_as_is<Read>> around(lattice_, nodes_, t.node);
            const auto make = [&](const auto& slot, const stencil<S, N>& st, const auto&) TAMIS_INLINE_LAMBDA {
                gathered<S, Read> g;
                gather<no_field>(around, st, g);
                return kernel.make(slot, g);
            };
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(next + k); };
            scatter_tile<Shown, ToNodes>(lattice_, nodes_, store.slots.data(), t, lattice_.frame_of(t.at), weigh, fetch,
                                         make, kernel);
        });
    }

    /// f(i, j, S_pi M_p S_pj) for every particle of a body and all storage places i, j of nodes around it; one thread.
    template <class Body, class F> void each_weight_pair(const Body& body, F f) {
        constexpr int D = S::dim, count = power(N, D);
        const auto& store = body.store();
        for (const tile& t : store.tiles) {
            const weigh_type weigh(functions_, lattice_, t);
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
                stencil<S, N> st;
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

    /// Gathers for every slot of a body: kernel(slot, occupied, frame, gathered). Particles that are in another cell
    /// then are posted.
    template <class Sums, class Gradient, class Body, class Kernel> void gather_each(Body& body, Kernel kernel) {
        auto& store = body.store();
        run_.for_each(store.slabs(), [&](std::size_t k) {
            store.each_tile_and_next(k, [&](std::size_t j, const auto* next) {
                [[maybe_unused]] const bool left = gather_tile<Sums, Gradient>(store, store.tiles[j], next, kernel);
                if constexpr (Moves)
                    if (left) [[unlikely]]
                        post_leavers(store, lattice_, k, j);
            });
        });
    }

  private:
    const Shape& functions_;
    const lattice_type& lattice_;
    const Execution& run_;
    nodes_type nodes_;

    /// Slabs k and k + 2 share no node: even ones first, then odd ones, whatever the number of threads.
    template <class Store, class F> void each_tile_by_colour(Store& store, const F& f) {
        const std::size_t slabs = store.slabs();
        for (std::size_t colour = 0; colour < 2 && colour < slabs; ++colour)
            run_.for_each((slabs - colour + 1) / 2, [&](std::size_t k) {
                store.each_tile_and_next(2 * k + colour,
                                         [&](std::size_t j, const auto* next) { f(store.tiles[j], next); });
            });
    }

    template <class Shown, class Kernel>
    TAMIS_FLATTEN void node_blocks(const std::uint32_t* blocks, std::size_t count, Kernel& kernel) {
        using L = lane<T>;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t place = blocks[k] * static_cast<std::size_t>(W);
            values<S, Shown> local;
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = std::remove_const_t<typename decltype(tag)::type>;
                unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    component<S>(local.template get<F>(), c) = L::load(nodes_.template block<F>(place, c));
                });
            });
            kernel(view<values<S, Shown>, Shown>{local});
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = typename decltype(tag)::type;
                if constexpr (!std::is_const_v<F>)
                    unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                        L::store(nodes_.template block<F>(place, c), component<S>(local.template get<F>(), c));
                    });
            });
        }
    }

    template <class Sums, class Gradient, class Store, class Kernel>
    TAMIS_FLATTEN bool gather_tile(Store& store, const tile& t, const typename Store::slot* next, Kernel& kernel) {
        const weigh_type weigh(functions_, lattice_, t);
        const frame<S> at = lattice_.frame_of(t.at);
        const nodes_around<S, Shape, typename with_gradient<Sums, Gradient>::type> around(lattice_, nodes_, t.node);
        bool left = false;
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
            auto& slot = store.slots[s];
            if constexpr (S::dim > 1) store.fetch(next + (s - t.first));
            stencil<S, N> st;
            weigh(st, slot);
            gathered<S, Sums> g;
            gather<Gradient>(around, st, g);
            kernel(slot, store.occupied[s], at, g);
            if (store.occupied[s] != Store::full) clear_empty(slot);
            if constexpr (Moves) left = left || weigh.may_have_left(slot);
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
};

}  // namespace tamis::detail
