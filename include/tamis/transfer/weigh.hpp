#pragma once
#include <tamis/particles/tile.hpp>
#include <tamis/transfer/near.hpp>

namespace tamis::detail {

/// Weights of the particles of one tile: made from their places, or recalled where they are held.
template <class S, class Shape, bool Moves> struct tile_weights {
    /// Fields of a particle that its weights are made from.
    using reads =
        std::conditional_t<Moves, merge<fields<field::position>, on_particles_t<Shape>>, fields<held_weights<Shape>>>;
    const Shape& functions;
    typename S::scalar inverse_spacing;
    frame<S> at;
    bool at_wall;
    wall_lanes<S> walls;

    tile_weights(const Shape& the_functions, const lattice<S, Shape>& lattice, const tile& t)
        : functions(the_functions),
          inverse_spacing(lattice.inverse_spacing()),
          at(lattice.frame_of(t.at)),
          at_wall(Moves && lattice.at_wall(t.at)) {
        if (at_wall) walls = lattice.walls_of(t.at);
    }
    template <bool Slopes, class Slot>
    TAMIS_INLINE void operator()(stencil<S, Shape::support, Slopes>& st, const Slot& slot) const {
        if constexpr (Moves) {
            if constexpr (reads_particles<Shape>)
                st.set(functions, slot.template get<field::position>(), inverse_spacing,
                       slot_row<S, const Slot, on_particles_t<Shape>>{slot, at});
            else
                st.set(functions, slot.template get<field::position>(), inverse_spacing);
            if constexpr (ghosts < Shape >> 0)
                if (at_wall) st.fold(walls);
        } else
            held_weights<Shape>::template recall<S>(st, slot.template get<held_weights<Shape>>(), inverse_spacing);
    }
    /// Has one of the slot's particles left its cell, or the grid? True also for a place that is not a number.
    template <class Slot> TAMIS_INLINE bool may_have_left(const Slot& slot) const {
        return lane<typename S::scalar>::any(!stays(slot));
    }
    /// Which particles of the slot are still in their cell.
    template <class Slot> TAMIS_INLINE auto stays(const Slot& slot) const {
        using T = typename S::scalar;
        using real = typename S::real;
        const auto& r = slot.template get<field::position>();
        const T zero(real(0)), one(real(1));
        auto stay = both(r[0] >= zero, r[0] < one);
        unroll<S::dim - 1>([&](auto d)
                               TAMIS_INLINE_LAMBDA { stay = both(stay, both(r[d + 1] >= zero, r[d + 1] < one)); });
        if constexpr (Shape::shift > 0)
            if (at_wall)
                unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
                    const T shift = constant<T>(Shape::shift);
                    stay = both(stay, both(r[d] >= walls.low[d] * shift, r[d] <= one - walls.high[d] * (one - shift)));
                });
        return stay;
    }

  private:
    static bool both(bool a, bool b) { return a && b; }
    template <class Mask> TAMIS_INLINE static Mask both(const Mask& a, const Mask& b) { return a & b; }
};

}  // namespace tamis::detail
