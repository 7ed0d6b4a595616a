#pragma once
#include <tamis/grid/lattice.hpp>
#include <tamis/particles/tile.hpp>

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

/// Posts the particles of a tile that are in another cell now.
template <class S, class Shape, class Store>
TAMIS_NOINLINE void post_leavers(Store& store, const lattice<S, Shape>& lattice, std::size_t slab, std::size_t index) {
    using real = typename S::real;
    constexpr int D = S::dim, W = S::width;
    tile& t = store.tiles[index];
    constexpr int first = Store::slot::template first<field::position>();
    for (std::uint32_t s = t.first; s < t.first + t.count; ++s)
        for (int l = 0; l < W; ++l) {
            if (!(store.occupied[s] >> l & 1u)) continue;
            real* const p = store.lane_of(s, l) + first * W;
            const std::array<int, 3> from{t.at[0] * W + l, t.at[1], t.at[2]};
            std::array<int, 3> cell = from;
            point<D, real> local;
            bool stays = true;
            for (int d = 0; d < D; ++d) {
                local[d] = p[d * W];
                int& c = cell[static_cast<std::size_t>(d)];
                const bool in = settle<Shape>(local[d], c, lattice.bins(d));
                stays = stays && (lattice.grid().wraps(d) ? lattice.bring_back(d, c, local[d]) : in);
            }
            if (stays && lattice.inside(cell, local))
                for (int d = 0; d < D; ++d) p[d * W] = local[d];
            else
                cell[0] = Store::outside;
            if (cell != from) store.post(slab, s, l, from, cell);
        }
    store.shrink(slab, t);
}

}  // namespace tamis::detail
