#pragma once
#include <tamis/core/fields.hpp>

namespace tamis {

/// The fields the library knows. Units are whatever consistent set the user works in; those of SI are given, Dim the
/// number of dimensions.
namespace field {

/// Where a particle is (m). Stored as the place inside its cell, 0 to 1 per axis.
struct position : vector_field {
    static constexpr std::string_view name = "position", particle_letter = "X";
    static constexpr std::string_view unit = "m";
};
/// Velocity of a particle or of a node (m/s).
struct velocity : vector_field {
    static constexpr std::string_view name = "velocity", letter = "v", particle_letter = "V";
    static constexpr std::string_view unit = "m/s";
};
/// Mass of a particle or of a node (kg, per unit of thickness in 1D and 2D).
struct mass : scalar_field {
    static constexpr std::string_view name = "mass", letter = "m", particle_letter = "M";
    static constexpr std::string_view unit = "kg";
};
/// A particle's volume in the reference state (m^Dim).
struct volume : scalar_field {
    static constexpr std::string_view name = "volume", particle_letter = "V0";
    static constexpr std::string_view unit = "m^Dim";
};
/// Kirchhoff stress of a particle (Pa), so that V0 tau = V sigma; in small strain the same as Cauchy's.
struct stress : symmetric_field {
    static constexpr std::string_view name = "stress", particle_letter = "tau";
    static constexpr std::string_view unit = "Pa";
};
/// Density of a particle (kg/m^Dim): rho' = rho/(1 + tr(strain increment)). Kept current where somebody asks for it.
struct density : scalar_field {
    static constexpr std::string_view name = "density";
    static constexpr std::string_view unit = "kg/m^Dim";
};
/// Internal energy of a particle per mass (J/kg).
struct internal_energy : scalar_field {
    static constexpr std::string_view name = "internal_energy";
    static constexpr std::string_view unit = "J/kg";
};
/// Pressure of a particle (Pa), for laws that follow it by its rate.
struct pressure : scalar_field {
    static constexpr std::string_view name = "pressure";
    static constexpr std::string_view unit = "Pa";
};
/// Sum of a particle's strain increments. Kept current where somebody asks for it.
struct strain : symmetric_field {
    static constexpr std::string_view name = "strain";
    static constexpr std::string_view unit = "1";
};
/// Deformation gradient of a particle. Kept current where somebody asks for it.
struct deformation : tensor_field {
    static constexpr std::string_view name = "deformation";
    static constexpr std::string_view unit = "1";
};
/// Volume of a particle over that in the reference state, J, for laws that follow it.
struct volume_ratio : scalar_field {
    static constexpr std::string_view name = "volume_ratio";
    static constexpr std::string_view unit = "1";
};
/// Elastic left Cauchy-Green tensor of a particle; `j2` keeps it without its change of volume, of determinant 1.
struct elastic_cauchy_green : symmetric_3x3_field {
    static constexpr std::string_view name = "elastic_cauchy_green";
    static constexpr std::string_view unit = "1";
};
/// Plastic strain of a particle, summed up over all it went through; it never falls.
struct plastic_strain : scalar_field {
    static constexpr std::string_view name = "plastic_strain";
    static constexpr std::string_view unit = "1";
};
/// Young's modulus of a particle (Pa), for laws that let it vary.
struct modulus : scalar_field {
    static constexpr std::string_view name = "modulus";
    static constexpr std::string_view unit = "Pa";
};
/// Number of a particle in its body, 0, 1, ... in the order in which `make_body` was given its points; it stays with
/// the particle wherever that goes.
struct id : scalar_field {
    static constexpr std::string_view name = "id";
};
/// How far a particle moves in this step (m): held back while a stress order still needs its place at the start.
struct step_displacement : vector_field {
    static constexpr std::string_view name = "step_displacement", particle_letter = "U";
    static constexpr std::string_view unit = "m";
};
/// How far a particle of `total_lagrangian` is from where it was made (m); its position is where it is now.
struct displacement : vector_field {
    static constexpr std::string_view name = "displacement", particle_letter = "u";
    static constexpr std::string_view unit = "m";
};
/// Slope of the velocity that a particle carries, C of APIC and its relatives (1/s): at x it is V + C (x - X).
struct affine_velocity : tensor_field {
    static constexpr std::string_view name = "affine_velocity", particle_letter = "C";
    static constexpr std::string_view unit = "1/s";
};

/// Error of a particle's last Lagrangian update (m/s): V_mean - V with X' = X + V_mean dt + A dt^2/2 and A = (V' -
/// V)/dt (docs/method.md, Particle updates). Kept current where somebody asks for it and particles move.
struct update_error : vector_field {
    static constexpr std::string_view name = "update_error";
    static constexpr std::string_view unit = "m/s";
};

/// 1/m of a node, 0 where there is no mass.
struct inverse_mass : scalar_field {
    static constexpr std::string_view name = "inverse_mass", letter = "1/m";
    static constexpr std::string_view unit = "1/kg";
};
/// Momentum of a node (N s).
struct momentum : vector_field {
    static constexpr std::string_view name = "momentum", letter = "p";
    static constexpr std::string_view unit = "N s";
};
/// Acceleration of a node by forces and reactions, (p+ - p)/(m dt) (m/s^2).
struct acceleration : vector_field {
    static constexpr std::string_view name = "acceleration", letter = "a";
    static constexpr std::string_view unit = "m/s^2";
};
/// Force on a node (N).
struct force : vector_field {
    static constexpr std::string_view name = "force", letter = "f";
    static constexpr std::string_view unit = "N";
};
/// Velocity of a node at the start of the step, p/m (m/s).
struct start_velocity : vector_field {
    static constexpr std::string_view name = "start_velocity", letter = "v0";
    static constexpr std::string_view unit = "m/s";
};
/// XPIC's velocity of a node, M^-1 p + a dt (m/s).
struct filtered_velocity : vector_field {
    static constexpr std::string_view name = "filtered_velocity", letter = "v_x";
    static constexpr std::string_view unit = "m/s";
};
/// Velocity that strains the particles where it is not the node's `velocity` (m/s).
struct strain_velocity : vector_field {
    static constexpr std::string_view name = "strain_velocity", letter = "v_s";
    static constexpr std::string_view unit = "m/s";
};
/// Term of the full mass matrix's series, A^l m^-1 p (m/s).
struct increment : vector_field {
    static constexpr std::string_view name = "increment", letter = "dv";
    static constexpr std::string_view unit = "m/s";
};
/// S^T M S times the increment (N s).
struct image : vector_field {
    static constexpr std::string_view name = "image", letter = "Sdv";
    static constexpr std::string_view unit = "N s";
};
/// Acceleration of a node by the full mass matrix, M~_k^-1 f (m/s^2). Made where `read_out` asks for it.
struct full_acceleration : vector_field {
    static constexpr std::string_view name = "full_acceleration", letter = "a_full";
    static constexpr std::string_view unit = "m/s^2";
};
/// sum G_pi M_p of a node (kg/m): points out of the body, down its mass's gradient.
struct mass_gradient : vector_field {
    static constexpr std::string_view name = "mass_gradient";
    static constexpr std::string_view unit = "kg/m";
};
/// sum S_pi M_p X_p of a node (kg m): m times the mean place of the particles around it.
struct mass_place : vector_field {
    static constexpr std::string_view name = "mass_place";
    static constexpr std::string_view unit = "kg m";
};

/// Momentum of a node from the particles' new velocities (N s), extrapolated again.
struct new_momentum : vector_field {
    static constexpr std::string_view name = "new_momentum", letter = "p_n";
    static constexpr std::string_view unit = "N s";
};
/// That over the node's mass (m/s): what USL+ and USAVG+ strain the particles with.
struct new_velocity : vector_field {
    static constexpr std::string_view name = "new_velocity", letter = "v_n";
    static constexpr std::string_view unit = "m/s";
};

}  // namespace field

namespace detail {

/// Do particles with these fields keep the weights of their first places, and how far they came since?
template <class List> inline constexpr bool keeps_first_place = contains<List, field::displacement>;

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
inline constexpr field::affine_velocity C;
inline constexpr field::inverse_mass im;
inline constexpr field::momentum mv;
inline constexpr field::force f;
inline constexpr field::acceleration a;
inline constexpr field::start_velocity v_start;
inline constexpr field::filtered_velocity v_filtered;
inline constexpr field::strain_velocity v_strain;
inline constexpr field::new_momentum mv_new;
inline constexpr field::new_velocity v_new;
inline constexpr field::increment dv;
inline constexpr field::image Sdv;

}  // namespace symbols
}  // namespace tamis
