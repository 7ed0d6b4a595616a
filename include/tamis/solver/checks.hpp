#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/grid/wrap.hpp>
#include <tamis/particles/body.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace tamis::detail {

inline void check_step(double dt, double time, double end) {
    if (!(dt > 0 && std::isfinite(dt)))
        throw error(sentence("step: the time step is ", dt, "; give a positive, finite number"));
    if (!(end > time && std::isfinite(end)))
        throw error(sentence("step: it would end at t = ", end, ", and the time is ", time,
                             " already; give a later, finite end, or a longer step"));
}

/// No body may be given twice.
template <std::size_t N> void check_different(const std::array<const void*, N>& places) {
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (places[i] == places[j]) throw error("step: the same body is given twice; name each body once");
}

/// Particles that a user could have changed must still make sense.
template <class Body, class Grid> void check_particles(const Body& b, const Grid& grid, long steps, double time) {
    using namespace symbols;
    using real = typename Body::real;
    const auto& other = b.lattice().grid();
    bool same = other.lower() == grid.lower() && other.upper() == grid.upper();
    for (int d = 0; d < Body::dim; ++d)
        same = same && other.cells(d) == grid.cells(d) && other.wraps(d) == grid.wraps(d);
    if (!same) throw error("step: a body was made on another grid; make it with this solver's make_body");
    long k = 0;
    for (const auto p : b) {
        const auto bad = [&](const std::string& why) {
            return error(
                sentence("particle ", k, " at (", list_of(p[x]), "), step ", steps, ", t = ", time, ": ", why));
        };
        const auto usable = [](const real& number) { return number > real(0) && number - number == real(0); };
        if (!usable(p[m])) throw bad(sentence("its mass is ", p[m], "; give a positive density"));
        if (!usable(p[V])) throw bad(sentence("its volume is ", p[V], "; give a positive, finite number"));
        for (int d = 0; d < Body::dim; ++d)
            if (p[v][d] - p[v][d] != real(0)) throw bad("its velocity is not finite; check the initial velocity");
        if constexpr (requires { b.law.check(p); }) {
            try {
                b.law.check(p);
            } catch (const error& e) {
                throw bad(e.what());
            }
        }
        ++k;
    }
}

/// Which blocks of W nodes particles reach: a mark for each block of the grid, and a list of those marked, ascending.
struct block_marks {
    zeros<char> reached;
    std::vector<std::uint32_t> blocks;
    std::size_t width = 1;
    /// Of each body: the order of its tiles that was looked at, and how many of them.
    struct part {
        std::uint64_t ground;
        std::size_t tiles;
    };
    std::vector<part> parts;

    block_marks() = default;
    block_marks(std::size_t nodes, int w)
        : reached(nodes / static_cast<std::size_t>(w) + 2), width(static_cast<std::size_t>(w)) {}
};
template <class Lattice> void mark_reached(std::span<const tile> tiles, const Lattice& lattice, block_marks& on) {
    const auto mark = [&](std::size_t block) {
        if (!std::exchange(on.reached[block], char(1))) on.blocks.push_back(static_cast<std::uint32_t>(block));
    };
    for (const tile& t : tiles)
        for (int r = 0; r < Lattice::rows; ++r) {
            const std::size_t first = (t.node + lattice.row_offset(r)) / on.width;
            for (std::size_t k = 0; k <= (on.width + Lattice::N - 2) / on.width; ++k) mark(first + k);
        }
    reach_images(
        lattice, [&](std::size_t place) { return on.reached[place / on.width] != 0; },
        [&](std::size_t place) { mark(place / on.width); });
}
/// The blocks that the tiles of some stores reach. Where tiles have only been added since they were marked, those are.
template <class Lattice, class... Store>
void mark_all(const std::tuple<const Store*...>& stores, const Lattice& lattice, block_marks& on) {
    const auto each = [&](auto f) {
        std::size_t k = 0;
        std::apply([&](const auto*... store) { (f(k++, *store), ...); }, stores);
    };
    bool grown = on.parts.size() == sizeof...(Store);
    each([&](std::size_t k, const auto& store) { grown = grown && on.parts[k].ground == store.ground.number(); });
    if (!grown) on = block_marks(lattice.size(), Lattice::W);
    on.parts.resize(sizeof...(Store), {0, 0});
    const auto known = static_cast<std::ptrdiff_t>(on.blocks.size());
    each([&](std::size_t k, const auto& store) {
        mark_reached(std::span<const tile>(store.tiles).subspan(on.parts[k].tiles), lattice, on);
        on.parts[k] = {store.ground.number(), store.tiles.size()};
    });
    std::sort(on.blocks.begin() + known, on.blocks.end());
    std::inplace_merge(on.blocks.begin(), on.blocks.begin() + known, on.blocks.end());
}

}  // namespace tamis::detail
