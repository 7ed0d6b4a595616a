#pragma once
#include <tamis/step/barrier_stages.hpp>
#include <tamis/step/composition.hpp>
#include <tamis/step/node_stages.hpp>
#include <tamis/step/particle_stages.hpp>
#include <tamis/step/strain_stage.hpp>

namespace tamis::detail {

/// A stage, or none.
template <bool Wanted, class Stage> using stage_if = std::conditional_t<Wanted, Stage, stages<>>;

// What the words of the step's text (step/text.hpp) are in a composition.

template <class C> inline constexpr bool has_conditions = !requires { requires C::boundary::never; };
template <class C> inline constexpr bool contact_on_momentum = [] {
    if constexpr (C::own_velocities)
        return C::touch::method_type::on_momentum;
    else
        return false;
}();
template <class C, class F> using hold =
    stage_if<has_conditions<C>, std::conditional_t<std::same_as<F, field::momentum> && C::moves,
                                                   with_masses<hold_stage<F>>, hold_stage<F>>>;
template <class C, class F> using touch =
    stage_if<std::same_as<F, field::momentum> ? C::own_velocities : contact_on_momentum<C>, touch_stage<C, F>>;
template <class C> using damp_nodes = stage_if<C::kinds::on_nodes, damp_stage<C>>;

/// A stage that makes what must be numbers, if the composition looks.
template <class C, class Stage> using check = std::conditional_t<C::checks, watched<Stage>, Stage>;

template <class C, class Share, class Velocity> using strain =
    stage_if<(Share::value > 0), strain_stage<Share, Velocity, typename C::motion>>;

/// Velocities that strain particles but are not taken by them.
template <class C, class From, class To> using filter =
    stage_if<C::mass::full, full_velocity_stage<C, From, To, std::false_type>>;

/// What the mass matrix makes of v, or of v0, for the particles' update.
template <class C> inline constexpr bool filters_start = requires { requires C::mass::filters_start; };
template <class C> struct solve_stages {
    using read = stage_if<contains<typename C::read, field::full_acceleration>, full_acceleration_stage<C>>;
    using type =
        stages<read, stage_if<C::mass::full, full_velocity_stage<C, field::velocity, field::velocity, std::true_type>>>;
};
template <class C>
requires filters_start<C>
struct solve_stages<C> {
    using type =
        stages<advance<field::start_velocity, field::filtered_velocity>,
               stage_if<C::mass::has_series, further_terms_stage<C, field::start_velocity, field::filtered_velocity>>>;
};
template <class C> using solve = typename solve_stages<C>::type;

template <class C> struct words {
    // Fields, as the text names them.
    using momentum = field::momentum;
    using start_velocity = field::start_velocity;
    using strain_velocity = field::strain_velocity;
    using force = field::force;
    using acceleration = field::acceleration;
    using velocity = field::velocity;
    using new_momentum = field::new_momentum;
    using new_velocity = field::new_velocity;

    /// Masses of nodes change with the particles' places. Those of held particles are made once (`prepare`).
    using masses = stage_if<C::moves, stages<p2g<field::mass>, invert<field::mass, field::inverse_mass>>>;
    using load = std::conditional_t<C::kinds::on_particles, typename C::load, unloaded>;
    using order = typename C::order;
    using before = share_before<order>;
    using after = share_after<order>;
    /// The velocity of the start that strains particles, and the one after the particles' update.
    using velocity_before = std::conditional_t<C::mass::full, strain_velocity, start_velocity>;
    using velocity_after = std::conditional_t<order::explicit_euler, velocity_before,
                                              std::conditional_t<C::remaps, new_velocity, velocity>>;
    using motion = stage_if<C::moves, stages<move, migrate>>;
};

}  // namespace tamis::detail
