#pragma once
#include <tamis/core/config.hpp>
#include <tamis/core/count.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/core/stamp.hpp>
#include <tamis/core/values.hpp>
#include <tamis/engine/prefetch.hpp>
#include <tamis/engine/tile.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Tiles with their slots: where particles are kept, and the room that is kept for more. Tiles exist only where
/// particles are. Empty lanes hold zeros, hence no mass.
template <class S, class List> class tile_slots {
  public:
    using real = typename S::real;
    using slot = values<S, List>;
    static constexpr int D = S::dim, W = S::width, components = slot::components;
    static constexpr std::uint32_t full = W >= 32 ? ~0u : (1u << W) - 1u;
    static_assert(W <= 32 && sizeof(slot) == sizeof(real) * static_cast<std::size_t>(W * components));

    std::vector<tile> tiles;
    roomy_vector<slot> slots;             // with addresses for more, so that it is not moved
    std::vector<std::uint32_t> occupied;  // per slot: which lanes hold a particle
    stamp layout;                         // renewed when tiles come or go
    stamp ground;                         // renewed when tiles go, or change their order
    std::uint64_t updates = 0;            // how often steps changed the particles

    explicit tile_slots(std::size_t blocks) : tile_of_block_(blocks) {}

    std::size_t size() const { return count_; }
    /// Was it moved from? It has no place for particles then, until another is assigned to it.
    bool moved_from() const { return tile_of_block_.size() == 0; }
    real* lane_of(std::uint32_t s, int l) { return reinterpret_cast<real*>(&slots[s]) + l; }
    const real* lane_of(std::uint32_t s, int l) const { return reinterpret_cast<const real*>(&slots[s]) + l; }
    /// A new particle in a cell, all its fields zero: its slot. The lane is the cell's.
    template <class Lattice> std::uint32_t add(const Lattice& lattice, const std::array<int, 3>& cell) {
        tile& t = tiles[static_cast<std::size_t>(tile_at(lattice, cell))];
        const std::uint32_t s = free_slot(t, cell[0] % W);
        ++count_;
        return s;
    }
    /// Takes a particle of a tile out.
    void remove(const tile& t, std::uint32_t s, int l) {
        fill_gap(t, s, l);
        --count_;
    }
    /// Share of the lanes in use that hold a particle.
    double occupancy() const {
        std::size_t lanes_in_use = 0;
        for (const tile& t : tiles) lanes_in_use += static_cast<std::size_t>(t.count) * static_cast<std::size_t>(W);
        return lanes_in_use == 0 ? 1.0 : static_cast<double>(size()) / static_cast<double>(lanes_in_use);
    }
    /// How many components of a slot there are up to the last of some fields.
    template <class... F> static constexpr int components_to(fields<F...>) {
        return std::max({slot::template first<F>() + F::template components<S>...});
    }
    /// Asks for a slot that will be needed soon, from its beginning up to the last of some fields: after particles have
    /// crossed cells, tiles that follow one another do not lie one after the other, and processors do not guess where
    /// the next one is. Of `parts` calls each asks for some of the lines: a processor waits for few at the same time.
    template <class... F> TAMIS_INLINE void fetch([[maybe_unused]] const slot* s, fields<F...>,
                                                  [[maybe_unused]] int part = 0, [[maybe_unused]] int parts = 1) const {
        constexpr int count = components_to(fields<F...>{});
        prefetch<false>(s, static_cast<std::size_t>(count * W) * sizeof(real), part, parts);
    }
    /// ... or for all of it, to be written.
    TAMIS_INLINE void fetch_to_write(const slot* s) const { prefetch<true>(s, sizeof(slot), 0, 1); }

  protected:
    zeros<int> tile_of_block_;  // from 1; 0: none
    count count_;
    std::vector<std::vector<std::uint32_t>> left_;  // by the number of slots: first ones of room that tiles left

    /// Few sizes, so that room that a tile left serves another.
    static std::uint32_t even(std::uint32_t room) { return room + room % 2; }
    template <class Lattice> int tile_at(const Lattice& lattice, const std::array<int, 3>& cell) {
        const std::array<int, 3> at{cell[0] / W, cell[1], cell[2]};
        int& t = tile_of_block_[lattice.block_place(at)];
        if (t == 0) {
            tiles.push_back({at, lattice.first_node(at), static_cast<std::uint32_t>(slots.size()), 0, 0});
            t = static_cast<int>(tiles.size());
            layout.renew();
        }
        return t - 1;
    }
    void clear_lane(std::uint32_t s, int l) {
        real* p = lane_of(s, l);
        for (int c = 0; c < components; ++c) p[c * W] = real(0);
        occupied[s] &= ~(1u << l);
    }
    /// The last particle of lane l goes to slot s of a tile; none is there any more.
    void fill_gap(const tile& t, std::uint32_t s, int l) {
        const std::uint32_t last = t.first + in_lane(t, l) - 1;
        if (last != s) {
            real *to = lane_of(s, l), *from = lane_of(last, l);
            for (int c = 0; c < components; ++c) to[c * W] = from[c * W];
        }
        clear_lane(last, l);
    }
    /// Number of particles in lane l.
    std::uint32_t in_lane(const tile& t, int l) const {
        std::uint32_t n = t.count;
        while (n > 0 && !(occupied[t.first + n - 1] >> l & 1u)) --n;
        return n;
    }
    /// The first place of lane l that is free, marked as occupied.
    std::uint32_t free_slot(tile& t, int l) {
        const std::uint32_t n = in_lane(t, l);
        if (n == t.count) {
            if (n == t.room) make_room(t, t.room == 0 ? 4 : t.room + std::max(2u, t.room / 2));
            ++t.count;
        }
        occupied[t.first + n] |= 1u << l;
        return t.first + n;
    }
    /// Moves the tile's slots to where there is more room: where another tile was, or to the end.
    void make_room(tile& t, std::uint32_t least) {
        std::uint32_t room = even(least);
        auto first = static_cast<std::uint32_t>(slots.size());
        // A little larger will do.
        const std::size_t end = std::min<std::size_t>(left_.size(), room + 4);
        std::uint32_t found = room;
        while (found < end && left_[found].empty()) ++found;
        if (found < end) {
            room = found;
            first = left_[room].back();
            left_[room].pop_back();
        } else {
            slots.resize(first + room);
            occupied.resize(first + room, 0);
        }
        if (t.room > 0) {
            if (left_.size() <= t.room) left_.resize(t.room + 1);
            left_[t.room].push_back(t.first);
        }
        for (std::uint32_t k = 0; k < room; ++k) {
            if (k < t.count) {
                slots[first + k] = slots[t.first + k];
                occupied[first + k] = std::exchange(occupied[t.first + k], 0u);
            } else
                slots[first + k].set_zero();
        }
        t.first = first;
        t.room = room;
    }
};

}  // namespace tamis::detail
