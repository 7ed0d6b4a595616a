#pragma once
#include <tamis/core/by_lane.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/engine/near.hpp>

#include <concepts>

namespace tamis {

/// A law that asks to be called particle by particle, in plain numbers: `static constexpr bool lane_by_lane = true;`.
template <class Law>
concept LaneByLane = requires {
    requires Law::lane_by_lane;
};

/// A law written once for 3 x 3 tensors, `static constexpr bool three_by_three = true;`: it is told of grad_v as one,
/// zero out of the plane in 1D and 2D (uniaxial and plane strain), and returns the stress as one, of which
/// field::stress takes the part in the plane. What is out of the plane follows from fields of its own.
template <class Law>
concept ThreeByThree = requires {
    requires Law::three_by_three;
};

namespace detail {

/// The tensors a law is called with and returns.
template <class S, class Law> using law_tensor =
    std::conditional_t<ThreeByThree<Law>, typename S::tensor_3x3, typename S::tensor>;

/// The velocity gradient as a law is told of it.
template <class S, class Law> TAMIS_INLINE decltype(auto) told_gradient(const typename S::tensor& gradient) {
    if constexpr (!ThreeByThree<Law>)
        return (gradient);
    else {
        static_assert(!contains<on_particles_t<Law>, field::stress>,
                      "tamis: a law of 3x3 tensors cannot go on from field::stress, which lacks the part out of the "
                      "plane; keep what it needs in a symmetric_3x3_field of its own");
        auto full = isotropic<typename S::tensor_3x3>(constant<typename S::scalar>(0));
        unroll<S::dim * S::dim>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int i = k % S::dim, j = k / S::dim;
            full(i, j) = gradient(i, j);
        });
        return full;
    }
}

/// A law that knows only plain numbers: one call a particle.
template <class S, class Law, class Slot>
TAMIS_NOINLINE void stress_lane_by_lane(const Law& law, Slot& slot, std::uint32_t occupied, const frame<S>& at,
                                        const typename S::tensor& gradient, const typename S::scalar& dt) {
    using real = typename S::real;
    using one_space = space<S::dim, real>;
    using one_slot = values<one_space, typename Slot::list>;
    using T = typename S::scalar;
    constexpr int W = S::width, D = S::dim;
    const by_lane<T, D * D> gradients(gradient);
    const by_lane<T, 1> dts(dt);
    auto* lanes_of_slot = reinterpret_cast<real*>(&slot);
    const auto one = [&](int l) {
        one_slot p;
        auto* to = reinterpret_cast<real*>(&p);
        for (int c = 0; c < Slot::components; ++c) to[c] = lanes_of_slot[c * W + l];
        typename one_space::tensor g;
        for (int c = 0; c < D * D; ++c) g.data()[c] = gradients(c, l);
        decltype(auto) told = told_gradient<one_space, Law>(g);
        using row = slot_row<one_space, one_slot, on_particles_t<Law>>;
        static_assert(
            requires(row r) { law.stress(r, told, dts(0, l)); },
            "tamis: the law has no stress(p, grad_v, dt) that can be called; give it `template <class Tensor> "
            "Tensor stress(auto p, const Tensor& grad_v, auto dt) const`, which returns the new Kirchhoff stress");
        frame<one_space> one_frame{at.spacing, at.inverse_spacing, at.corner};
        one_frame.corner[0] += at.spacing * real(l);
        law_tensor<one_space, Law> tau = law.stress(row{p, one_frame}, told, dts(0, l));
        pack<one_space>(p.template get<field::stress>(), tau);
        for (int c = 0; c < Slot::components; ++c) lanes_of_slot[c * W + l] = to[c];
    };
    each_lane<T>([&](int l) { return (occupied >> l & 1u) != 0; }, one);
}

/// Strains the particles of a slot by the velocity gradient over dt: the kinematic fields somebody asked for, then the
/// law, which is told of the flow where it carries something. `change(F)` is dF/dt.
template <class S, class Law, class Slot, class... Flow>
TAMIS_INLINE void strain_slot_by(const auto& change, const Law& law, Slot& slot, std::uint32_t occupied,
                                 const frame<S>& at, const typename S::tensor& gradient, const typename S::scalar& dt,
                                 const Flow&... flow) {
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
        slot.template get<field::deformation>() = F + dt * change(F);
    }
    decltype(auto) told = told_gradient<S, Law>(gradient);
    using row = slot_row<S, Slot, on_particles_t<Law>>;
    if constexpr (sizeof...(Flow) > 0) {
        static_assert(
            requires(row r) { law.stress(r, told, dt, flow...); },
            "tamis: a law with `carries` is told of the flow past particles that are held; give it `template <class "
            "Tensor> Tensor stress(auto p, const Tensor& grad_v, auto dt, const auto& flow) const`, in lanes");
        law_tensor<S, Law> tau = law.stress(row{slot, at}, told, dt, flow...);
        pack<S>(slot.template get<field::stress>(), tau);
    } else if constexpr (!LaneByLane<Law> && requires(row r) { law.stress(r, told, dt); }) {
        law_tensor<S, Law> tau = law.stress(row{slot, at}, told, dt);
        pack<S>(slot.template get<field::stress>(), tau);
    } else
        stress_lane_by_lane<S>(law, slot, occupied, at, gradient, dt);
}

/// ... where dF/dt is that gradient times F.
template <class S, class Law, class Slot, class... Flow>
TAMIS_INLINE void strain_slot(const Law& law, Slot& slot, std::uint32_t occupied, const frame<S>& at,
                              const typename S::tensor& gradient, const typename S::scalar& dt, const Flow&... flow) {
    const auto change = [&](const auto& F) TAMIS_INLINE_LAMBDA { return (gradient * F).eval(); };
    strain_slot_by<S>(change, law, slot, occupied, at, gradient, dt, flow...);
}

}  // namespace detail
}  // namespace tamis
