#pragma once
#include <tamis/engine/tile.hpp>
#include <tamis/engine/near.hpp>
#include <tamis/shape/held_weights.hpp>

namespace tamis::detail {

/// Weights of the particles of one tile: made from the places that are stored, or recalled where they are kept.
template <class S, class Shape, bool Places> struct tile_weights {
    /// Fields of a particle that its weights are made from.
    using reads =
        std::conditional_t<Places, merge<fields<field::position>, on_particles_t<Shape>>, fields<held_weights<Shape>>>;
    const Shape& functions;
    typename S::scalar inverse_spacing;
    frame<S> at;
    bool at_wall;
    wall_lanes<S> walls;

    tile_weights(const Shape& the_functions, const lattice<S, Shape>& lattice, const tile& t)
        : functions(the_functions),
          inverse_spacing(lattice.inverse_spacing()),
          at(lattice.frame_of(t.at)),
          at_wall(Places && lattice.at_wall(t.at)) {
        if (at_wall) walls = lattice.walls_of(t.at);
    }
    template <bool Slopes, bool Offsets, class Slot>
    TAMIS_INLINE void operator()(stencil<S, Shape::support, Slopes, Offsets>& st, const Slot& slot) const {
        if constexpr (Places) {
            if constexpr (reads_particles<Shape>)
                st.set(functions, slot.template get<field::position>(), inverse_spacing,
                       slot_row<S, const Slot, on_particles_t<Shape>>{slot, at});
            else
                st.set(functions, slot.template get<field::position>(), inverse_spacing);
            if constexpr (ghosts < Shape >> 0)
                if (at_wall) st.fold(walls);
        } else
            held_weights<Shape>::template recall<S>(st, slot.template get<held_weights<Shape>>(), inverse_spacing);
        if constexpr (Offsets) st.set_offsets(typename S::scalar(at.spacing));
    }
    /// Which particles of the slot are still inside their cell, and not on one of its edges; lanes without a particle
    /// are not.
    template <class Slot> TAMIS_INLINE auto stays(const Slot& slot) const {
        using T = typename S::scalar;
        using real = typename S::real;
        const auto& r = slot.template get<field::position>();
        const T zero(real(0)), one(real(1));
        const auto within = [&](const T& place) TAMIS_INLINE_LAMBDA {
            if constexpr (Shape::support == 2)
                return place * (one - place) > T(edge_width<Shape, real>());  // the product of its weights
            else
                return both(place > zero, place < one);
        };
        auto stay = within(r[0]);
        unroll<S::dim - 1>([&](auto d) TAMIS_INLINE_LAMBDA { stay = both(stay, within(r[d + 1])); });
        if constexpr (Shape::shift > 0)
            if (at_wall)
                unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
                    const T wall = constant<T>(Shape::shift) + T(round_offs<real>(64));
                    stay = both(stay, both(r[d] > walls.low[d] * wall, r[d] < one - walls.high[d] * wall));
                });
        return stay;
    }
    /// ... with lanes without a particle, which do not leave.
    template <class Slot, class Mask> TAMIS_INLINE static Mask or_empty(const Mask& stay, const Slot& slot) {
        return either(stay, slot.template get<field::mass>() <= typename S::scalar(typename S::real(0)));
    }

  private:
    static bool both(bool a, bool b) { return a && b; }
    template <class Mask> TAMIS_INLINE static Mask both(const Mask& a, const Mask& b) { return a & b; }
    static bool either(bool a, bool b) { return a || b; }
    template <class Mask> TAMIS_INLINE static Mask either(const Mask& a, const Mask& b) { return a | b; }
};

}  // namespace tamis::detail
