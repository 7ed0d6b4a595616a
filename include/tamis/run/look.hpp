#pragma once
#include <tamis/leaving/settle.hpp>
#include <tamis/load/loading.hpp>
#include <tamis/run/checks.hpp>
#include <tamis/run/overlap.hpp>
#include <tamis/run/warnings.hpp>

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

}  // namespace tamis::detail
