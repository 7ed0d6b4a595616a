#pragma once
#include <tamis/grid/node_table.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/particles/leavers.hpp>
#include <tamis/solver/pass_runner.hpp>
#include <tamis/transfer/assemble.hpp>
#include <tamis/transfer/gather.hpp>
#include <tamis/transfer/running_sums.hpp>
#include <tamis/transfer/scatter.hpp>
#include <tamis/transfer/weigh.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace tamis::detail {

/// Nothing follows.
struct no_more {
    TAMIS_INLINE void operator()(const auto&...) const {}
};

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
    using runner_type = pass_runner<Execution, S::dim>;

    sweeps(const Shape& functions, const lattice_type& lattice, const Execution& run)
        : functions_(functions),
          lattice_(lattice),
          runner_(run),
          nodes_(lattice.size(), stores<NodeFields, field::mass_entries<N>> ? lattice.reach() : 0) {}

    /// What runs the passes.
    runner_type& runner() { return runner_; }
    nodes_type& nodes() { return nodes_; }
    const nodes_type& nodes() const { return nodes_; }

    /// Fields of all active nodes become zero.
    template <class... F> void set_zero() {
        if constexpr (nodes_type::in_columns)
            nodes_.template set_zero<F...>();
        else
            over_blocks(1024,
                        [this](std::size_t begin, std::size_t end) { nodes_.template set_zero_in<F...>(begin, end); });
    }

    /// kernel(i) for all active nodes, W at a time; i shows the fields of the list.
    template <class... F, class Kernel> void each_node(fields<F...>, Kernel kernel) {
        // A copy of the kernel: what is stored might, for all the compiler knows, change one that it refers to.
        over_blocks(chunk, [this, kernel](std::size_t begin, std::size_t end) {
            node_blocks<fields<F...>>(nodes_.active().data() + begin, end - begin, kernel);
        });
    }
    /// Sums over all active nodes of the numbers that kernel(i) gives, in an order that does not depend on threads.
    template <std::size_t Count, class... F, class Kernel>
    std::array<real, Count> sum_over_nodes(fields<F...>, Kernel kernel) {
        runner_.run_waiting();
        const auto& active = nodes_.active();
        const std::size_t chunks = (active.size() + chunk - 1) / chunk;
        parts_.resize(std::max(parts_.size(), chunks * Count));
        in_chunks(runner_.execution(), active.size(), chunk, [&](std::size_t begin, std::size_t end) {
            T* const part = parts_.data() + begin / chunk * Count;
            std::fill_n(part, Count, T(real(0)));
            const auto add = [&](auto i) TAMIS_INLINE_LAMBDA {
                const std::array<T, Count> more = kernel(i);
                for (std::size_t c = 0; c < Count; ++c) part[c] += more[c];
            };
            node_blocks<fields<F...>>(active.data() + begin, end - begin, add);
        });
        std::array<real, Count> total;
        total.fill(real(0));
        for (std::size_t k = 0; k < chunks * Count; ++k) {
            real lanes_of_part[W];
            lane<T>::store(lanes_of_part, parts_[k]);
            for (int l = 0; l < W; ++l) total[k % Count] += lanes_of_part[l];
        }
        return total;
    }

    /// Sums over the particles of a body: kernel(p, near, made) adds to node fields `ToNodes`, made = kernel.make(slot,
    /// frame). Of particles the kernel reads the fields `Kernel::reads`, of weights slopes too if
    /// `Kernel::uses_slopes`.
    template <class Shown, class ToNodes, class Body, class Kernel> void scatter(Body& body, Kernel kernel) {
        scatter_onto<Shown, ToNodes>(nodes_, body, kernel);
    }
    /// The same, and what the particles have in the full mass matrix, added to its entries while they are at hand.
    template <class Shown, class ToNodes, class Body, class Kernel>
    void scatter_and_assemble(Body& body, Kernel kernel) {
        auto& store = body.store();
        scatter_onto<Shown, ToNodes>(nodes_, body, kernel, [this, &store](const tile& t, const weigh_type& weigh) {
            const auto at_hand = [](std::uint32_t) TAMIS_INLINE_LAMBDA {};
            matrix_of_tile<S, Shape>::add(lattice_, nodes_, store.slots.data(), t, weigh, at_hand);
        });
    }
    /// The same onto another table of nodes; `also(tile, its weights)` follows for each tile.
    template <class Shown, class ToNodes, class Table, class Body, class Kernel, class Also = no_more>
    void scatter_onto(Table& table, Body& body, Kernel kernel, Also also = {}) {
        auto& store = body.store();
        const bool mail = store.has_mail();
        using reads = merge<typename weigh_type::reads, typename Kernel::reads>;
        each_tile_by_colour<tiles_ahead>(store, [this, &table, &store, mail, kernel, also](tile& t, const auto* soon) {
            if (mail) store.deliver(t);
            const weigh_type weigh(functions_, lattice_, t);
            const auto make = [&](const auto& slot, const auto&, const auto& at)
                                  TAMIS_INLINE_LAMBDA { return kernel.make(slot, at); };
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads{}); };
            scatter_tile<Shown, ToNodes>(lattice_, table, store.slots.data(), t, lattice_.frame_of(t.at), weigh, fetch,
                                         make, kernel);
            also(t, weigh);
        });
        if (mail) runner_.at_end([&store] { store.mail_delivered(); });
    }

    /// Adds what the particles of a body have in the full mass matrix to its entries at the nodes.
    template <class Body> void assemble_matrix(Body& body) {
        auto& store = body.store();
        using reads = merge<typename weigh_type::reads, fields<field::mass>>;
        each_tile_by_colour<tiles_ahead>(store, [this, &store](const tile& t, const auto* soon) {
            const weigh_type weigh(functions_, lattice_, t);
            const auto fetch = [&](std::uint32_t k) TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads{}); };
            matrix_of_tile<S, Shape>::add(lattice_, nodes_, store.slots.data(), t, weigh, fetch);
        });
    }
    /// use(space, nodes, place, Mf From) for W places at a time, Mf the matrix whose entries are at the nodes.
    template <class From, class Use> void multiply_by_matrix(const Use& use) {
        using entries = matrix_entries<S::dim, N>;
        std::array<std::ptrdiff_t, static_cast<std::size_t>(entries::rows)> steps;
        for (int row = 0; row < entries::rows; ++row)
            steps[static_cast<std::size_t>(row)] = lattice_.row_step(entries::steps(row));
        const auto multiply = [this, steps, use](std::size_t begin, std::size_t end) {
            multiply_blocks<S, N, From>(nodes_.columns(), nodes_.active().data() + begin, end - begin, steps, use);
        };
        runner_.around_nodes(blocks_pass(chunk, multiply));
    }

    /// As `scatter` with made = kernel.make(slot, gathered), gathered: S F for all node fields F of `Read`, and the
    /// gradient of a node field, for which the kernel must say that it uses slopes.
    template <class Shown, class Read, class ToNodes, class Gradient = no_field, class Body, class Kernel>
    void scatter_gathered(Body& body, Kernel kernel) {
        auto& store = body.store();
        using reads = merge<typename weigh_type::reads, typename Kernel::reads>;
        using store_type = typename Body::store_type;
        constexpr bool few = 2 * store_type::components_to(reads{}) <= store_type::components;
        each_tile_by_colour<few ? tiles_ahead_of_few_fields : tiles_ahead>(store, [this, &store, kernel](
                                                                                      const tile& t, const auto* soon) {
            const weigh_type weigh(functions_, lattice_, t);
            const nodes_around<S, Shape, typename with_gradient<Read, Gradient>::type> around(lattice_, nodes_, t.node);
            const auto make = [&](const auto& slot, const auto& st, const auto&) TAMIS_INLINE_LAMBDA {
                gathered<S, Read, components_of<S, Gradient>> g;
                gather<Gradient>(around, st, g);
                return kernel.make(slot, g);
            };
            const auto fetch = [&](std::uint32_t k, int part = 0, int parts = 1)
                                   TAMIS_INLINE_LAMBDA { store.fetch(soon + k, reads{}, part, parts); };
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

    /// Gathers for every slot of a body: kernel(slot, occupied, frame, gathered), or with what kernel.look makes of the
    /// nodes around it as well. Particles that are in another cell then are posted.
    template <class Sums, class Gradient, class Body, class Kernel> void gather_each(Body& body, Kernel kernel) {
        auto& store = body.store();
        ++store.updates;
        runner_.over_slabs(store.slabs(), [this, &store, kernel](std::size_t k) {
            Kernel own = kernel;
            store.template each_tile_and_soon<tiles_ahead>(k, [&](std::size_t j, const auto* soon) {
                [[maybe_unused]] const some_slots left = gather_tile<Sums, Gradient>(store, store.tiles[j], soon, own);
                if constexpr (Moves)
                    if (left.any()) [[unlikely]]
                        post_leavers(store, lattice_, k, j, left);
            });
        });
    }
    /// As `gather_each`, and where `ahead`, as `scatter` does with what `give` makes of the particles after it, in one
    /// pass, in 1D; `ToNodes` must be columns that are not gathered. False if those sums were not made, or lack
    /// particles that went to other cells.
    template <class Sums, class Gradient, class Shown, class ToNodes, class Body, class Kernel, class Give>
    bool gather_and_scatter(Body& body, Kernel kernel, Give give, bool ahead) {
        using row_type = running_sums<S, N, ToNodes>;
        auto& store = body.store();
        ++store.updates;
        const auto run_row = [&](std::size_t k, row_type& row) {
            return gather_and_scatter_row<Sums, Gradient, Shown>(store, k, kernel, give, ahead, row);
        };
        const std::size_t slabs = store.slabs();
        if (slabs == 1) {
            row_type row;
            const bool some_left = run_row(0, row);
            if (ahead) row.write_waiting(nodes_.columns());
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
    // How many tiles before their turn slots are asked for: whole slots, two tiles ahead, take much of a core's own
    // cache; half a slot or less comes late one tile ahead.
    static constexpr int tiles_ahead = 1, tiles_ahead_of_few_fields = 3;
    static constexpr std::size_t chunk = 256;  // blocks of nodes that one call of the execution looks at
    const Shape& functions_;
    const lattice_type& lattice_;
    runner_type runner_;
    nodes_type nodes_;
    std::vector<char, aligned_allocator<char>> scratch_;  // of gather_and_scatter, kept from step to step
    std::vector<T> parts_;                                // of sums over nodes

    /// A pass over active blocks: f(first, last) from the first-th to the one before the last-th, in parts. Where it
    /// waits, it is run by one thread for each range of places.
    template <class F> struct pass_over_blocks {
        sweeps* of;
        std::size_t part;
        F f;
        void operator()(std::size_t first, std::size_t last) const { of->in_blocks({first, last}, part, f); }
    };
    template <class F> pass_over_blocks<F> blocks_pass(std::size_t part, F f) { return {this, part, std::move(f)}; }
    template <class F> void over_blocks(std::size_t part, F f) { runner_.over_nodes(blocks_pass(part, std::move(f))); }
    template <class F> void in_blocks(const node_range& range, std::size_t part, const F& f) {
        if constexpr (runner_type::may_wait)
            in_blocks_by(range, part, call_ref<std::size_t, std::size_t>::to(f));
        else
            in_blocks_by(range, part, f);
    }
    template <class F> void in_blocks_by(const node_range& range, std::size_t part, const F& f) {
        const auto& active = nodes_.active();
        const auto before = [&](std::size_t place) {
            if (place == node_range::end) return active.size();
            const auto block = static_cast<std::uint32_t>(place / static_cast<std::size_t>(W));
            return static_cast<std::size_t>(std::lower_bound(active.begin(), active.end(), block) - active.begin());
        };
        const std::size_t first = range.first == 0 ? 0 : before(range.first), last = before(range.last);
        const auto shifted = [&](std::size_t begin, std::size_t end) { f(first + begin, first + end); };
        if (runner_.waits())
            in_chunks(serial{}, last - first, part, shifted);
        else
            in_chunks(runner_.execution(), last - first, part, shifted);
    }
    template <int Ahead, class Store, class F> void each_tile_by_colour(Store& store, F f) {
        runner_.by_colour(store.slabs(), [&store, f](std::size_t k) {
            store.template each_tile_and_soon<Ahead>(k,
                                                     [&](std::size_t j, const auto* soon) { f(store.tiles[j], soon); });
        });
    }

    template <class Shown, class Kernel>
    TAMIS_FLATTEN void node_blocks(const std::uint32_t* blocks, std::size_t count, Kernel kernel) {
        using L = lane<T>;
        const auto columns = nodes_.columns();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t place = blocks[k] * static_cast<std::size_t>(W);
            values<S, Shown> local;
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = std::remove_const_t<typename decltype(tag)::type>;
                unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    component<S>(local.template get<F>(), c) = L::load(columns.template block<F>(place, c));
                });
            });
            kernel(view<values<S, Shown>, Shown>{local});
            each_field<Shown>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = typename decltype(tag)::type;
                if constexpr (!std::is_const_v<F>)
                    unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                        L::store(columns.template block<F>(place, c), component<S>(local.template get<F>(), c));
                    });
            });
        }
    }

    template <class Sums, class Gradient, class Store, class Kernel>
    TAMIS_FLATTEN some_slots gather_tile(Store& store, const tile& t, const typename Store::slot* soon,
                                         Kernel& kernel) {
        const weigh_type weigh(functions_, lattice_, t);
        const frame<S> at = lattice_.frame_of(t.at);
        const nodes_around<S, Shape, typename with_gradient<Sums, Gradient>::type> around(lattice_, nodes_, t.node);
        constexpr bool looks = requires { kernel.look.around(lattice_, t.node); };
        [[maybe_unused]] const auto flow_around = [&] {
            if constexpr (looks)
                return kernel.look.around(lattice_, t.node);
            else
                return no_field{};
        }();
        some_slots left;
        for (std::uint32_t s = t.first; s < t.first + t.count; ++s) {
            auto& slot = store.slots[s];
            if constexpr (S::dim > 1) store.fetch_to_write(soon + (s - t.first));
            stencil<S, N> st;
            weigh(st, slot);
            gathered<S, Sums> g;
            gather<Gradient>(around, st, g);
            if constexpr (looks)
                kernel(slot, store.occupied[s], at, g, kernel.look(around, flow_around, st));
            else
                kernel(slot, store.occupied[s], at, g);
            if (store.occupied[s] != Store::full) clear_empty(slot);
            if constexpr (Moves)
                if (weigh.may_have_left(slot)) left.add(s - t.first);
        }
        return left;
    }
    /// The tiles of slab k one after the other; true if particles left their cells. All that the loop needs is
    /// copied: what is stored might, for all the compiler knows, change anything else.
    template <class Sums, class Gradient, class Shown, class Store, class Kernel, class Give, class Row>
    TAMIS_FLATTEN bool gather_and_scatter_row(Store& store, std::size_t k, const Kernel& the_kernel,
                                              const Give& the_give, bool ahead, Row& row_out) {
        using sums_type = typename Row::sums_type;
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
            const std::uint32_t first = t.first, last = first + t.count;
            const weigh_type weigh(functions_, lattice, t);
            const frame<S> at = lattice.frame_of(t.at);
            const nodes_around<S, Shape, typename with_gradient<Sums, Gradient>::type> around(lattice, columns, place);
            sums_type sums[N];
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { sums[a].set_zero(); });
            auto stay = T(real(0)) >= T(real(0));
            for (std::uint32_t s = first; s < last; ++s) {
                auto& slot = slots[s];
                stencil<S, N> st;
                weigh(st, slot);
                gathered<S, Sums> g;
                gather<Gradient>(around, st, g);
                kernel(slot, occupied[s], at, g);
                if (occupied[s] != Store::full) clear_empty(slot);
                if constexpr (Moves) stay = stay & weigh.stays(slot);
                if (!ahead) continue;
                if constexpr (Moves) weigh(st, slot);
                const auto made = give.make(slot, at);
                unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                    const auto across = st.row(0);
                    const one_node<S, sums_type, typename Row::list> near{
                        {{sums[a]}, st.weight(a, across), st.slope(a, across)}};
                    give(slot_row<S, typename Store::slot, Shown>{slot, at}, near, made);
                });
            }
            if (ahead) row.add(sums, columns, place);
            // A tile has few slots here: which of them are left is not worth a jump in each.
            if constexpr (Moves)
                if (lane<T>::any(!stay)) [[unlikely]]
                    some_left = post_leavers(store, lattice_, k, j, some_slots::all()) || some_left;
        }
        row_out = row;
        return some_left;
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
