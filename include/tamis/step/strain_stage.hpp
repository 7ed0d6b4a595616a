#pragma once
#include <tamis/material/flow.hpp>
#include <tamis/material/strain.hpp>
#include <tamis/motion/motion.hpp>
#include <tamis/step/particle_stages.hpp>

#include <concepts>
#include <string>

namespace tamis::detail {

/// How much of a step's strain a stress order makes before the forces, and after the particles' update.
template <class Order> struct share_before { static constexpr double value = Order::before; };
template <class Order> struct share_after { static constexpr double value = Order::after; };

/// The gradient of a velocity in space, from that along the axes of the reference.
template <class S>
TAMIS_INLINE typename S::tensor in_space(const typename S::tensor& gradient, const typename S::tensor& F) {
    const typename S::scalar inverse = inverse_or_zero(determinant(F));
    typename S::tensor L = gradient * cofactor(F).transpose();
    unroll<S::dim * S::dim>([&](auto c) TAMIS_INLINE_LAMBDA { L.data()[c] *= inverse; });
    return L;
}

/// Particles are strained by the gradient of a node velocity, over a share of dt.
template <class Share, class Velocity, class Motion> struct strain_stage : over_particles {
    static constexpr bool total = is_total_lagrangian<Motion>;
    // Nodes without mass have no part in gradients.
    static constexpr bool looks_for_mass = true;
    using on_nodes = fields<const Velocity>;
    using on_particles = typename concatenate<fields<const field::stress, field::stress>,
                                              fields_if<total, const field::deformation, field::deformation>>::type;
    template <class S, class Law, class Look> struct part
        : updates_particles<
              gathers<std::conditional_t<std::same_as<Look, no_look>, fields<>, fields<Velocity>>, fields<Velocity>>,
              fields<>> {
        const Law& law;
        typename S::scalar dt;
        [[no_unique_address]] Look look_;
        const Look& look() const { return look_; }
        TAMIS_INLINE void update(auto& p, std::uint32_t occupied, const frame<S>& at, const auto& g,
                                 const auto& flow) const {
            if constexpr (total) {
                const typename S::tensor F = p.slot.template get<field::deformation>();
                const auto& along_first = g.template gradient<Velocity>();
                const auto change = [&](const auto&) TAMIS_INLINE_LAMBDA -> const auto& { return along_first; };
                strain_slot_by<S>(change, law, p.slot, occupied, at, in_space<S>(along_first, F), dt);
            } else if constexpr (std::same_as<Look, no_look>)
                strain_slot<S>(law, p.slot, occupied, at, g.template gradient<Velocity>(), dt);
            else
                strain_slot<S>(law, p.slot, occupied, at, g.template gradient<Velocity>(), dt, flow);
        }
    };
    template <class Now, class Body> static auto bind(const Now& now, Body& body, auto& sweeps) {
        static_assert(!total || !Body::needs_flow,
                      "tamis: a law with carries_when_moving is told of the flow past its particles, which is not "
                      "made for total_lagrangian; give moving{}");
        auto look = look_at_flow_past<typename Now::C::shape, Velocity>(body, sweeps);
        using real = typename Now::real;
        return part<typename Now::S, typename Body::law_type, decltype(look)>{
            {}, body.law, typename Now::T(real(Share::value) * now.dt), look};
    }
    static std::string text() {
        const double share = Share::value;
        return "strain by " + letter<Velocity>() + (total ? " F^-1" : "") +
               (share == 1     ? " over dt"
                : share == 0.5 ? " over dt/2"
                               : " over " + sentence(share) + " dt");
    }
};

}  // namespace tamis::detail
