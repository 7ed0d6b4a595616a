#pragma once
#include <tamis/core/config.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tamis::detail {

/// The numbers of these tiles in a list, from the first-th on, in the order of their nodes.
template <class Tile>
TAMIS_SELDOM std::vector<std::uint32_t> by_nodes(const std::vector<Tile>& tiles, std::size_t first) {
    std::vector<std::pair<std::size_t, std::size_t>> nodes;
    nodes.reserve(tiles.size() - first);
    for (std::size_t k = first; k < tiles.size(); ++k) nodes.emplace_back(tiles[k].node, k);
    std::sort(nodes.begin(), nodes.end());
    std::vector<std::uint32_t> order;
    order.reserve(nodes.size());
    for (const auto& one : nodes) order.push_back(static_cast<std::uint32_t>(one.second));
    return order;
}

/// Tiles by their numbers in a list, in the order of their nodes, grouped into slabs across the outermost axis such
/// that slabs k and k + 2 reach no common node. The grouping depends on the tiles only, never on the number of threads:
/// so do sums that are made slab by slab.
class slab_order {
  public:
    /// The list is another one.
    void start_anew() {
        order_.clear();
        arranged_ = false;
    }
    /// Brings all up to date where tiles were added to the end of the list, with slabs of at least `thinnest` cells
    /// along the outermost axis.
    template <class Tile>
    TAMIS_SELDOM void arrange(const std::vector<Tile>& tiles, std::size_t outermost, int thinnest) {
        if (arranged_ && order_.size() == tiles.size()) return;
        const std::vector<std::uint32_t> more = by_nodes(tiles, order_.size());
        std::vector<std::uint32_t> merged(tiles.size());
        std::merge(order_.begin(), order_.end(), more.begin(), more.end(), merged.begin(),
                   [&](std::uint32_t a, std::uint32_t b) { return tiles[a].node < tiles[b].node; });
        order_.swap(merged);
        ends_.assign(1, 0);
        begins_.assign(1, tiles.empty() ? 0 : tiles[order_.front()].at[outermost]);
        if (tiles.size() > 64) {
            const int low = tiles[order_.front()].at[outermost];
            const int extent = tiles[order_.back()].at[outermost] - low + 1;
            const int count = slabs_across(extent / thinnest, tiles.size());
            for (int k = 1; k <= count; ++k) {
                const int end = low + static_cast<int>(static_cast<long>(extent) * k / count);
                std::uint32_t last = ends_.back();
                while (last < order_.size() && tiles[order_[last]].at[outermost] < end) ++last;
                ends_.push_back(last);
                begins_.push_back(end);
            }
        } else
            ends_.push_back(static_cast<std::uint32_t>(order_.size()));
        arranged_ = true;
    }
    std::size_t count() const { return ends_.empty() ? 0 : ends_.size() - 1; }
    /// Where slab k begins: its cells along the outermost axis are none before this one.
    int begin_of(std::size_t k) const { return begins_[k]; }
    /// The tiles of slab k.
    std::span<const std::uint32_t> tiles_of(std::size_t k) const {
        return {order_.data() + ends_[k], ends_[k + 1] - ends_[k]};
    }

  private:
    bool arranged_ = false;
    std::vector<std::uint32_t> order_, ends_;
    std::vector<int> begins_;

    /// How many slabs of equal thickness, where there is room for so many: at most 128, or as many as have 128 tiles
    /// each, about half a megabyte of particles, so that some slabs fit into a core's own cache; 16 tiles in each, so
    /// that what a slab takes beside its tiles is little; and as many in each colour as two threads can share evenly.
    static int slabs_across(int room, std::size_t tiles) {
        constexpr std::size_t enough = 128, of_tiles = 128, least_tiles = 16;
        const int count = static_cast<int>(
            std::min({static_cast<std::size_t>(room), std::max(enough, tiles / of_tiles), tiles / least_tiles}));
        return count >= 8 ? count / 4 * 4 : std::max(count, 1);
    }
};

}  // namespace tamis::detail
