#pragma once
#include <tamis/mass/mass.hpp>
#include <tamis/update/update.hpp>

#include <cmath>
#include <string_view>

namespace tamis {

/// A mass policy and a particle update: how momentum becomes velocity, and how particles take it.
template <class Mass, class Update> struct transfer {
    using mass_type = Mass;
    using update_type = Update;
    /// Momentum to velocity.
    [[no_unique_address]] Mass mass{};
    /// Velocity to particles.
    [[no_unique_address]] Update particle{};
};

/// Particle-in-cell: velocities are replaced by the grid's. Damps strongly.
struct pic : transfer<lumped_mass, set_velocity> {
    static constexpr std::string_view name = "pic";
};
/// Fluid-implicit-particle: velocities take the grid's change. Keeps energy, and noise.
struct flip : transfer<lumped_mass, add_acceleration> {
    static constexpr std::string_view name = "flip";
};
/// FLIP whose positions take psi/2 of the acceleration's part back.
struct modified_flip : transfer<lumped_mass, add_acceleration_modified> {
    static constexpr std::string_view name = "modified_flip";
    /// psi: 0 is FLIP, 1 is FMPM(0). Throws `error` if it is not finite.
    explicit modified_flip(double psi) : transfer{{}, {psi}} {
        if (!std::isfinite(psi)) throw error("modified_flip: psi is not a finite number; 0 is FLIP, 1 is FMPM(0)");
    }
};

namespace detail {

inline double blend_share(double alpha) {
    if (!(alpha >= 0 && alpha <= 1))
        throw error(sentence("blend: alpha is ", alpha, "; give a share between 0 (PIC) and 1 (FLIP)"));
    return alpha;
}

}  // namespace detail

/// alpha parts of FLIP, 1 - alpha parts of PIC.
struct blend : transfer<lumped_mass, blend_velocity> {
    static constexpr std::string_view name = "blend";
    /// alpha: 0 is PIC, 1 is FLIP. Throws `error` if it is not between.
    explicit blend(double alpha) : transfer{{}, {detail::blend_share(alpha)}} {}
};
/// The same velocities, positions by X + V' dt.
struct graphics_blend : transfer<lumped_mass, blend_velocity_graphics> {
    static constexpr std::string_view name = "graphics_blend";
    /// alpha: 0 to 1. Throws `error` if it is not.
    explicit graphics_blend(double alpha) : transfer{{}, {{detail::blend_share(alpha)}}} {}
};

/// XPIC(k): PIC with the noise it cannot see filtered out, k - 1 sweeps a step.
template <int K> struct xpic : transfer<filtered_mass<K>, set_filtered_velocity> {
    static constexpr std::string_view name = "xpic";
};
/// XPIC(k) with k known at run time.
template <> struct xpic<dynamic> : transfer<filtered_mass<dynamic>, set_filtered_velocity> {
    static constexpr std::string_view name = "xpic";
    /// k terms. Throws `error` if k is below 1.
    explicit xpic(int k) : transfer{filtered_mass<dynamic>(k), {}} {}
};

/// FMPM(k): velocities by k terms of the full mass matrix's inverse, k - 1 sweeps a step. FMPM(1) has PIC's velocities.
template <int K> struct fmpm : transfer<full_mass<K>, set_velocity_move_by_mean> {
    static constexpr std::string_view name = "fmpm";
};
/// FMPM(k) with k known at run time.
template <> struct fmpm<dynamic> : transfer<full_mass<dynamic>, set_velocity_move_by_mean> {
    static constexpr std::string_view name = "fmpm";
    /// k terms. Throws `error` if k is below 1.
    explicit fmpm(int k) : transfer{full_mass<dynamic>(k), {}} {}
};

}  // namespace tamis
