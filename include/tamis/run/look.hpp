#pragma once
#include <tamis/leaving/settle.hpp>
#include <tamis/load/loading.hpp>
#include <tamis/run/checks.hpp>
#include <tamis/run/overlap.hpp>
#include <tamis/run/warnings.hpp>
#include <tamis/step/node_stages.hpp>

#include <array>
#include <tuple>
#include <utility>

namespace tamis::detail {

/// Looks at bodies that a user may have changed. Throws `error` where they make no sense; warns of what may not be
/// meant.
template <class... Body, class Grid, class Load, class Targets>
void look_at_bodies(std::tuple<Body&...>& all, const Grid& grid, const Load& load, Targets& targets,
                    const warning_channel& channel, const step_stamp& now) {
    check_different(std::apply([](const auto&... b) { return std::array<const void*, sizeof...(Body)>{&b...}; }, all));
    [[maybe_unused]] bool any_is_new = false;
    each_of(all, [&](auto& b) {
        check_particles(std::as_const(b), grid, now.step, now.time);
        if (b.store().updates > 0) return;
        any_is_new = true;
        // Volumes may have been set since it was made.
        using at_point = point<Grid::dim, typename Grid::real>;
        if constexpr (load_kinds<Load, at_point>::by_face) take_faces(b, load);
    });
    targets.look(load, all);
    if constexpr (sizeof...(Body) > 1)
        if (any_is_new) channel.warn_if_any(warning_kind::overlap, [&] { return overlapping<Grid::dim>(all).told(); });
}

/// Throws again what broke a step off; of what is not a number it says which particle's it is.
template <class... Body>
[[noreturn]] TAMIS_SELDOM void tell_of_broken_step(const std::tuple<Body&...>& all, const step_stamp& now) {
    try {
        throw;
    } catch (const not_a_number&) {
        check_finite(all, now.step, now.time, now.dt);
        throw error(sentence("step ", now.step, ", t = ", now.time,
                             ": a node's acceleration is not a number, though velocities and stresses of all particles "
                             "are. Likely causes: a load, condition or contact law that gave one, or a number beyond "
                             "the range of its type (dt = ",
                             now.dt, ")"));
    }
}

}  // namespace tamis::detail
