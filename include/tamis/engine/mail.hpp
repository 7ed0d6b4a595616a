#pragma once
#include <tamis/core/count.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Where a letter is: in which outbox, and its place there.
struct letter_place {
    std::uint32_t box, at;
    static constexpr std::uint32_t none = ~0u;
    bool is_none() const { return box == none; }
};
inline constexpr letter_place no_letter{letter_place::none, 0};

/// Particles on their way to other cells, each in a letter: `Components` numbers, and where from and to. Letters stay
/// in the outbox they were put in until all are delivered.
template <class real, int Components> class mail {
  public:
    struct letter {
        real value[Components];
        std::array<int, 3> from, cell;  // cell[0] == outside: not in the grid; the place is relative to `from`
        std::size_t origin;             // place in storage
        letter() {}                     // written in place, whole
    };
    static constexpr int outside = -1;
    /// Where a letter goes, apart from it: so that handing out letters reads little.
    struct address {
        int tile;  // from 1; 0: not known yet
        std::uint16_t lane;
        bool on_edge;       // of that cell
        letter_place next;  // to the same tile
    };

    /// At least so many outboxes: threads that have one each write without meeting. Not fewer than there were, for
    /// there may be letters in them.
    void have_boxes(std::size_t count) { boxes_.resize(std::max(boxes_.size(), count)); }
    /// A new letter in an outbox, to be written.
    letter& write(std::size_t box, int tile, int lane, bool on_edge) {
        boxes_[box].addresses.push_back({tile, static_cast<std::uint16_t>(lane), on_edge, no_letter});
        return boxes_[box].letters.emplace_back();
    }
    const letter& at(const letter_place& k) const { return boxes_[k.box].letters[k.at]; }
    letter& at(const letter_place& k) { return boxes_[k.box].letters[k.at]; }
    const address& address_of(const letter_place& k) const { return boxes_[k.box].addresses[k.at]; }
    address& address_of(const letter_place& k) { return boxes_[k.box].addresses[k.at]; }

    /// hand(place) of the letters written since it was last called, in the order of the outboxes; true if a letter is
    /// to be delivered, false if it is no more. Returns how many are to be delivered.
    template <class Hand> std::size_t each_new(Hand hand) {
        const std::size_t before = waiting_;
        for (std::uint32_t b = 0; b < boxes_.size(); ++b)
            for (auto& box = boxes_[b]; box.seen < box.letters.size(); ++box.seen)
                waiting_ += hand(letter_place{b, box.seen}) ? 1 : 0;
        return waiting_ - before;
    }
    /// Are there letters to be delivered?
    bool waits() const { return waiting_ > 0; }
    /// All that were handed out were delivered.
    void clear() {
        waiting_ = {};
        for (outbox& box : boxes_) {
            const auto seen = static_cast<std::ptrdiff_t>(std::exchange(box.seen, 0u));
            box.letters.erase(box.letters.begin(), box.letters.begin() + seen);
            box.addresses.erase(box.addresses.begin(), box.addresses.begin() + seen);
        }
    }
    /// Are there letters that were not handed out?
    bool has_new() const {
        for (const outbox& box : boxes_)
            if (box.seen < box.letters.size()) return true;
        return false;
    }
    /// Tiles have other numbers now: where letters go is looked up when they are handed out.
    void forget_tiles() {
        for (outbox& box : boxes_)
            for (address& to : box.addresses) to.tile = 0;
    }

    /// Slabs that emptied a tile tell so by the way.
    void tell_emptied(std::size_t box) { boxes_[box].emptied_a_tile = true; }
    /// ... and that a particle of it is on an edge of its cell.
    void tell_edge(std::size_t box) { boxes_[box].has_edge = true; }
    bool take_edges() {
        bool any = false;
        for (outbox& box : boxes_) any = std::exchange(box.has_edge, false) || any;
        return any;
    }
    bool take_emptied() {
        bool any = false;
        for (outbox& box : boxes_) any = std::exchange(box.emptied_a_tile, false) || any;
        return any;
    }

  private:
    struct alignas(64) outbox {  // on cache lines of its own
        std::vector<letter> letters;
        std::vector<address> addresses;
        std::uint32_t seen = 0;
        bool emptied_a_tile = false, has_edge = false;
    };
    std::vector<outbox> boxes_;
    count waiting_;
};

}  // namespace tamis::detail
