#pragma once
#include <tamis/material/carried.hpp>
#include <tamis/run/particle.hpp>

#include <cstddef>
#include <iterator>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tamis {

/// Particles and their law. Made by `solver::make_body`, which knows what fields the composed policies ask for. A body
/// that was moved from has no particles; to step it is an error, to assign another to it makes it as good as new.
/// Several threads may read, and copy, a const body at the same time.
template <class S, class Shape, class Law, class List> class body {
  public:
    /// Types and dimension, as the composition has them.
    /// @{
    using space_type = S;
    using law_type = Law;
    using field_list = List;
    using lattice_type = detail::lattice<S, Shape>;
    using store_type = detail::tile_store<S, List>;
    using real = typename S::real;
    static constexpr int dim = S::dim;
    /// @}

    /// What the body is made of. It may be changed between steps.
    Law law;

    /// Without particles; for the solver.
    body(const Law& the_law, const lattice_type& lattice)
        : law(the_law), lattice_(lattice), store_(lattice.block_count()) {}

    /// A copy has particles of its own.
    body(const body& other)
        : law(other.law),
          lattice_(other.lattice_),
          store_(other.delivered()),
          contents_(other.contents_),
          carried_(other.carried_) {}
    /// The other one is left without particles.
    body(body&& other) noexcept(std::is_nothrow_move_constructible_v<Law>)
        : law(std::move(other.law)),
          lattice_(other.lattice_),
          store_((other.store_.deliver_all(), std::move(other.store_))),
          contents_(std::move(other.contents_)),
          carried_(std::move(other.carried_)) {}
    /// A copy has particles of its own.
    body& operator=(const body& other) {
        law = other.law;
        lattice_ = other.lattice_;
        store_ = other.delivered();
        contents_ = other.contents_;
        carried_ = other.carried_;
        return *this;
    }
    /// The other one is left without particles.
    body& operator=(body&&) = default;

    /// Number of particles.
    std::size_t size() const { return store_.size(); }
    /// Was it moved from, and nothing assigned to it since?
    bool moved_from() const { return store_.moved_from(); }
    /// Bytes a particle takes, of the fields that the composition stores.
    static constexpr std::size_t bytes_per_particle() {
        return sizeof(real) * static_cast<std::size_t>(store_type::components);
    }
    /// Share of the lanes in use that hold a particle.
    double occupancy() const { return delivered().occupancy(); }
    /// Does the composition store this field?
    template <class F> static constexpr bool has(F) { return stores<List, F>; }

    /// Goes over the particles.
    template <bool Const> class iterator {
      public:
        /// As iterators have it.
        /// @{
        using iterator_category = std::input_iterator_tag;
        using value_type = particle<body, Const>;
        using difference_type = std::ptrdiff_t;
        using owner = std::conditional_t<Const, const body, body>;
        iterator() = default;
        iterator(owner& of, std::size_t tile) : of_(&of), tile_(tile) { settle(); }
        value_type operator*() const { return {*of_, tile_, of_->store_.tiles[tile_].first + slot_, lane_}; }
        iterator& operator++() {
            next();
            settle();
            return *this;
        }
        iterator operator++(int) {
            auto before = *this;
            ++*this;
            return before;
        }
        bool operator==(const iterator& o) const { return tile_ == o.tile_ && slot_ == o.slot_ && lane_ == o.lane_; }
        /// @}

      private:
        owner* of_ = nullptr;
        std::size_t tile_ = 0;
        std::uint32_t slot_ = 0;
        int lane_ = 0;
        void next() {
            if (++lane_ == S::width) {
                lane_ = 0;
                ++slot_;
            }
        }
        void settle() {
            const auto& s = of_->store_;
            for (; tile_ < s.tiles.size(); ++tile_, slot_ = 0, lane_ = 0)
                for (; slot_ < s.tiles[tile_].count; next())
                    if (s.occupied[s.tiles[tile_].first + slot_] >> lane_ & 1u) return;
        }
    };
    /// All particles, to read and write. The order is that of storage and may change from step to step. The next step
    /// checks what may have been changed, and makes held particles' node masses anew: to look only, iterate over
    /// std::as_const(body).
    iterator<false> begin() {
        store_.deliver_all();
        contents_.renew();
        return {*this, 0};
    }
    /// Behind the last.
    iterator<false> end() { return {*this, store_.tiles.size()}; }
    /// All particles, to read.
    iterator<true> begin() const {
        store_.deliver_all();
        return {*this, 0};
    }
    /// Behind the last.
    iterator<true> end() const { return {*this, store_.tiles.size()}; }

    /// Where a particle is (m).
    point<dim, real> position_of(std::size_t tile, std::uint32_t slot, int lane_index) const {
        const auto& at = store_.tiles[tile].at;
        const auto& grid = lattice_.grid();
        constexpr int W = S::width;
        point<dim, real> where;
        for (int d = 0; d < dim; ++d) {
            const int cell = d == 0 ? at[0] * W + lane_index : at[static_cast<std::size_t>(d)];
            real r;
            const real* lanes_of_slot = store_.lane_of(slot, lane_index);
            if constexpr (stores<List, field::position>)
                r = lanes_of_slot[(store_type::slot::template first<field::position>() + d) * W];
            else {
                using weights = detail::held_weights<Shape>;
                const real* first = lanes_of_slot + store_type::slot::template first<weights>() * W;
                r = weights::template place<S>(d, [&](int c) { return first[c * W]; });
            }
            where[d] = grid.lower()[d] + grid.spacing() * (real(cell) - real(Shape::shift) + r);
            if constexpr (detail::keeps_first_place<List>)
                where[d] += lanes_of_slot[(store_type::slot::template first<field::displacement>() + d) * W];
        }
        return where;
    }

    /// For the solver.
    /// @{
    store_type& store() { return store_; }
    const store_type& store() const { return store_; }
    const lattice_type& lattice() const { return lattice_; }
    // Renewed whenever the particles were open to changes.
    const detail::stamp& contents() const { return contents_; }
    static constexpr bool needs_flow = detail::needs_flow<Law, Shape, List>;
    auto& carried_nodes() { return carried_; }
    /// @}

  private:
    lattice_type lattice_;
    store_type store_;
    detail::stamp contents_;
    [[no_unique_address]] detail::carried_nodes<S, needs_flow> carried_;

    const store_type& delivered() const {
        store_.deliver_all();
        return store_;
    }
};

/// The bodies of a step, by reference: `mpm.step(bodies(block, floor), dt)`.
template <class... Body> std::tuple<Body&...> bodies(Body&... each) { return {each...}; }

}  // namespace tamis
