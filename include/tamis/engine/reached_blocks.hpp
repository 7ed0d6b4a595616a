#pragma once
#include <tamis/core/config.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/engine/wrap.hpp>
#include <tamis/engine/tile.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tamis::detail {

/// The tiles of a body, and the stamp of their order: while it stays, tiles are only added.
struct placed_tiles {
    std::uint64_t ground;
    std::span<const tile> tiles;
};
template <class Store> placed_tiles tiles_of(const Store& store) { return {store.ground.number(), store.tiles}; }

/// Which blocks of W nodes particles reach: a mark for each block of the grid, and a list of those marked, ascending.
class reached_blocks {
  public:
    const std::vector<std::uint32_t>& blocks() const { return blocks_; }
    std::span<const char> marks() const { return {marks_.data(), marks_.size()}; }

    /// Marks what the tiles of these bodies reach, and nothing else. Where tiles have only been added since, those are
    /// looked at.
    template <class Lattice> TAMIS_SELDOM void mark(const std::vector<placed_tiles>& bodies, const Lattice& lattice) {
        bool grown = std::exchange(whole_, false) && seen_.size() == bodies.size();
        for (std::size_t k = 0; k < bodies.size(); ++k) grown = grown && seen_[k].ground == bodies[k].ground;
        if (!grown) {
            marks_ = zeros<char>(lattice.size() / W<Lattice> + 2);
            blocks_.clear();
            seen_.assign(bodies.size(), {0, 0});
        }
        const std::vector<std::uint32_t> known = std::exchange(blocks_, {});
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            add(bodies[k].tiles.subspan(seen_[k].tiles), lattice);
            seen_[k] = {bodies[k].ground, bodies[k].tiles.size()};
        }
        std::sort(blocks_.begin(), blocks_.end());
        std::vector<std::uint32_t> all(known.size() + blocks_.size());
        std::merge(known.begin(), known.end(), blocks_.begin(), blocks_.end(), all.begin());
        blocks_.swap(all);
        whole_ = true;
    }

  private:
    template <class Lattice> static constexpr auto W = static_cast<std::size_t>(Lattice::W);
    zeros<char> marks_;
    std::vector<std::uint32_t> blocks_;
    struct part {
        std::uint64_t ground;
        std::size_t tiles;
    };
    std::vector<part> seen_;  // of each body
    bool whole_ = false;      // no call was left half done by what it threw

    template <class Lattice> void add(std::span<const tile> tiles, const Lattice& lattice) {
        const auto mark = [&](std::size_t block) {
            if (!std::exchange(marks_[block], char(1))) blocks_.push_back(static_cast<std::uint32_t>(block));
        };
        for (const tile& t : tiles)
            for (int r = 0; r < Lattice::rows; ++r) {
                const std::size_t first = (t.node + lattice.row_offset(r)) / W<Lattice>;
                for (std::size_t k = 0; k <= (W<Lattice> + Lattice::N - 2) / W<Lattice>; ++k) mark(first + k);
            }
        reach_images(
            lattice, [&](std::size_t place) { return marks_[place / W<Lattice>] != 0; },
            [&](std::size_t place) { mark(place / W<Lattice>); });
    }
};

}  // namespace tamis::detail
