#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/leaving/leaving.hpp>

#include <string>

namespace tamis::detail {

/// The step that is being done, for messages.
struct step_stamp {
    long step;
    double time, dt;
};

/// A particle left the grid, or its place is not a number. True: it has a cell again; false: it is removed. Sides that
/// `held` says are walls stop it after all. The first failure is told in `failure`.
template <class Slot, class Letter, class S, class Shape, class Held>
TAMIS_NOINLINE bool settle_leaver(Letter& letter, const lattice<S, Shape>& lattice, leaving_stops::choice what,
                                  const step_stamp& now, std::string& failure, Held& held) {
    using choice = leaving_stops::choice;
    using real = typename S::real;
    constexpr int px = Slot::template first<field::position>(), pv = Slot::template first<field::velocity>(),
                  pm = Slot::template first<field::mass>();
    const auto& grid = lattice.grid();
    point<S::dim, real> where, speed, inside, local, middle, way;
    bool finite = true, out = false;
    for (int d = 0; d < S::dim; ++d) {
        middle[d] = constant<real>(0.5);
        way[d] = letter.value[px + d];
        speed[d] = letter.value[pv + d];
        finite = finite && way[d] - way[d] == real(0);
    }
    // It went further than the engine looks when it moves particles.
    if (finite && held.stop_leaver(lattice, letter.from, middle, way, speed, letter.value[pm], real(now.dt)))
        for (int d = 0; d < S::dim; ++d) letter.value[pv + d] = speed[d];
    int side = 0;  // an axis along which it is out
    for (int d = 0; d < S::dim; ++d) {
        const real low = grid.lower()[d], high = grid.upper()[d];
        const real cell = real(letter.from[static_cast<std::size_t>(d)]) - constant<real>(Shape::shift);
        where[d] = low + grid.spacing() * (cell + way[d]);
        inside[d] = where[d] >= low ? (where[d] <= high ? where[d] : high) : low;
        if (!(inside[d] == where[d])) {
            side = d;
            out = true;
        }
    }
    if (finite && out && what == choice::remove) return false;
    lattice.locate(inside, letter.cell, local);
    for (int d = 0; d < S::dim; ++d) letter.value[px + d] = local[d];
    if ((finite && (!out || what == choice::clamp)) || !failure.empty()) return true;
    failure = sentence("particle ", letter.origin, " (place in storage), step ", now.step, ", t = ", now.time, ": ");
    const double cells = to_double(speed.norm()) * now.dt / to_double(grid.spacing());
    if (!finite)
        failure += sentence("its place is not a number (velocity ", list_of(speed),
                            "). Likely causes: a time step above the stability limit (dt = ", now.dt,
                            "), or a law, load or condition that gave one");
    else
        failure +=
            sentence("it left the grid, to (", list_of(where), ") with velocity (", list_of(speed),
                     "), through the side ", "xyz"[side], " = ", inside[side], ". Likely cause: ",
                     cells > 0.5 ? "a time step above the stability limit, for it moves more than half a cell a step"
                                 : held.why_open(lattice, inside, side));
    return true;
}

/// Hands out a step's mail: how many particles went to another cell.
template <class Store, class S, class Shape, class Execution, class Held>
std::size_t sort_mail(Store& store, const lattice<S, Shape>& lattice, leaving_stops::choice what, const step_stamp& now,
                      std::string& failure, const Execution& run, Held& held) {
    return store.sort_mail(
        lattice,
        [&](auto& letter) { return settle_leaver<typename Store::slot>(letter, lattice, what, now, failure, held); },
        run);
}

}  // namespace tamis::detail
