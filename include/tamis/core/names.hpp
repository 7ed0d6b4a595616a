#pragma once
#include <tamis/core/fields.hpp>

namespace tamis {

/// The fields the library knows. Units are whatever consistent set the user works in; those of SI are given.
namespace field {

/// Where a particle is (m). Stored as the place inside its cell, 0 to 1 per axis.
struct position : vector_field {
    static constexpr std::string_view name = "position";
};
/// Velocity of a particle or of a node (m/s).
struct velocity : vector_field {
    static constexpr std::string_view name = "velocity";
};
/// Mass of a particle or of a node (kg, per unit of thickness in 1D and 2D).
struct mass : scalar_field {
    static constexpr std::string_view name = "mass";
};
/// A particle's volume in the reference state (m^Dim).
struct volume : scalar_field {
    static constexpr std::string_view name = "volume";
};
/// Kirchhoff stress of a particle (Pa), so that V0 tau = V sigma; in small strain the same as Cauchy's.
struct stress : symmetric_field {
    static constexpr std::string_view name = "stress";
};
/// Density of a particle (kg/m^Dim): rho' = rho/(1 + tr(strain increment)). Kept current where somebody asks for it.
struct density : scalar_field {
    static constexpr std::string_view name = "density";
};
/// Internal energy of a particle per mass (J/kg).
struct internal_energy : scalar_field {
    static constexpr std::string_view name = "internal_energy";
};
/// Pressure of a particle (Pa), for laws that follow it by its rate.
struct pressure : scalar_field {
    static constexpr std::string_view name = "pressure";
};
/// Sum of a particle's strain increments. Kept current where somebody asks for it.
struct strain : symmetric_field {
    static constexpr std::string_view name = "strain";
};
/// Deformation gradient of a particle. Kept current where somebody asks for it.
struct deformation : tensor_field {
    static constexpr std::string_view name = "deformation";
};
/// Young's modulus of a particle (Pa), for laws that let it vary.
struct modulus : scalar_field {
    static constexpr std::string_view name = "modulus";
};
/// How far a particle moves in this step (m): held back while a stress order still needs its place at the start.
struct displacement : vector_field {
    static constexpr std::string_view name = "displacement";
};

/// Error of a particle's last Lagrangian update (m/s): V_mean - V with X' = X + V_mean dt + A dt^2/2 and A = (V' -
/// V)/dt (docs/method.md, Particle updates). Kept current where somebody asks for it and particles move.
struct update_error : vector_field {
    static constexpr std::string_view name = "update_error";
};

/// 1/m of a node, 0 where there is no mass; takes the mass's column.
struct inverse_mass : scalar_field {
    using shares = mass;
    static constexpr std::string_view name = "inverse_mass";
};
/// Momentum of a node (N s); the velocity takes its column.
struct momentum : vector_field {
    using shares = velocity;
    static constexpr std::string_view name = "momentum";
};
/// Acceleration of a node by forces and reactions, (p+ - p)/(m dt) (m/s^2).
struct acceleration : vector_field {
    static constexpr std::string_view name = "acceleration";
};
/// Force on a node (N); the acceleration takes its column.
struct force : vector_field {
    using shares = acceleration;
    static constexpr std::string_view name = "force";
};
/// Velocity of a node at the start of the step, p/m (m/s).
struct start_velocity : vector_field {
    static constexpr std::string_view name = "start_velocity";
};
/// XPIC's velocity of a node, M^-1 p + a dt (m/s); takes the acceleration's column.
struct filtered_velocity : vector_field {
    using shares = acceleration;
    static constexpr std::string_view name = "filtered_velocity";
};
/// Velocity that strains the particles where it is not the node's `velocity` (m/s).
struct strain_velocity : vector_field {
    static constexpr std::string_view name = "strain_velocity";
};
/// Term of the full mass matrix's series, A^l m^-1 p (m/s).
struct increment : vector_field {
    static constexpr std::string_view name = "increment";
};
/// S^T M S times the increment (N s).
struct image : vector_field {
    static constexpr std::string_view name = "image";
};
/// Acceleration of a node by the full mass matrix, M~_k^-1 f (m/s^2). Made where `read_out` asks for it.
struct full_acceleration : vector_field {
    static constexpr std::string_view name = "full_acceleration";
};
/// sum G_pi M_p of a node (kg/m): points out of the body, down its mass's gradient.
struct mass_gradient : vector_field {
    static constexpr std::string_view name = "mass_gradient";
};
/// sum S_pi M_p X_p of a node (kg m): m times the mean place of the particles around it.
struct mass_place : vector_field {
    static constexpr std::string_view name = "mass_place";
};

/// Mass, momentum and force that a node has at the start of the next step (kg, N s, N): made in 1D while particles are
/// updated, so that they have columns of their own.
struct next_mass : scalar_field {
    static constexpr std::string_view name = "next_mass";
};
struct next_momentum : vector_field {
    static constexpr std::string_view name = "next_momentum";
};
struct next_force : vector_field {
    static constexpr std::string_view name = "next_force";
};

}  // namespace field

namespace detail {

/// Where a step's sums over particles are: in columns that the results of the step take afterwards ...
struct sums_in_place {
    using mass = field::mass;
    using momentum = field::momentum;
    using force = field::force;
};
/// ... or in columns of their own, made while the results are still read.
template <bool Mass> struct sums_ahead {
    using mass = std::conditional_t<Mass, field::next_mass, field::mass>;
    using momentum = field::next_momentum;
    using force = field::next_force;
};

}  // namespace detail

/// The papers' letters, for kernels: `i[m] += w * p[m];`.
namespace symbols {

inline constexpr field::position x;
inline constexpr field::velocity v;
inline constexpr field::mass m;
inline constexpr field::volume V;
inline constexpr field::stress sigma;
inline constexpr field::density rho;
inline constexpr field::strain epsilon;
inline constexpr field::deformation F;
inline constexpr field::modulus E;
inline constexpr field::displacement u;
inline constexpr field::inverse_mass im;
inline constexpr field::momentum mv;
inline constexpr field::force f;
inline constexpr field::acceleration a;
inline constexpr field::start_velocity v_start;
inline constexpr field::filtered_velocity v_filtered;
inline constexpr field::strain_velocity v_strain;
inline constexpr field::increment dv;
inline constexpr field::image Sdv;

}  // namespace symbols
}  // namespace tamis
