#pragma once
#include <tamis/material/carried.hpp>
#include <tamis/engine/sweeps.hpp>

namespace tamis::detail {

/// What a law with `carries` is told of the flow at W particles: `stress(p, grad_v, dt, flow)`.
template <class S> struct flow {
    typename S::vector velocity;  // S v, of the velocity that strains the particles (m/s)
    typename S::vector slope;     // of the field that the law carries, per m
    typename S::scalar flux;      // sum of G_pi . v_i c_i: divergence of velocity times that field
};

/// c V0 and V0 to nodes, c the field that the law carries: a kernel of `sweeps`.
template <class S, class Carried> struct carried_to_nodes {
    using T = typename S::scalar;
    using sums = fields<carried, carried_volume>;
    using gathers = tamis::detail::gathers<>;
    using reads = fields<field::volume, Carried>;
    static constexpr bool sums_by_slopes = false, sums_by_offsets = false, updates = false, moves = false;
    TAMIS_INLINE auto make(const auto& slot, const auto&, const auto&) const {
        const T volume = slot.template get<field::volume>(), content = volume * slot.template get<Carried>();
        return terms<plain_term<carried_volume, T>, plain_term<carried, T>>{{plain<carried_volume>(volume)},
                                                                            {plain<carried>(content)}};
    }
    static no_look look() { return {}; }
};

/// Makes the flow at W particles from the nodes' velocities in `Velocity` and the table of what is carried.
template <class S, class Shape, class Velocity> struct look_at_flow {
    using carried_around = nodes_around<S, Shape, fields<carried, carried_flow>>;
    const typename carried_nodes<S, true>::table_type& table;

    /// What is carried on the nodes around a tile.
    TAMIS_INLINE carried_around around(const lattice<S, Shape>& lattice, std::size_t first) const {
        return {lattice, table, first};
    }
    template <class Around>
    TAMIS_INLINE flow<S> operator()(const Around& nodes, const carried_around& own, const auto& st) const {
        const typename S::scalar none(typename S::real(0));
        gathered<S, gathers<fields<Velocity>>> velocity;
        gather(nodes, st, none, velocity);
        gathered<S, gathers<fields<>, fields<carried>>> slope;
        gather(own, st, none, slope);
        gathered<S, gathers<fields<>, fields<carried_flow>>> flux;
        gather(own, st, none, flux);
        return {velocity.template sum<Velocity>(), slope.template gradient<carried>().row(0).transpose(),
                flux.template gradient<carried_flow>().trace()};
    }
};

/// What a law wants to know of the flow past its particles: the nodes' means of what it carries, made now; or nothing.
template <class Shape, class Velocity, class Body, class Sweeps> auto look_at_flow_past(Body& body, Sweeps& sweeps) {
    using S = typename Body::space_type;
    if constexpr (!Body::needs_flow)
        return no_look{};
    else {
        using real = typename S::real;
        auto& own = body.carried_nodes().table;
        if (!own)
            own =
                std::make_unique<typename std::remove_reference_t<decltype(own)>::element_type>(body.lattice().size());
        const auto& active = sweeps.nodes().active();
        if (own->active() != active) own->set_active(active);
        // Nodes are looked at between the passes.
        sweeps.runner().at_once([&] {
            own->template set_zero<carried, carried_volume>();
            sweeps.scatter_onto(*own, body, carried_to_nodes<S, typename Body::law_type::carries>{});
            using T = typename S::scalar;
            using L = lane<T>;
            for (const std::uint32_t block : own->active()) {
                const std::size_t place = block * static_cast<std::size_t>(S::width);
                real* const mean = own->template block<carried>(place);
                const T c = L::load(mean) * inverse_or_zero(L::load(own->template block<carried_volume>(place)));
                L::store(mean, c);
                for (int d = 0; d < S::dim; ++d)
                    L::store(own->template block<carried_flow>(place, d),
                             c * L::load(sweeps.nodes().template block<Velocity>(place, d)));
            }
        });
        return look_at_flow<S, Shape, Velocity>{*own};
    }
}

}  // namespace tamis::detail
