#pragma once
#include <tamis/engine/terms.hpp>
#include <tamis/update/schemes.hpp>

#include <string_view>

namespace tamis {

/// Particles carry the slope C of their velocity: at x it is V + C (x - X).
struct carries_affine_velocity {
    using on_particles = fields<const field::mass, const field::velocity, const field::affine_velocity>;
    static constexpr std::string_view text = "S^T M (V + C (x - X))";
    /// Weights times offsets are used.
    static constexpr bool by_offsets = true;
    /// What a particle gives to the sum F of nodes.
    template <class F, class S> TAMIS_INLINE static auto momentum(const auto& slot) {
        using vector = typename S::vector;
        using tensor = typename S::tensor;
        const auto& M = slot.template get<field::mass>();
        using namespace detail;
        return terms<plain_term<F, vector>, offset_term<F, tensor>>{
            {{M * slot.template get<field::velocity>()}}, {{M * slot.template get<field::affine_velocity>()}}};
    }
};

/// APIC: V' = S v+, X' = X + S v+ dt, C' = B D^-1, B = sum w v+ (x) (x_i - X), D = sum w (x_i - X)^2 along each axis
/// (Jiang, Schroeder & Teran 2017). With linear functions that is the gradient, which does not divide by D, singular at
/// nodes.
struct set_velocity_and_moment : set_velocity {
    static constexpr std::string_view text = "V = S v; U = S v dt; C = [sum w v (x) (x_i - X)] D^-1";
    static constexpr bool carries_slope = true;
    using slopes_by_moment = fields<field::velocity>;
    auto affine_velocity(auto near) const { return near.slope_by_moment(symbols::v); }
};
/// TPIC: as APIC, but C' = grad v+ (Nakamura, Matsumura & Mizutani 2023).
struct set_velocity_and_gradient : set_velocity {
    static constexpr std::string_view text = "V = S v; U = S v dt; C = grad v";
    static constexpr bool carries_slope = true;
    using gradients = fields<field::velocity>;
    auto affine_velocity(auto near) const { return near.gradient(symbols::v); }
};
/// FLIP whose particles spread their velocity with its slope: V' = V + a dt, X' = X + S v+ dt, C' as APIC (Fei, Guo,
/// Wu, Huang & Gao 2021).
struct add_acceleration_and_moment : add_acceleration {
    static constexpr std::string_view text = "V += S a dt; U = S v dt; C = [sum w v (x) (x_i - X)] D^-1";
    static constexpr bool carries_slope = true;
    using slopes_by_moment = fields<field::velocity>;
    auto affine_velocity(auto near) const { return near.slope_by_moment(symbols::v); }
};

/// Affine particle-in-cell: as PIC, but particles keep how their velocity turns and shears, and with it angular
/// momentum: sum M (X x V) and the moments of C (docs/method.md, Affine transfers).
struct apic : transfer<lumped_mass, set_velocity_and_moment> {
    static constexpr std::string_view name = "apic";
    using carries_type = carries_affine_velocity;
};
/// The same with the gradient in place of the moment: cheaper, keeps angular momentum nearly.
struct tpic : transfer<lumped_mass, set_velocity_and_gradient> {
    static constexpr std::string_view name = "tpic";
    using carries_type = carries_affine_velocity;
};
/// FLIP with affine spreading: keeps FLIP's energy and APIC's turning. For solids that turn.
struct affine_flip : transfer<lumped_mass, add_acceleration_and_moment> {
    static constexpr std::string_view name = "affine_flip";
    using carries_type = carries_affine_velocity;
};

}  // namespace tamis
