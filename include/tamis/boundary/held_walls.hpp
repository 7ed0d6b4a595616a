#pragma once
#include <tamis/boundary/held_entry.hpp>
#include <tamis/core/config.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/stamp.hpp>
#include <tamis/engine/tile.hpp>
#include <tamis/grid/lattice.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tamis::detail {

/// Walls: faces between nodes that are all held along the axis across the face. Particles do not pass them, however
/// they are updated: one that would stops there and takes the wall's velocity, and what that takes is counted in the
/// nodes' reactions. A wall that moves the way a particle goes does not stop it.
template <class S, class Shape, class Entries> class held_walls {
  public:
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    using entry = typename Entries::entry;
    using vector = point<S::dim, real>;
    static constexpr int D = S::dim, W = S::width;
    static constexpr double shift = Shape::shift;

    /// Force on a held node (N).
    struct push {
        std::size_t entry;
        vector force;
    };

    held_walls(const Entries& entries, const lattice_type& lattice) : entries_(entries) {
        if constexpr (Entries::any) mark(lattice);
    }
    /// Another one for other walls.
    std::uint64_t number() const { return id_.number(); }
    bool near(const lattice_type& lattice, const tile& t) const {
        return near_.size() > 0 && near_[lattice.block_place(t.at)] != 0;
    }
    /// Is the way of a particle across a wall? Places are told relative to a cell, in cells. It then ends this side of
    /// the wall, with the wall's velocity across it.
    bool stop(const lattice_type& lattice, const std::array<int, 3>& cell, const vector& from, vector& to,
              vector& velocity, const real& mass, const real& inverse_dt, std::vector<push>& pushes) const {
        bool any = false;
        for (int axis = 0; axis < D; ++axis) {
            const real way = to[axis] - from[axis];
            // A way that is not a number is not found here.
            if (!(way - way == real(0)) || way == real(0)) continue;
            const bool up = way > real(0);
            // Nodes of the axis between both ends, counted from the cell's origin, which `shift` puts between nodes.
            const int origin = cell[at(axis)], last = lattice.grid().cells(axis);
            const real offset = constant<real>(Shape::shift);
            const auto below = [&](const real& place) {  // the last node that is not above a place
                const real most(1 << 24);
                return lane<real>::floor(std::min<real>(std::max<real>(place - offset, -most), most)) + origin;
            };
            const auto above = [&](const real& place) {
                const int n = below(place);
                return n + (place - offset > real(n - origin) ? 1 : 0);
            };
            int node = up ? std::max(above(from[axis]), 0) : std::min(below(from[axis]), last);
            const int end = up ? std::min(above(to[axis]) - 1, last) : std::max(below(to[axis]) + 1, 0);
            for (; up ? node <= end : node >= end; node += up ? 1 : -1) {
                const real plane = real(node - origin) + offset;
                const face wall = face_at(lattice, cell, from, to, axis, node, (plane - from[axis]) / way);
                if (!wall.held || (up ? wall.speed > real(0) : wall.speed < real(0))) continue;
                // A particle on the wall itself is inside of it if the wall goes on beyond.
                if (from[axis] == plane && node != (up ? last : 0) &&
                    !face_at(lattice, cell, from, to, axis, node + (up ? 1 : -1), real(0)).held)
                    continue;
                to[axis] = plane + constant<real>(up ? -gap : gap);
                if (up ? velocity[axis] > wall.speed : velocity[axis] < wall.speed) {
                    for (int k = 0; k < wall.corners; ++k) {
                        vector force = vector::Zero();
                        force[axis] = wall.weight[at(k)] * mass * (wall.speed - velocity[axis]) * inverse_dt;
                        pushes.push_back({wall.entry[at(k)], force});
                    }
                    velocity[axis] = wall.speed;
                }
                any = true;
                break;
            }
        }
        return any;
    }
    static constexpr std::string_view no_wall =
        "no condition keeps the body from that side; enlarge the grid, hold the side, or choose leaving_clamps or "
        "leaving_removes";
    /// Why a side of the grid did not stop a particle that left it at a place, and what to do.
    std::string_view why_open(const lattice_type& lattice, const vector& where, int axis) const {
        std::array<int, 3> node{0, 0, 0};
        for (int d = 0; d < D; ++d) {
            const real place = (where[d] - lattice.grid().lower()[d]) * lattice.inverse_spacing();
            node[at(d)] = lane<real>::floor(place + constant<real>(0.5));
        }
        const entry* const e = find(lattice, node);
        if (!e) return no_wall;
        if (!holds(*e, axis))
            return "the condition there does not hold the side across; give it a normal across the side, enlarge the "
                   "grid, or choose leaving_clamps or leaving_removes";
        return "the condition there moves the side outwards, or ends there; enlarge the grid, so that there is room "
               "for the body";
    }

  private:
    static constexpr double gap = 1e-6;  // that is left between a wall and what it stopped, in cells
    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    static constexpr int most_corners = 1 << (D - 1);
    struct face {
        bool held = true;
        int corners = 0;
        std::array<std::size_t, most_corners> entry;
        std::array<real, most_corners> weight;
        real speed = real(0);
    };
    const Entries& entries_;
    stamp id_;
    zeros<char> near_;  // by blocks of cells

    /// The entry of a node; none if it is not held.
    const entry* find(const lattice_type& lattice, const std::array<int, 3>& node) const {
        const std::size_t place = lattice.node_place(node);
        const auto& all = entries_.all();
        const auto e = std::lower_bound(all.begin(), all.end(), place,
                                        [](const entry& one, std::size_t p) { return one.place < p; });
        return e == all.end() || e->place != place ? nullptr : &*e;
    }
    static bool holds(const entry& e, int axis) {
        real along(0);
        for (int k = 0; k < e.directions; ++k) along += e.normal[at(k)][axis] * e.normal[at(k)][axis];
        return along > constant<real>(1 - 1e-6);
    }
    /// The face that a way meets at a node of an axis, after a share of it.
    face face_at(const lattice_type& lattice, const std::array<int, 3>& cell, const vector& from, const vector& to,
                 int axis, int node, const real& share) const {
        face found;
        std::array<int, 3> low{0, 0, 0};
        vector beyond = vector::Zero();
        for (int d = 0; d < D; ++d) {
            const int cells = lattice.grid().cells(d);
            if (d == axis) {
                low[at(d)] = node;
                continue;
            }
            const real local = from[d] + share * (to[d] - from[d]) - constant<real>(Shape::shift);
            const real place = std::min<real>(std::max<real>(local + real(cell[at(d)]), real(0)), real(cells));
            low[at(d)] = std::min(lane<real>::floor(place), cells - 1);
            beyond[d] = place - real(low[at(d)]);
        }
        for (int corner = 0; corner < most_corners; ++corner) {
            std::array<int, 3> index = low;
            real weight(1);
            for (int d = 0, bit = 0; d < D; ++d) {
                if (d == axis) continue;
                const bool high = (corner >> bit++ & 1) != 0;
                index[at(d)] += high ? 1 : 0;
                weight *= high ? beyond[d] : real(1) - beyond[d];
            }
            if (!(weight > real(0))) continue;
            const entry* const e = find(lattice, index);
            if (!e || !holds(*e, axis)) {
                found.held = false;
                return found;
            }
            found.entry[at(found.corners)] = static_cast<std::size_t>(e - entries_.all().data());
            found.weight[at(found.corners++)] = weight;
            found.speed += weight * e->node.velocity[axis];
        }
        return found;
    }
    /// Marks the blocks of cells from which a particle may come to a wall in a step: it moves less than a cell.
    void mark(const lattice_type& lattice) {
        constexpr int before = Shape::shift > 0 ? 1 : 2;
        for (const entry& e : entries_.all()) {
            bool any = false;
            for (int d = 0; d < D; ++d) any = any || holds(e, d);
            if (!any) continue;
            if (near_.size() == 0) near_ = zeros<char>(lattice.block_count());
            std::array<int, 3> low{0, 0, 0}, high{0, 0, 0};
            for (int d = 0; d < D; ++d) {
                const int node = lattice.node_of(e.place)[at(d)];
                low[at(d)] = std::max(node - before, 0);
                high[at(d)] = std::min(node + 1, lattice.bins(d) - 1);
            }
            for (int z = low[2]; z <= high[2]; ++z)
                for (int y = low[1]; y <= high[1]; ++y)
                    for (int x = low[0] / W; x <= high[0] / W; ++x) near_[lattice.block_place({x, y, z})] = 1;
        }
    }
};

}  // namespace tamis::detail
