#pragma once
#include <tamis/core/names.hpp>

#include <string_view>

namespace tamis {

/// Particles move with the material.
struct moving {
    static constexpr std::string_view name = "moving";
    static constexpr bool moves = true;
};
/// Particles are held where they are: their weights, and the nodes' masses, are made once.
struct held {
    static constexpr std::string_view name = "held";
    static constexpr bool moves = false;
};
/// Particles move, but their weights are those of the places where they were made (total Lagrangian MPM, de Vaucorbeil,
/// Nguyen & Hutchinson 2020, Comput. Methods Appl. Mech. Eng. 360): slopes are by the reference places, forces those of
/// the first Piola-Kirchhoff stress P = tau F^-T. No particle crosses a cell, and none comes apart from its neighbours,
/// however far it is stretched. The grid only needs to hold the bodies as they are made. Conditions hold the nodes of
/// the reference, tractions are per area of the reference, and bodies that share nodes there stay bonded; those that
/// come together later do not see each other, which `integrate` refuses.
struct total_lagrangian {
    static constexpr std::string_view name = "total_lagrangian";
    static constexpr bool moves = false;
    /// What its particles keep.
    using on_particles = fields<field::deformation, field::displacement>;
};

namespace detail {

/// Do particles keep the weights of their first places while they move?
template <class Motion> inline constexpr bool is_total_lagrangian = keeps_first_place<on_particles_t<Motion>>;

}  // namespace detail
}  // namespace tamis
