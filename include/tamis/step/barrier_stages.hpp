#pragma once
#include <tamis/contact/policies.hpp>
#include <tamis/engine/node_range.hpp>
#include <tamis/load/damp_nodes.hpp>
#include <tamis/mass/assembling.hpp>
#include <tamis/step/schedule.hpp>

#include <string>

namespace tamis::detail {

// Stages that are neither the same for all nodes nor for all particles. `run(now)` does what they say with what the
// step's engine offers (step/now.hpp).

// Held nodes. They remember the momentum of the start, so that forces can carry it on, and what conditions added.

/// The momentum of the start, on held nodes.
struct held_momentum : vector_field {
    static constexpr std::string_view name = "held_momentum", letter = "p held";
};

template <class F> struct hold_stage;
/// Held components of p take their values of time t.
template <> struct hold_stage<field::momentum> {
    static constexpr over where = over::held;
    using on_particles = fields<>;
    static constexpr bool optional = true;
    using on_nodes = fields<const field::momentum, field::momentum>;
    using on_held = fields<held_momentum>;
    static void run(auto& now) {
        using C = typename std::remove_reference_t<decltype(now)>::C;
        now.each_holder([&](auto& held) { held.start_values(now.held_start); });
        now.each_held_in([share = now.update().start_share(), per_dt = now.inverse_dt](auto& held, auto& table,
                                                                                       const node_range& range) {
            if constexpr (C::moves) held.template take_masses<field::mass>(table, range);
            held.start(table, per_dt, share, range);
        });
    }
    static std::string text() { return "hold p"; }
};
/// f carries the held components of p to their values of t + dt.
template <> struct hold_stage<field::force> {
    static constexpr over where = over::held;
    using on_particles = fields<>;
    using on_nodes = fields<const field::force, field::force>;
    using on_held = fields<const held_momentum>;
    static void run(auto& now) {
        now.each_holder([&](auto& held) { held.end_values(now.held_end); });
        now.each_held_in([per_dt = now.inverse_dt](auto& held, auto& table, const node_range& range) {
            held.forces(table, per_dt, range);
        });
        now.check_held_values();
    }
    static std::string text() { return "hold f"; }
};
template <> struct hold_stage<field::new_momentum> {
    static constexpr over where = over::held;
    static constexpr bool optional = true;
    using on_particles = fields<>;
    using on_nodes = fields<const field::new_momentum, field::new_momentum>;
    static void run(auto& now) {
        now.each_holder([&](auto& held) { held.end_values(now.held_end); });
        now.each_held_in([](auto& held, auto& table, const node_range& range) {
            held.template extrapolated<field::new_momentum>(table, range);
        });
        now.check_held_values();
    }
    static std::string text() { return "hold p_n"; }
};
/// With masses that are new in every step.
template <class Stage> struct with_masses : Stage {
    using on_nodes = typename concatenate<typename Stage::on_nodes, fields<const field::mass>>::type;
};

// Bodies with velocities of their own.

template <class C, class F> struct touch_stage;
template <class C> struct touch_base {
    static constexpr over where = over::whole;
    using on_particles = fields<>;
    using mass = std::conditional_t<C::moves, field::mass, field::inverse_mass>;
};
/// Finds the nodes that bodies share, and corrects p there.
template <class C> struct touch_stage<C, field::momentum> : touch_base<C> {
    using on_nodes = fields<const typename touch_base<C>::mass, const field::momentum, field::momentum>;
    using scratch = merge<on_nodes_t<typename C::touch>>;
    static void run(auto& now) {
        now.find_contact();
        now.work.contact.template momentum<field::momentum>(
            now.tables(), constant<typename C::real>(now.update().start_share()), now.inverse_dt);
    }
    static std::string text() { return "contact of p"; }
};
template <class C> struct touch_stage<C, field::force> : touch_base<C> {
    using on_nodes = fields<const field::momentum, const field::force, field::force>;
    static void run(auto& now) { now.work.contact.forces(now.tables(), now.dt); }
    static std::string text() { return "contact of f"; }
};
template <class C> struct touch_stage<C, field::new_momentum> : touch_base<C> {
    static constexpr bool optional = true;
    using on_nodes = fields<const field::new_momentum, field::new_momentum>;
    static void run(auto& now) { now.work.contact.template momentum<field::new_momentum>(now.tables()); }
    static std::string text() { return "contact of p_n"; }
};

/// f -= alpha p, the grid damping of all loads.
template <class C> struct damp_stage {
    static constexpr over where = over::whole;
    using on_particles = fields<>;
    using mass = std::conditional_t<C::moves, field::mass, field::inverse_mass>;
    using on_nodes = fields<const mass, const field::momentum, const field::force, field::force>;
    static void run(auto& now) {
        damp<typename C::S::scalar, mass>(now.by.load, now.time, to_double(now.dt), [&](auto f) {
            for (auto& field : now.work.fields) f(field.sweeps);
        });
    }
    static std::string text() { return "f -= alpha p"; }
};

// The full mass matrix.

template <class C> struct of_mass_matrix {
    static constexpr over where = over::whole;
    using on_particles = fields<const field::mass>;
    using memory = std::conditional_t<contains<on_nodes_t<typename C::mass>, field::image>,
                                      fields<field::increment, field::image>, fields<field::increment>>;
    using scratch =
        std::conditional_t<C::assembles, merge<memory, fields<field::mass_entries<C::shape::support>>>, memory>;
};
/// The lumped velocity `From` becomes the full one in `To`. `Felt`: do particles take it, so that what conditions do to
/// it is a reaction?
template <class C, class From, class To, class Felt> struct full_velocity_stage : of_mass_matrix<C> {
    static constexpr bool optional = true;
    using on_nodes = fields<const field::inverse_mass, const From, To>;
    static void run(auto& now) {
        now.mass_operator([&](auto& op) { op.template full_velocity<From, To>(Felt::value); });
    }
    static std::string text() { return letter<To>() + " = " + letter<From>() + " by the full mass matrix"; }
};
/// The terms beyond the first of a velocity `From`, by the full mass matrix, are added to `To`.
template <class C, class From, class To> struct further_terms_stage : of_mass_matrix<C> {
    using on_nodes = fields<const field::inverse_mass, const From, const To, To>;
    static void run(auto& now) {
        now.mass_operator([&](auto& op) { op.template further_terms<From, To>(); });
    }
    static std::string text() { return letter<To>() + " += further terms of " + letter<From>(); }
};
/// The acceleration by the full mass matrix, for whoever asked to read it.
template <class C> struct full_acceleration_stage : of_mass_matrix<C> {
    using on_nodes = fields<const field::inverse_mass, const field::acceleration, field::full_acceleration>;
    static void run(auto& now) {
        now.mass_operator([&](auto& op) { op.full_acceleration(); });
    }
    static std::string text() { return "a_full = a by the full mass matrix"; }
};

}  // namespace tamis::detail
