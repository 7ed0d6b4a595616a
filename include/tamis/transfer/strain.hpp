#pragma once
#include <tamis/transfer/near.hpp>

#include <concepts>

namespace tamis {

/// A law that asks to be called particle by particle, in plain numbers: `static constexpr bool lane_by_lane = true;`.
template <class Law>
concept LaneByLane = requires {
    requires Law::lane_by_lane;
};

namespace detail {

/// A law that knows only plain numbers: one call a particle.
template <class S, class Law, class Slot>
TAMIS_NOINLINE void stress_lane_by_lane(const Law& law, Slot& slot, std::uint32_t occupied, const frame<S>& at,
                                        const typename S::tensor& gradient, const typename S::scalar& dt) {
    using real = typename S::real;
    using one_space = space<S::dim, real>;
    using one_slot = values<one_space, typename Slot::list>;
    using L = lane<typename S::scalar>;
    constexpr int W = S::width, D = S::dim;
    real gradients[D * D][W], dts[W];
    for (int c = 0; c < D * D; ++c) L::store(gradients[c], gradient.data()[c]);
    L::store(dts, dt);
    auto* lanes_of_slot = reinterpret_cast<real*>(&slot);
    for (int l = 0; l < W; ++l) {
        if (!(occupied >> l & 1u)) continue;
        one_slot p;
        auto* to = reinterpret_cast<real*>(&p);
        for (int c = 0; c < Slot::components; ++c) to[c] = lanes_of_slot[c * W + l];
        typename one_space::tensor g;
        for (int c = 0; c < D * D; ++c) g.data()[c] = gradients[c][l];
        using row = slot_row<one_space, one_slot, on_particles_t<Law>>;
        static_assert(
            requires(row r) { law.stress(r, g, dts[l]); },
            "tamis: the law has no stress(p, grad_v, dt) that can be called; give it `template <class Tensor> "
            "Tensor stress(auto p, const Tensor& grad_v, auto dt) const`, which returns the new Kirchhoff stress");
        frame<one_space> one_frame{at.spacing, at.inverse_spacing, at.corner};
        one_frame.corner[0] += at.spacing * real(l);
        const typename one_space::tensor tau = law.stress(row{p, one_frame}, g, dts[l]);
        pack<one_space>(p.template get<field::stress>(), tau);
        for (int c = 0; c < Slot::components; ++c) lanes_of_slot[c * W + l] = to[c];
    }
}

/// Strains the particles of a slot by the velocity gradient over dt: the kinematic fields somebody asked for, then the
/// law, which is told of the flow where it carries something.
template <class S, class Law, class Slot, class... Flow>
TAMIS_INLINE void strain_slot(const Law& law, Slot& slot, std::uint32_t occupied, const frame<S>& at,
                              const typename S::tensor& gradient, const typename S::scalar& dt, const Flow&... flow) {
    using T = typename S::scalar;
    using tensor = typename S::tensor;
    using list = typename Slot::list;
    if constexpr (stores<list, field::density>) slot.template get<field::density>() /= T(1) + dt * gradient.trace();
    if constexpr (stores<list, field::strain>) {
        const tensor total =
            unpack<S>(slot.template get<field::strain>()) + (gradient + gradient.transpose()) * (dt / 2);
        pack<S>(slot.template get<field::strain>(), total);
    }
    if constexpr (stores<list, field::deformation>) {
        const tensor F = slot.template get<field::deformation>();
        slot.template get<field::deformation>() = F + dt * (gradient * F);
    }
    using row = slot_row<S, Slot, on_particles_t<Law>>;
    if constexpr (sizeof...(Flow) > 0) {
        static_assert(
            requires(row r) { law.stress(r, gradient, dt, flow...); },
            "tamis: a law with `carries` is told of the flow past particles that are held; give it `template <class "
            "Tensor> Tensor stress(auto p, const Tensor& grad_v, auto dt, const auto& flow) const`, in lanes");
        const tensor tau = law.stress(row{slot, at}, gradient, dt, flow...);
        pack<S>(slot.template get<field::stress>(), tau);
    } else if constexpr (!LaneByLane<Law> && requires(row r) { law.stress(r, gradient, dt); }) {
        const tensor tau = law.stress(row{slot, at}, gradient, dt);
        pack<S>(slot.template get<field::stress>(), tau);
    } else
        stress_lane_by_lane<S>(law, slot, occupied, at, gradient, dt);
}

}  // namespace detail
}  // namespace tamis
