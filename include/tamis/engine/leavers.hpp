#pragma once
#include <tamis/core/config.hpp>
#include <tamis/engine/tile.hpp>
#include <tamis/grid/lattice.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace tamis::detail {

/// Brings a place into [0, 1) by going to a neighbouring cell; at the upper wall 1 stays. False if that is outside, or
/// if the place is not a number.
template <class Shape, class real> bool settle(real& r, int& cell, int bins) {
    if (!(r > real(-1000000) && r < real(1000000))) return false;
    int k = lane<real>::floor(r);
    real rest = r - real(k);
    if (rest >= real(1)) {
        rest = real(0);
        ++k;
    }
    if (Shape::shift == 0 && cell + k == bins && !(rest > real(0))) {
        --k;
        rest = real(1);
    }
    r = rest;
    cell += k;
    return cell >= 0 && cell < bins;
}

/// Some slots of a tile, by their numbers in it; those from the 63rd on are told together.
class some_slots {
  public:
    static some_slots all() {
        some_slots every;
        every.bits_ = ~std::uint64_t(0);
        return every;
    }
    TAMIS_INLINE void add(std::uint32_t slot) { bits_ |= std::uint64_t(1) << std::min(slot, last); }
    TAMIS_INLINE bool any() const { return bits_ != 0; }
    bool has(std::uint32_t slot) const { return bits_ >> std::min(slot, last) & 1u; }

  private:
    static constexpr std::uint32_t last = 63;
    std::uint64_t bits_ = 0;
};

/// Posts the particles of some slots of a tile that are in another cell now; are there any?
template <class S, class Shape, class Store>
TAMIS_NOINLINE bool post_leavers(Store& store, const lattice<S, Shape>& lattice, std::size_t slab, std::size_t index,
                                 const some_slots& slots) {
    using real = typename S::real;
    constexpr int D = S::dim, W = S::width;
    tile& t = store.tiles[index];
    constexpr int first = Store::slot::template first<field::position>();
    const bool at_wall = lattice.at_wall(t.at);
    bool any = false;
    // From the last one on: the particle that takes a place has been looked at.
    for (std::uint32_t k = t.count; k-- > 0;) {
        if (!slots.has(k)) continue;
        const std::uint32_t s = t.first + k;
        for (int l = 0; l < W; ++l) {
            if (!(store.occupied[s] >> l & 1u)) continue;
            real* const p = store.lane_of(s, l) + first * W;
            bool left = at_wall;
            const real near = edge_width<Shape, real>();
            for (int d = 0; d < D; ++d)
                left = left || !(p[d * W] > real(2) * near && p[d * W] < real(1) - real(2) * near);
            if (!left) continue;
            const std::array<int, 3> from{t.at[0] * W + l, t.at[1], t.at[2]};
            std::array<int, 3> cell = from;
            point<D, real> local;
            bool stays = true;
            for (int d = 0; d < D; ++d) {
                local[d] = p[d * W];
                int& c = cell[static_cast<std::size_t>(d)];
                if (const real whole = real(local[d] > constant<real>(0.5) ? 1 : 0);
                    local[d] - whole <= near && whole - local[d] <= near)
                    local[d] = whole;
                const bool in = settle<Shape>(local[d], c, lattice.bins(d));
                stays = stays && (lattice.grid().wraps(d) ? lattice.bring_back(d, c, local[d]) : in);
            }
            if (stays && lattice.inside(cell, local))
                for (int d = 0; d < D; ++d) p[d * W] = local[d];
            else
                cell[0] = Store::outside;
            const bool on_edge = cell[0] != Store::outside && lattice.on_edge(cell, local);
            if (cell == from) {
                if (on_edge) store.note_edge(slab, t);
                continue;
            }
            store.post(lattice, slab, t, s, l, from, cell, on_edge);
            any = true;
        }
    }
    store.shrink(slab, t);
    return any;
}

/// After passes that were broken off by what a law or a load threw: letters are in, empty lanes hold zeros, and
/// particles that are in another cell are posted.
template <bool Moves, class S, class Shape, class Store>
TAMIS_SELDOM void collect_strays(Store& store, const lattice<S, Shape>& lattice) {
    using real = typename S::real;
    store.deliver_all();
    for (std::size_t k = 0; k < store.slabs(); ++k)
        for (const std::uint32_t index : store.row(k)) {
            const tile& t = store.tiles[index];
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s)
                for (int l = 0; l < S::width; ++l)
                    for (int c = 0; c < Store::components && !(store.occupied[s] >> l & 1u); ++c)
                        store.lane_of(s, l)[c * S::width] = real(0);
            if constexpr (Moves) post_leavers(store, lattice, k, index, some_slots::all());
        }
}

}  // namespace tamis::detail
