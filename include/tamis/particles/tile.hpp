#pragma once
#include <tamis/core/config.hpp>
#include <tamis/core/error.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/core/stamp.hpp>
#include <tamis/core/values.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/particles/mail.hpp>
#include <tamis/particles/slabs.hpp>

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

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
};

/// Particle storage: tiles exist only where particles are. Empty lanes hold zeros, hence no mass.
///
/// A particle that leaves its cell goes into a letter (`post`); `sort_mail` hands the letters to their tiles, and
/// `deliver` puts them in, when the next pass brings the tile into cache.
template <class S, class List> class tile_store {
  public:
    using real = typename S::real;
    using slot = values<S, List>;
    static constexpr int D = S::dim, W = S::width, components = slot::components;
    static constexpr std::uint32_t full = W >= 32 ? ~0u : (1u << W) - 1u;
    static_assert(W <= 32 && sizeof(slot) == sizeof(real) * static_cast<std::size_t>(W * components));
    using mail_type = mail<real, components>;
    static constexpr int outside = mail_type::outside;

    std::vector<tile> tiles;
    std::vector<slot, aligned_allocator<slot>> slots;
    std::vector<std::uint32_t> occupied;  // per slot: which lanes hold a particle
    stamp layout;                         // renewed when tiles come or go
    stamp ground;                         // renewed when tiles go, or change their order
    std::uint64_t updates = 0;            // how often steps changed the particles

    explicit tile_store(std::size_t blocks) : tile_of_block_(blocks) {}

    std::size_t size() const { return count_; }
    real* lane_of(std::uint32_t s, int l) { return reinterpret_cast<real*>(&slots[s]) + l; }
    const real* lane_of(std::uint32_t s, int l) const { return reinterpret_cast<const real*>(&slots[s]) + l; }

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
    /// Puts the particle of slot s, lane l on its way to another cell; the last particle of that lane takes its place.
    /// Slabs may do so at the same time.
    template <class Lattice> void post(const Lattice& lattice, std::size_t slab, const tile& t, std::uint32_t s, int l,
                                       const std::array<int, 3>& from_cell, const std::array<int, 3>& cell) {
        // The tile is looked for here, where it is near those that the processor has at hand.
        const bool inside = cell[0] != outside;
        auto& to = written_.write(
            slab, inside ? std::as_const(tile_of_block_)[lattice.block_place({cell[0] / W, cell[1], cell[2]})] : 0,
            static_cast<std::uint32_t>(inside ? cell[0] % W : 0));
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
    /// Hands the letters of all outboxes, in their order, to the tiles. Returns how many there were. `left(letter)`
    /// decides about particles outside the grid: it gives their cell and place valid values, or returns false to remove
    /// them.
    template <class Lattice, class Left, class Execution = serial>
    std::size_t sort_mail(const Lattice& lattice, Left&& left, const Execution& run = {}) {
        std::size_t left_over = 0;
        if (mail_.has_new()) {
            // An earlier call ran out of memory.
            left_over = hand_out(lattice, left, run);
            written_.forget_tiles();
        }
        deliver_all();
        emptied_ = written_.take_emptied() || emptied_;
        std::swap(mail_, written_);
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
    void mail_delivered() { mail_.clear(); }
    void deliver_all() {
        if (!mail_.waits()) return;
        for (tile& t : tiles) deliver(t);
        mail_delivered();
    }
    /// Tiles in the order of their nodes, slots without gaps, when new or empty tiles have become many.
    template <class Lattice, class Execution = serial> void tidy(const Lattice& lattice, const Execution& run = {}) {
        std::size_t empty = 0;
        if (std::exchange(emptied_, false))
            for (const tile& t : tiles) empty += t.count == 0 && t.letter.is_none() ? 1 : 0;
        if (empty > tiles.size() / 4 + 1 || tiles.size() > sorted_ + sorted_ / 8 + 16) sort(lattice, 2, run);
    }
    /// ... at once, with so many spare slots for each tile, or half as many as it has, whichever is more: tiles that
    /// need more room go where the processor does not guess them. 0: none. Letters go on waiting, and find room.
    template <class Lattice, class Execution = serial>
    TAMIS_NOINLINE void sort(const Lattice& lattice, std::uint32_t spare, const Execution& run = {}) {
        const auto room_of = [&](const tile& t) {
            const std::uint32_t wanted = slots_with_letters(t);
            return spare == 0 ? wanted : even(wanted + std::max(spare, wanted / 2));
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
        std::vector<slot, aligned_allocator<slot>> new_slots;
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
    /// Share of the lanes in use that hold a particle.
    double occupancy() const {
        std::size_t lanes_in_use = 0;
        for (const tile& t : tiles) lanes_in_use += static_cast<std::size_t>(t.count) * static_cast<std::size_t>(W);
        return lanes_in_use == 0 ? 1.0 : static_cast<double>(count_) / static_cast<double>(lanes_in_use);
    }

    /// Brings the slabs up to date, for functions that reach N nodes along an axis.
    template <int N> void arrange() {
        slabs_.arrange(tiles, static_cast<std::size_t>(D - 1), D == 1 ? (N - 2) / W + 1 : N - 1);
        for (auto* one : {&mail_, &written_}) one->have_boxes(slabs());
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
        fetch<false>(s, static_cast<std::size_t>(count * W) * sizeof(real), part, parts);
    }
    /// ... or for all of it, to be written.
    TAMIS_INLINE void fetch_to_write(const slot* s) const { fetch<true>(s, sizeof(slot), 0, 1); }
    /// Runs f(tile index, first slot of the tile that comes `Ahead` tiles later) over the tiles of slab k, in the order
    /// of their nodes.
    template <int Ahead, class F> TAMIS_INLINE void each_tile_and_soon(std::size_t k, F&& f) const {
        const auto all = row(k);
        const std::size_t last = all.size() - 1;
        for (std::size_t j = 0; j < all.size(); ++j)
            f(all[j], slots.data() + tiles[all[std::min(j + static_cast<std::size_t>(Ahead), last)]].first);
    }

  private:
    mail_type mail_, written_;  // to be delivered, and not sorted yet; an outbox for each slab
    std::vector<std::uint32_t> got_letters_;
    bool emptied_ = false;
    slab_order slabs_;
    zeros<int> tile_of_block_;  // from 1; 0: none
    std::size_t count_ = 0, sorted_ = 0;
    std::vector<std::vector<std::uint32_t>> left_;  // by the number of slots: first ones of room that tiles left

    /// Lines asked for to be written are taken from other processors and may count as changed, so that they go back to
    /// memory: what is only read is not asked for in that way.
    template <bool Writes> TAMIS_INLINE static void fetch([[maybe_unused]] const slot* s,
                                                          [[maybe_unused]] std::size_t bytes, [[maybe_unused]] int part,
                                                          [[maybe_unused]] int parts) {
#if defined(__GNUC__)
        constexpr std::size_t line = 64;
        const char* const first = reinterpret_cast<const char*>(s);
        const int lines = static_cast<int>((bytes + line - 1) / line);
        for (int l = part; l < lines; l += parts)
            __builtin_prefetch(first + static_cast<std::size_t>(l) * line, Writes);
        // Slots that begin in the middle of a line end in one more.
        if constexpr (sizeof(slot) % line != 0)
            if (part == 0) __builtin_prefetch(first + bytes - 1, Writes);
#endif
    }
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
    template <class Lattice, class Left, class Execution>
    std::size_t hand_out(const Lattice& lattice, Left&& left, const Execution& run) {
        got_letters_.clear();
        const std::size_t handed = mail_.each_new([&](const letter_place& k) {
            auto& to = mail_.address_of(k);
            if (to.tile == 0) {
                auto& letter = mail_.at(k);
                if (letter.cell[0] == outside && !left(letter)) {
                    --count_;
                    return false;
                }
                to.tile = tile_at(lattice, letter.cell) + 1;
                to.lane = static_cast<std::uint32_t>(letter.cell[0] % W);
            }
            const auto index = static_cast<std::uint32_t>(to.tile - 1);
            tile& t = tiles[index];
            if (t.letter.is_none()) got_letters_.push_back(index);
            to.next = std::exchange(t.letter, k);
            ++t.letters;
            return true;
        });
        make_rooms_for_letters(lattice, run);
        if (!mail_.waits()) mail_.clear();  // all were removed
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
    /// Few sizes, so that room that a tile left serves another.
    static std::uint32_t even(std::uint32_t room) { return room + room % 2; }
    /// Tiles are in the order of their nodes.
    void renew_order() {
        sorted_ = tiles.size();
        slabs_.start_anew();
        layout.renew();
        ground.renew();
    }
    template <class Lattice> int tile_at(const Lattice& lattice, const std::array<int, 3>& cell) {
        const std::array<int, 3> at{cell[0] / W, cell[1], cell[2]};
        int& t = tile_of_block_[lattice.block_place(at)];
        if (t == 0) {
            tiles.push_back({at, lattice.first_node(at), static_cast<std::uint32_t>(slots.size()), 0, 0});
            t = static_cast<int>(tiles.size());
            slabs_.list_grew();
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
    /// Slots that a tile will need once its letters are in.
    std::uint32_t slots_with_letters(const tile& t) const {
        std::array<std::uint32_t, static_cast<std::size_t>(W)> in{};
        for (int l = 0; l < W; ++l) in[static_cast<std::size_t>(l)] = in_lane(t, l);
        for (letter_place k = t.letter; !k.is_none(); k = mail_.address_of(k).next) ++in[mail_.address_of(k).lane];
        return std::max(t.count, *std::max_element(in.begin(), in.end()));
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
