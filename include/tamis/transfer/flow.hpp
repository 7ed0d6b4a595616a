#pragma once
#include <tamis/particles/carried.hpp>
#include <tamis/transfer/gather.hpp>

namespace tamis::detail {

/// What a law with `carries` is told of the flow at W particles: `stress(p, grad_v, dt, flow)`.
template <class S> struct flow {
    typename S::vector velocity;  // S v, of the velocity that strains the particles (m/s)
    typename S::vector slope;     // of the field that the law carries, per m
    typename S::scalar flux;      // sum of G_pi . v_i c_i: divergence of velocity times that field
};

/// c V0 and V0 to nodes, c the field that the law carries.
template <class Carried> struct carried_to_nodes {
    using reads = fields<field::volume, Carried>;
    static constexpr bool uses_slopes = false;
    template <class Slot> TAMIS_INLINE auto make(const Slot& slot, const auto&) const {
        const auto& volume = slot.template get<field::volume>();
        return std::array{volume, volume * slot.template get<Carried>()};
    }
    TAMIS_INLINE void operator()(auto, auto near, const auto& of) const {
        for (const auto& [i, w, dw] : near) {
            i[carried_volume{}] += w * of[0];
            i[carried{}] += w * of[1];
        }
    }
};

/// Looks at nothing: what laws without `carries` are told.
struct no_flow {};

/// Makes the flow at W particles from the nodes' velocities in `Velocity` and the table of what is carried.
template <class S, class Shape, class Velocity> struct look_at_flow {
    using carried_around = nodes_around<S, Shape, fields<carried, carried_flow>>;
    const typename carried_nodes<S, true>::table_type& table;

    /// What is carried on the nodes around a tile.
    TAMIS_INLINE carried_around around(const lattice<S, Shape>& lattice, std::size_t first) const {
        return {lattice, table, first};
    }
    template <class Around> TAMIS_INLINE flow<S> operator()(const Around& nodes, const carried_around& own,
                                                            const stencil<S, Shape::support>& st) const {
        gathered<S, fields<Velocity>, 0> velocity;
        gather<no_field>(nodes, st, velocity);
        gathered<S, fields<>> slope;
        gather<carried>(own, st, slope);
        gathered<S, fields<>> flux;
        gather<carried_flow>(own, st, flux);
        return {velocity.sums.template get<Velocity>(), slope.gradient.row(0).transpose(), flux.gradient.trace()};
    }
};

}  // namespace tamis::detail
