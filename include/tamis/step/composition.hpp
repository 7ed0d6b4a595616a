#pragma once
#include <tamis/boundary/held_nodes.hpp>
#include <tamis/contact/policies.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/grid/uniform_grid.hpp>
#include <tamis/load/loads.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/held_weights.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/leaving/leaving.hpp>
#include <tamis/motion/motion.hpp>
#include <tamis/order/order.hpp>
#include <tamis/step/checked.hpp>
#include <tamis/step/read_out.hpp>
#include <tamis/mass/assembling.hpp>
#include <tamis/update/carried.hpp>
#include <tamis/update/schemes.hpp>

#include <array>
#include <cstddef>
#include <tuple>

namespace tamis::detail {

enum class role {
    shape,
    transfer,
    stress_order,
    boundary,
    boundary_method,
    contact,
    load,
    motion,
    execution,
    lanes,
    leaving,
    read_out,
    checks,
    none
};

template <class P>
concept TransferScheme = requires(const P& p) {
    typename P::mass_type;
    typename P::update_type;
    p.mass;
    p.particle;
};
template <class P>
concept BoundaryMethod = requires {
    { P::how } -> std::convertible_to<held_by>;
};
template <class P>
concept ContactPolicy = requires {
    typename P::law_type;
    typename P::method_type;
};
template <class P>
concept Motion = requires {
    { P::moves } -> std::convertible_to<bool>;
};
template <class P>
concept Lanes = requires {
    typename P::template type<double>;
};
template <class P>
concept Leaving = requires {
    { P::when_leaving } -> std::convertible_to<leaving_stops::choice>;
};

/// What a transfer's particles carry to the nodes.
template <class Transfer> struct carried_by { using type = carries_velocity; };
template <class Transfer>
requires requires { typename Transfer::carries_type; }
struct carried_by<Transfer> {
    using type = typename Transfer::carries_type;
};

/// Does contact act before the mass matrix does?
template <class Touch> inline constexpr bool contact_acts_early = true;
template <ContactPolicy Touch> inline constexpr bool contact_acts_early<Touch> = Touch::method_type::on_momentum;

/// Does contact ask its law about the sum of the mass matrix's series?
template <class Touch> inline constexpr bool decides_by_sum = false;
template <ContactPolicy Touch> inline constexpr bool decides_by_sum<Touch> =
    Touch::method_type::terms == contact_terms::net;

/// What a policy is for, told from its members.
template <class P, class Point> consteval role role_of() {
    if constexpr (ShapeFunction<P>)
        return role::shape;
    else if constexpr (TransferScheme<P>)
        return role::transfer;
    else if constexpr (StressOrder<P>)
        return role::stress_order;
    else if constexpr (is_conditions<P> || BoundaryCondition<P, Point>)
        return role::boundary;
    else if constexpr (BoundaryMethod<P>)
        return role::boundary_method;
    else if constexpr (ContactPolicy<P> || std::same_as<P, one_velocity>)
        return role::contact;
    else if constexpr (is_loads<P> || SingleLoad<P, Point>)
        return role::load;
    else if constexpr (Motion<P>)
        return role::motion;
    else if constexpr (ExecutionPolicy<P>)
        return role::execution;
    else if constexpr (Lanes<P>)
        return role::lanes;
    else if constexpr (Leaving<P>)
        return role::leaving;
    else if constexpr (requires { typename P::read_from_nodes; })
        return role::read_out;
    else if constexpr (requires { P::checks_steps; })
        return role::checks;
    else
        return role::none;
}

template <class P, class Point> inline constexpr role role_v = role_of<P, Point>();

/// Where the policy of a role stands in a list of roles; -1 if there is none.
template <std::size_t Count> consteval int place_of(const std::array<role, Count>& roles, role wanted) {
    for (std::size_t k = 0; k < Count; ++k)
        if (roles[k] == wanted) return static_cast<int>(k);
    return -1;
}
template <std::size_t Count> consteval bool each_role_once(const std::array<role, Count>& roles) {
    for (std::size_t k = 0; k < Count; ++k)
        for (std::size_t j = 0; j < k; ++j)
            if (roles[j] == roles[k]) return false;
    return true;
}
/// The policy at a place of those given, or the default if that is -1.
template <int Place, class Default, class... P> struct pick {
    using type = std::tuple_element_t<static_cast<std::size_t>(Place), std::tuple<P...>>;
    static const type& of(const std::tuple<const P&...>& all) { return std::get<static_cast<std::size_t>(Place)>(all); }
};
template <class Default, class... P> struct pick<-1, Default, P...> {
    using type = Default;
    static Default of(const std::tuple<const P&...>&) { return Default{}; }
};

template <class P, class Point> struct is_policy {
    static_assert(
        role_v<P, Point> != role::none,
        "tamis: an argument of solver{...} is no policy: it has the members of none of shape, transfer, stress "
        "order, boundary condition, boundary method, contact, load, motion, execution, lanes, leaving, read-out, "
        "checks; "
        "compare it with "
        "docs/concepts.md");
    static constexpr bool value = role_v<P, Point> != role::none;
};

/// The policies of a solver by role, and the fields their union asks for.
template <class Grid, class... P> struct composition {
    static constexpr int dim = Grid::dim;
    using grid_type = Grid;
    using real = typename Grid::real;
    using point_type = point<dim, real>;
    static_assert((is_policy<P, point_type>::value && ...));

    static constexpr std::array<role, sizeof...(P)> roles{role_v<P, point_type>...};
    static_assert(each_role_once(roles),
                  "tamis: two policies of one role were given to solver{...}; keep one of them (several "
                  "boundary conditions go into conditions{...}, several loads into loads{...})");
    template <role R, class Default> using by_role = pick<place_of(roles, R), Default, P...>;
    using shape = typename by_role<role::shape, quadratic_spline>::type;
    using transfer = typename by_role<role::transfer, flip>::type;
    using boundary = typename by_role<role::boundary, unbounded>::type;
    using named_method = typename by_role<role::boundary_method, boundary_method::incremental>::type;
    using touch = typename by_role<role::contact, one_velocity>::type;
    using load = typename by_role<role::load, unloaded>::type;
    using motion = typename by_role<role::motion, moving>::type;
    /// Functions that change when particles are strained go with one order only.
    using usual_order = std::conditional_t<motion::moves && reads_particles<shape>, usl_minus, usl_plus>;
    using order = typename by_role<role::stress_order, usual_order>::type;
    using execution = typename by_role<role::execution, serial>::type;
    using read = typename by_role<role::read_out, read_out<>>::type::read_from_nodes;
    using lane_policy = typename by_role<role::lanes, native_lanes>::type;
    using leaving = typename by_role<role::leaving, leaving_stops>::type;
    /// Is every step looked at for numbers that are none?
    static constexpr bool checks = by_role<role::checks, checked>::type::checks_steps;

    using S = space<dim, typename lane_policy::template type<real>>;
    using mass = typename transfer::mass_type;
    using update = typename transfer::update_type;
    using carried = typename carried_by<transfer>::type;
    static_assert(
        MassPolicy<mass>,
        "tamis: the mass policy of a transfer does not say whether it is full; give it `static constexpr bool "
        "full`, and compare it with docs/concepts/transfer.md");
    static_assert(
        ParticleUpdate<update>,
        "tamis: the particle update of a transfer lacks `using on_nodes = fields<...>` or `start_share()`; compare "
        "it with docs/concepts/transfer.md");

    static_assert(mass::full || is_always<named_method, held_by::increments>(),
                  "tamis: boundary methods differ only for a full mass matrix; give fmpm<k> with k > 1 (or "
                  "fmpm<dynamic>), or leave the method out");
    static constexpr bool exact = requires { requires mass::exact; };
    static_assert(!exact || is_always<named_method, held_by::increments>(),
                  "tamis: with an exact mass matrix conditions hold exactly; leave the boundary method out");
    /// An exact inverse has no increments: conditions are met by a solve for all of them.
    using method = std::conditional_t<exact, boundary_method::collected, named_method>;
    static constexpr bool incremental = is_always<method, held_by::increments>();

    static_assert(mass::full || !contains<read, field::full_acceleration>,
                  "tamis: field::full_acceleration needs a full mass matrix; give fmpm<k> with k > 1");
    static_assert(incremental || !contains<read, field::full_acceleration>,
                  "tamis: field::full_acceleration knows of conditions by increments only; leave out the boundary "
                  "method, and take fmpm<k> instead of an exact mass matrix");

    /// Has each body a velocity field of its own?
    static constexpr bool own_velocities = !requires { requires touch::never; };
    static_assert(
        mass::full || contact_acts_early<touch>,
        "tamis: contact_method::velocity corrects what the full mass matrix gave; give fmpm<k> with k > 1, or "
        "contact_method::incremental");
    static_assert(!own_velocities || incremental,
                  "tamis: contact goes with boundary_method::incremental only, and with no exact mass matrix");

    static_assert(!decides_by_sum<touch> || !contains<read, field::full_acceleration>,
                  "tamis: contact_method::net decides by the sum of a series, which field::full_acceleration has not; "
                  "give contact_method::incremental");

    static constexpr bool moves = motion::moves;
    static constexpr bool total = is_total_lagrangian<motion>;
    static_assert(!total || !own_velocities,
                  "tamis: total_lagrangian knows particles by their first places, where bodies that meet later do not "
                  "touch; give moving{} with a contact, or leave the contact out");
    /// Are weights made from places that particles store? Those of total_lagrangian stay, but three numbers and a few
    /// products are quicker than the memory of all weights.
    static constexpr bool places = moves || (total && !reads_particles<shape>);
    static constexpr bool assembles = may_assemble<dim, shape, mass, moves>;
    using kinds = load_kinds<load, point_type>;
    static constexpr bool loaded = kinds::on_particles || kinds::on_nodes;
    static constexpr bool remaps = order::remap && order::after > 0;
    static_assert(!moves || !reads_particles<shape> || (order::before == 0 && !remaps),
                  "tamis: this shape's functions change when particles are strained, and must be the same throughout a "
                  "step; give usl_minus{}, which strains them last");
    /// Are particles updated and the next step's sums over them made in one pass? Where rows are one, sums are few and
    /// nothing but the particles gives to them.
    static constexpr bool sums_ahead = dim == 1 && S::width > 1 && S::width >= shape::support - 1 && !mass::full &&
                                       order::before == 0 && !remaps && !own_velocities && !loaded && !total &&
                                       !(moves && reads_particles<shape>);
    /// What the step itself needs of a particle.
    using step_fields =
        merge<std::conditional_t<places, fields<field::position>, fields<held_weights<shape>>>,
              std::conditional_t<moves, on_particles_t<shape>, fields<>>, on_particles_t<motion>,
              fields<field::mass, field::velocity, field::volume, field::stress>, on_particles_t<mass>,
              on_particles_t<update>, merge<typename carried::on_particles>, typename kinds::particle_fields,
              std::conditional_t<moves && remaps, fields<field::step_displacement>, fields<>>>;
};

}  // namespace tamis::detail
