#pragma once
#include <tamis/core/execution.hpp>
#include <tamis/engine/slabs.hpp>
#include <tamis/engine/tile_slots.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Tiles in an order: slabs of tiles in the order of their nodes; and storage in that order, without gaps.
template <class S, class List> class tile_order : public tile_slots<S, List> {
    using base = tile_slots<S, List>;

  public:
    using base::base;
    using base::D, base::W, base::tiles, base::slots, base::occupied, base::layout, base::ground;
    using typename base::slot;

    /// Makes the tiles and slots of an empty store for particles in the cells that each_cell(f) gives to f, so that
    /// adding them moves nothing: large bodies would else be copied, and take their memory many times over. Threads
    /// write parts of them first, so that memory is spread over that of their processors.
    template <class Lattice, class EachCell, class Execution = serial>
    TAMIS_NOINLINE void prepare(const Lattice& lattice, const EachCell& each_cell, const Execution& run = {}) {
        std::vector<std::array<std::uint32_t, static_cast<std::size_t>(W)>> in_lane;
        each_cell([&](const std::array<int, 3>& cell) {
            const auto t = static_cast<std::size_t>(tile_at(lattice, cell));
            if (t == in_lane.size()) in_lane.emplace_back();
            ++in_lane[t][static_cast<std::size_t>(cell[0] % W)];
        });
        for (std::size_t t = 0; t < tiles.size(); ++t)
            tiles[t].room = *std::max_element(in_lane[t].begin(), in_lane[t].end());
        std::vector<tile> in_order;
        in_order.reserve(tiles.size());
        for (const std::uint32_t k : by_nodes(tiles, 0)) in_order.push_back(tiles[k]);
        tiles = std::move(in_order);
        std::size_t needed = 0;
        for (std::size_t t = 0; t < tiles.size(); ++t) {
            tiles[t].first = static_cast<std::uint32_t>(needed);
            needed += tiles[t].room;
            tile_of_block_[lattice.block_place(tiles[t].at)] = static_cast<int>(t + 1);
        }
        slots.reserve(with_growth(needed));
        slots.resize(needed);
        in_parts(run, needed, [&](std::size_t s) { slots[s].set_zero(); });
        occupied.assign(needed, 0);
        renew_order();
    }
    std::size_t slabs() const { return slabs_.count(); }
    /// The tiles of slab k, in the order of their nodes.
    std::span<const std::uint32_t> row(std::size_t k) const { return slabs_.tiles_of(k); }
    /// Storage places of the first nodes that each slab, with all after it, may reach.
    template <class Lattice> TAMIS_SELDOM std::vector<std::size_t> first_nodes(const Lattice& lattice) const {
        std::vector<std::size_t> all;
        for (std::size_t k = 0; k < slabs(); ++k) {
            std::array<int, 3> cell{0, 0, 0};
            cell[static_cast<std::size_t>(D - 1)] = slabs_.begin_of(k);
            all.push_back(lattice.first_node(cell));
        }
        return all;
    }
    /// Storage place of the first node that slab k reaches.
    std::size_t first_place(std::size_t k) const { return tiles[row(k).front()].node; }
    /// Runs f(tile index, first slot of the tile that comes `Ahead` tiles later) over the tiles of slab k, in the order
    /// of their nodes.
    template <int Ahead, class F> TAMIS_INLINE void each_tile_and_soon(std::size_t k, F&& f) const {
        const auto all = row(k);
        const std::size_t last = all.size() - 1;
        for (std::size_t j = 0; j < all.size(); ++j)
            f(all[j], slots.data() + tiles[all[std::min(j + static_cast<std::size_t>(Ahead), last)]].first);
    }

  protected:
    using base::tile_of_block_, base::left_, base::tile_at, base::even;
    slab_order slabs_;
    std::size_t sorted_ = 0;

    /// Puts tiles into the order of their nodes, and their slots without gaps; each has wanted(tile) slots, and so many
    /// spare ones, or half as many as it wants, whichever is more: tiles that need more room go where the processor
    /// does not guess them. 0: none.
    template <class Lattice, class Wanted, class Execution>
    TAMIS_NOINLINE void sort(const Lattice& lattice, std::uint32_t spare, const Wanted& wanted, const Execution& run) {
        const auto room_of = [&](const tile& t) {
            const std::uint32_t count = wanted(t);
            return spare == 0 ? count : even(count + std::max(spare, count / 2));
        };
        std::vector<std::uint32_t> order;
        for (const std::uint32_t k : by_nodes(tiles, 0))
            if (tiles[k].count > 0 || !tiles[k].letter.is_none()) order.push_back(k);
        std::vector<tile> new_tiles;
        new_tiles.reserve(order.size());
        std::size_t needed = 0;
        for (const std::uint32_t k : order) {
            tile& t = new_tiles.emplace_back(tiles[k]);
            t.room = room_of(t);
            t.first = static_cast<std::uint32_t>(needed);
            needed += t.room;
        }
        roomy_vector<slot> new_slots;
        new_slots.reserve(with_growth(needed));
        new_slots.resize(needed);
        std::vector<std::uint32_t> new_occupied(needed);
        in_parts(run, order.size(), [&](std::size_t j) {
            const tile& t = new_tiles[j];
            const std::uint32_t before = tiles[order[j]].first;
            for (std::uint32_t s = 0; s < t.count; ++s) {
                new_slots[t.first + s] = slots[before + s];
                new_occupied[t.first + s] = occupied[before + s];
            }
            for (std::uint32_t s = t.count; s < t.room; ++s) new_slots[t.first + s].set_zero();
        });
        // From here on nothing throws: where memory did not suffice, all is as it was.
        for (const tile& t : tiles) tile_of_block_[lattice.block_place(t.at)] = 0;
        for (std::size_t j = 0; j < new_tiles.size(); ++j)
            tile_of_block_[lattice.block_place(new_tiles[j].at)] = static_cast<int>(j + 1);
        tiles.swap(new_tiles);
        slots.swap(new_slots);
        occupied.swap(new_occupied);
        left_.clear();
        renew_order();
    }

  private:
    /// f(k) for k < count, parts of it by threads.
    template <class Execution, class F> static void in_parts(const Execution& run, std::size_t count, const F& f) {
        constexpr std::size_t parts = 32;
        in_chunks(run, count, count / parts + 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) f(k);
        });
    }
    /// How many slots there may be before they are sorted. Addresses for them are taken at once, memory when they come:
    /// so slots are not copied as they become more.
    static std::size_t with_growth(std::size_t needed) { return needed + needed / 2 + 256; }
    /// Tiles are in the order of their nodes.
    void renew_order() {
        sorted_ = tiles.size();
        slabs_.start_anew();
        layout.renew();
        ground.renew();
    }
};

}  // namespace tamis::detail
