#pragma once
#include <tamis/engine/sweeps.hpp>
#include <tamis/load/body_load.hpp>

namespace tamis::detail {

/// A number times the slope of a weight.
template <class S, class F> struct scalar_slope_term {
    typename S::scalar value;
    TAMIS_INLINE void add(auto& to, const auto& node) const {
        to.template get<F>() += value * typename S::vector(node.dw);
    }
};

/// What contact measures on nodes, mass gradient and mean place of the particles: a kernel of `sweeps`.
template <class S, class Shape, bool Gradient, bool Place> struct contact_to_nodes {
    using gathers = tamis::detail::gathers<>;
    using sums =
        typename concatenate<fields_if<Gradient, field::mass_gradient>, fields_if<Place, field::mass_place>>::type;
    using reads = fields<field::mass>;
    static constexpr bool sums_by_slopes = Gradient, sums_by_offsets = false, updates = false, moves = false;
    TAMIS_INLINE auto make(const auto& slot, const frame<S>& at, const auto&) const {
        using gradient = scalar_slope_term<S, field::mass_gradient>;
        using moment = plain_term<field::mass_place, typename S::vector>;
        const auto& mass = slot.template get<field::mass>();
        if constexpr (!Place)
            return gradient{mass};
        else {
            const typename S::vector place = places<S, Shape>(slot, at) * mass;
            if constexpr (Gradient)
                return terms<gradient, moment>{{{mass}}, {{place}}};
            else
                return moment{place};
        }
    }
    static no_look look() { return {}; }
};

}  // namespace tamis::detail
