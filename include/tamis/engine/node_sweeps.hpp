#pragma once
#include <tamis/engine/assemble.hpp>
#include <tamis/engine/node_table.hpp>
#include <tamis/engine/pass_runner.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace tamis::detail {

/// Passes over nodes: their fields, in the columns of a layout, and what runs the passes.
template <class S, class Shape, class Layout, class Execution> class node_sweeps {
  public:
    using T = typename S::scalar;
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    using nodes_type = node_table<S, Layout>;
    static constexpr int W = S::width, N = Shape::support;
    using runner_type = pass_runner<Execution, S::dim>;

    node_sweeps(const lattice_type& lattice, const Execution& run)
        : lattice_(lattice),
          runner_(run),
          nodes_(lattice.size(), stores<Layout, field::mass_entries<N>> ? lattice.reach() : 0) {}
    node_sweeps(const node_sweeps&) = delete;
    node_sweeps& operator=(const node_sweeps&) = delete;

    /// What runs the passes.
    runner_type& runner() { return runner_; }
    /// The nodes, with the results of all passes so far.
    nodes_type& nodes() {
        runner_.run_waiting();
        return nodes_;
    }
    const nodes_type& nodes() const { return nodes_; }
    /// The nodes as they are, for a pass that looks at them when its turn comes.
    nodes_type& nodes_of_pass() { return nodes_; }

    /// Fields of all active nodes become zero.
    template <class... F> void set_zero() {
        if constexpr (nodes_type::in_columns)
            nodes_.template set_zero<F...>();
        else
            over_blocks(1024,
                        [this](std::size_t begin, std::size_t end) { nodes_.template set_zero_in<F...>(begin, end); });
    }

    /// For all active nodes, W at a time: loads some fields, calls kernel(values), and stores some. `values` has room
    /// for all fields of the kernel's `all`. `finish()`, if the kernel has it, is called after some nodes' last.
    template <class Loads, class Saves, class Kernel> void each_node(Kernel kernel) {
        // A copy of the kernel: what is stored might, for all the compiler knows, change one that it refers to.
        over_blocks(chunk, [this, kernel](std::size_t begin, std::size_t end) {
            node_blocks<Loads, Saves>(nodes_.active().data() + begin, end - begin, kernel);
        });
    }
    /// The same by the kernel's own list: it loads all fields, and stores those that are not const.
    template <class Kernel> void each_node(Kernel kernel) {
        each_node<merge<typename Kernel::list>, written_t<typename Kernel::list>>(by_list<Kernel>{kernel});
    }
    /// Sums over all active nodes of the numbers that kernel(i) gives, in an order that does not depend on threads.
    template <std::size_t Count, class Kernel> std::array<real, Count> sum_over_nodes(Kernel kernel) {
        runner_.run_waiting();
        const auto& active = nodes_.active();
        const std::size_t chunks = (active.size() + chunk - 1) / chunk;
        parts_.resize(std::max(parts_.size(), chunks * Count));
        using list = typename Kernel::list;
        in_chunks(runner_.execution(), active.size(), chunk, [&](std::size_t begin, std::size_t end) {
            T* const part = parts_.data() + begin / chunk * Count;
            std::fill_n(part, Count, T(real(0)));
            const auto add = [&](auto& row) TAMIS_INLINE_LAMBDA {
                const std::array<T, Count> more = kernel(view<std::remove_reference_t<decltype(row)>, list>{row});
                for (std::size_t c = 0; c < Count; ++c) part[c] += more[c];
            };
            node_blocks<merge<list>, fields<>>(active.data() + begin, end - begin, summing<list, decltype(add)>{add});
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

  protected:
    static constexpr std::size_t chunk = 256;  // blocks of nodes that one call of the execution looks at
    const lattice_type& lattice_;
    runner_type runner_;
    nodes_type nodes_;

  private:
    std::vector<T> parts_;  // of sums over nodes

    template <class List> struct written;
    template <class... F> struct written<fields<F...>> {
        using type = typename concatenate<fields<>, fields_if<!std::is_const_v<F>, F>...>::type;
    };
    template <class List> using written_t = typename written<List>::type;
    /// A kernel of one row of nodes that shows the fields of its list.
    template <class Kernel> struct by_list {
        using all = merge<typename Kernel::list>;
        Kernel kernel;
        TAMIS_INLINE void operator()(auto& row) const {
            kernel(view<std::remove_reference_t<decltype(row)>, typename Kernel::list>{row});
        }
    };
    template <class List, class Add> struct summing {
        using all = merge<List>;
        const Add& add;
        TAMIS_INLINE void operator()(auto& row) const { add(row); }
    };

    /// A pass over active blocks: f(first, last) from the first-th to the one before the last-th, in parts. Where it
    /// waits, it is run by one thread for each range of places.
    template <class F> struct pass_over_blocks {
        node_sweeps* of;
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
    template <class Loads, class Saves, class Kernel>
    TAMIS_FLATTEN void node_blocks(const std::uint32_t* blocks, std::size_t count, Kernel kernel) {
        using L = lane<T>;
        const auto columns = nodes_.columns();
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t place = blocks[k] * static_cast<std::size_t>(W);
            values<S, typename Kernel::all> local;
            each_field<Loads>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = typename decltype(tag)::type;
                unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    component<S>(local.template get<F>(), c) = L::load(columns.template block<F>(place, c));
                });
            });
            kernel(local);
            each_field<Saves>::run([&](auto tag) TAMIS_INLINE_LAMBDA {
                using F = typename decltype(tag)::type;
                unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    L::store(columns.template block<F>(place, c), component<S>(local.template get<F>(), c));
                });
            });
        }
        if constexpr (requires { kernel.finish(); }) kernel.finish();
    }
};

}  // namespace tamis::detail
