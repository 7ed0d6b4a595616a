#pragma once
#include <tamis/engine/mail.hpp>

#include <array>
#include <cstddef>
#include <cstdint>

namespace tamis::detail {

/// W neighbouring cells along x; lane l of each of its slots holds a particle of cell l, or is empty. A lane's
/// particles are in the tile's first slots, without gaps: so the tile has as many slots as its fullest lane.
struct tile {
    std::array<int, 3> at;            // block along x, cells along y and z
    std::size_t node;                 // storage place of the first node that lane 0 reaches
    std::uint32_t first, count;       // slots in use
    std::uint32_t room;               // slots kept for it
    letter_place letter = no_letter;  // the first to be delivered
    std::uint32_t letters = 0;
    std::uint8_t marks = 0;  // why it takes a longer way

    static constexpr std::uint8_t on_edges = 1;  // particles are on edges of their cells (`lattice::on_edge`)
    static constexpr std::uint8_t fenced = 2;    // there is something near that particles may not pass
    bool has(std::uint8_t mark) const { return (marks & mark) != 0; }
    void set(std::uint8_t mark, bool on) { marks = static_cast<std::uint8_t>(on ? marks | mark : marks & ~mark); }
};

}  // namespace tamis::detail
