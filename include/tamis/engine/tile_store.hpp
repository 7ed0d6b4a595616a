#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/left_work.hpp>
#include <tamis/engine/mail.hpp>
#include <tamis/engine/tile_order.hpp>
#include <tamis/grid/lattice.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Particle storage. A particle that leaves its cell goes into a letter (`post`); `sort_mail` hands the letters to
/// their tiles, and `deliver` puts them in, when the next pass brings the tile into cache.
template <class S, class List> class tile_store : public tile_order<S, List> {
    using base = tile_order<S, List>;

  public:
    using base::D, base::W, base::components, base::tiles, base::slots, base::occupied, base::lane_of, base::slabs;
    using typename base::real;
    using mail_type = mail<real, components>;
    static constexpr int outside = mail_type::outside;
    using base::base;

    /// Puts the particle of slot s, lane l on its way to another cell; the last particle of that lane takes its place.
    /// Slabs may do so at the same time.
    template <class Lattice> void post(const Lattice& lattice, std::size_t slab, const tile& t, std::uint32_t s, int l,
                                       const std::array<int, 3>& from_cell, const std::array<int, 3>& cell,
                                       bool on_edge = false) {
        // The tile is looked for here, where it is near those that the processor has at hand.
        const bool inside = cell[0] != outside;
        auto& to = written_.write(
            slab, inside ? std::as_const(tile_of_block_)[lattice.block_place({cell[0] / W, cell[1], cell[2]})] : 0,
            inside ? cell[0] % W : 0, on_edge);
        const real* from = lane_of(s, l);
        for (int c = 0; c < components; ++c) to.value[c] = from[c * W];
        to.from = from_cell;
        to.cell = cell;
        to.origin = static_cast<std::size_t>(s) * static_cast<std::size_t>(W) + static_cast<std::size_t>(l);
        fill_gap(t, s, l);
    }
    /// Gives back the slots that a tile no longer needs, after it posted particles.
    void shrink(std::size_t slab, tile& t) {
        while (t.count > 0 && occupied[t.first + t.count - 1] == 0) --t.count;
        if (t.count == 0) written_.tell_emptied(slab);
    }
    /// A particle of a tile is on an edge of its cell (`lattice::on_edge`): told while slabs are gone through, or of a
    /// cell of a new body.
    void note_edge(std::size_t slab, tile& t) {
        t.set(tile::on_edges, true);
        written_.tell_edge(slab);
    }
    template <class Lattice> void note_edge(const Lattice& lattice, const std::array<int, 3>& cell) {
        tiles[static_cast<std::size_t>(tile_at(lattice, cell))].set(tile::on_edges, true);
        edges_ = true;
    }
    /// Marks the tiles near a fence, near(tile), that is known by a number: once, as long as no tiles come or go.
    template <class Near> void mark_fence(std::uint64_t number, const Near& near) {
        if (fence_ == number && fence_seen_ == this->layout.number()) return;
        for (tile& t : tiles) t.set(tile::fenced, near(t));
        fence_ = number;
        fence_seen_ = this->layout.number();
    }
    /// Were there any on edges after the last step?
    bool has_edges() const { return edges_; }
    /// Hands the letters of all outboxes, in their order, to the tiles. Returns how many there were. `left(letter)`
    /// decides about particles outside the grid: it gives their cell and place valid values, or returns false to remove
    /// them.
    template <class Lattice, class Left, class Execution = serial>
    std::size_t sort_mail(const Lattice& lattice, Left&& left, const Execution& run = {}) {
        std::size_t left_over = 0;
        if (mail_.has_new()) {
            // An earlier call ran out of memory.
            delivery_.leave();
            left_over = hand_out(lattice, left, run);
            written_.forget_tiles();
        }
        deliver_all();
        emptied_ = written_.take_emptied() || emptied_;
        edges_ = written_.take_edges();
        std::swap(mail_, written_);
        delivery_.leave();
        return left_over + hand_out(lattice, left, run);
    }
    bool has_mail() const { return mail_.waits(); }
    /// Puts a tile's letters in.
    void deliver(tile& t) {
        if (t.letter.is_none()) return;
        for (letter_place k = std::exchange(t.letter, no_letter); !k.is_none(); k = mail_.address_of(k).next) {
            const auto l = static_cast<int>(mail_.address_of(k).lane);
            const real* const from = mail_.at(k).value;
            real* const to = lane_of(free_slot(t, l), l);
            for (int c = 0; c < components; ++c) to[c * W] = from[c];
        }
        t.letters = 0;
    }
    /// To be called once every tile has had its letters.
    void mail_delivered() {
        mail_.clear();
        delivery_.was_done();
    }
    /// Letters under way are particles too: to put them in changes no particle, so that whoever looks first may do it,
    /// in whatever thread. A store that was declared const never has any (`body` sees to it).
    void deliver_all() const {
        delivery_.settle([this] {
            auto& self = const_cast<tile_store&>(*this);
            // Letters that were not handed out, for memory ran out, stay.
            if (!self.mail_.waits()) return;
            for (tile& t : self.tiles) self.deliver(t);
            self.mail_.clear();
        });
    }
    /// Tiles in the order of their nodes, slots without gaps, when new or empty tiles have become many.
    template <class Lattice, class Execution = serial> void tidy(const Lattice& lattice, const Execution& run = {}) {
        std::size_t empty = 0;
        if (std::exchange(emptied_, false))
            for (const tile& t : tiles) empty += t.count == 0 && t.letter.is_none() ? 1 : 0;
        if (empty > tiles.size() / 4 + 1 || tiles.size() > sorted_ + sorted_ / 8 + 16) sort(lattice, 2, run);
    }
    /// ... at once, with so many spare slots for each tile or half as many as it has (0: none). Letters go on waiting,
    /// and find room.
    template <class Lattice, class Execution = serial>
    void sort(const Lattice& lattice, std::uint32_t spare, const Execution& run = {}) {
        base::sort(
            lattice, spare, [&](const tile& t) { return slots_with_letters(t); }, run);
    }
    /// Brings the slabs up to date, for functions that reach N nodes along an axis.
    template <int N> void arrange() {
        slabs_.arrange(tiles, static_cast<std::size_t>(D - 1), D == 1 ? (N - 2) / W + 1 : N - 1);
        for (auto* one : {&mail_, &written_}) one->have_boxes(slabs());
    }

  private:
    using base::tile_of_block_, base::count_, base::slabs_, base::sorted_, base::tile_at, base::even, base::free_slot,
        base::fill_gap, base::in_lane, base::make_room;
    mail_type mail_, written_;  // to be delivered, and not sorted yet; an outbox for each slab
    std::vector<std::uint32_t> got_letters_;
    left_work delivery_;  // of mail_
    bool emptied_ = false, edges_ = false;
    std::uint64_t fence_ = 0, fence_seen_ = 0;

    template <class Lattice, class Left, class Execution>
    std::size_t hand_out(const Lattice& lattice, Left&& left, const Execution& run) {
        got_letters_.clear();
        const auto left_edge = [&](const auto& letter) {
            if constexpr (stores<List, field::position>) {
                point<D, real> local;
                for (int d = 0; d < D; ++d) local[d] = letter.value[base::slot::template first<field::position>() + d];
                return lattice.on_edge(letter.cell, local);
            } else
                return false;
        };
        const std::size_t handed = mail_.each_new([&](const letter_place& k) {
            auto& to = mail_.address_of(k);
            if (to.tile == 0) {
                auto& letter = mail_.at(k);
                if (letter.cell[0] == outside && !left(letter)) {
                    --count_;
                    return false;
                }
                to.tile = tile_at(lattice, letter.cell) + 1;
                to.lane = static_cast<std::uint16_t>(letter.cell[0] % W);
                if (left_edge(letter)) to.on_edge = true;
            }
            const auto index = static_cast<std::uint32_t>(to.tile - 1);
            tile& t = tiles[index];
            if (to.on_edge) {
                t.set(tile::on_edges, true);
                edges_ = true;
            }
            if (t.letter.is_none()) got_letters_.push_back(index);
            to.next = std::exchange(t.letter, k);
            ++t.letters;
            return true;
        });
        make_rooms_for_letters(lattice, run);
        if (!mail_.waits()) mail_delivered();  // all were removed
        return handed;
    }
    /// Slots are made here, not in `deliver`: that may run in several threads. Where the addresses do not suffice for
    /// all, gaps have become many: then tiles are sorted.
    template <class Lattice, class Execution>
    void make_rooms_for_letters(const Lattice& lattice, const Execution& run) {
        const auto wanted = [&](const tile& t) {
            const std::uint32_t least = t.count + t.letters <= t.room ? 0 : slots_with_letters(t);
            return least > t.room ? even(least + 1) : 0;
        };
        std::size_t more = 0;
        for (const std::uint32_t index : got_letters_) more += wanted(tiles[index]);
        if (more == 0) return;
        if (slots.size() + more > slots.capacity()) return sort(lattice, 2, run);
        for (const std::uint32_t index : got_letters_)
            if (const std::uint32_t room = wanted(tiles[index])) make_room(tiles[index], room);
    }
    /// Slots that a tile will need once its letters are in.
    std::uint32_t slots_with_letters(const tile& t) const {
        std::array<std::uint32_t, static_cast<std::size_t>(W)> in{};
        for (int l = 0; l < W; ++l) in[static_cast<std::size_t>(l)] = in_lane(t, l);
        for (letter_place k = t.letter; !k.is_none(); k = mail_.address_of(k).next) ++in[mail_.address_of(k).lane];
        return std::max(t.count, *std::max_element(in.begin(), in.end()));
    }
};

}  // namespace tamis::detail
