#pragma once
#include <tamis/core/names.hpp>
#include <tamis/load/body_load.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tamis::detail {

/// A particle of a new body: where it is, and the side of the cube of its volume.
template <int D, class real> struct surface_particle {
    point<D, real> at;
    real volume, side;
};

/// The faces at a body's surface, of cubes that its particles are. Where they lie in a lattice of equal cubes, as those
/// of `per_cell` do, a face is at the surface if there is no cube beyond it. Particles that lie otherwise are no cubes
/// that fill the body: it is then made of cells, and where there is none beyond, the cell's outermost particles share
/// the area of its face. A cell at the surface that is filled in part has that part of the area, by the cells behind
/// it: so areas add up to those of the body's sides.
template <int D, class real> class body_surface {
  public:
    using place = point<D, real>;
    using cube = std::array<int, 3>;

    /// `spacing`: of the grid, whose cells are counted from `corner`.
    TAMIS_SELDOM body_surface(std::vector<surface_particle<D, real>> particles, const place& corner,
                              const real& spacing)
        : particles_(std::move(particles)) {
        side_ = particles_.front().side;
        origin_ = particles_.front().at - place::Constant(side_ / real(2));
        sort();
        lattice_ = is_lattice();
        if (lattice_) return;
        real largest = spacing;
        for (const auto& p : particles_) largest = std::max<real>(largest, p.side);
        side_ = spacing * std::ceil(to_double(largest / spacing) * (1 - 1e-6));
        origin_ = corner;
        sort();
    }
    /// f(number of the particle, area) for those with a face at the surface along an axis, on its upper or lower side.
    template <class F> void each_face(int axis, bool upper, const F& f) const {
        real whole(1);
        for (int d = 1; d < D; ++d) whole *= side_;
        for (std::size_t first = 0, last; first < order_.size(); first = last) {
            last = end_of(first);
            const cube own = order_[first].in;
            if (is_filled(beside(own, axis, upper ? 1 : -1))) continue;
            if (lattice_)
                f(order_[first].particle, whole);
            else
                share(first, last, axis, upper, whole * filling(own, axis, upper ? -1 : 1), f);
        }
    }

  private:
    struct filed {
        cube in;
        std::size_t particle;
        bool operator<(const filed& o) const { return in != o.in ? in < o.in : particle < o.particle; }
    };
    std::vector<surface_particle<D, real>> particles_;
    place origin_;
    real side_;
    bool lattice_;
    std::vector<filed> order_;  // particles by their cubes

    static std::size_t at(int d) { return static_cast<std::size_t>(d); }
    static cube beside(cube of, int axis, int steps) {
        of[at(axis)] += steps;
        return of;
    }
    void sort() {
        order_.clear();
        for (std::size_t k = 0; k < particles_.size(); ++k) {
            cube in{0, 0, 0};
            for (int d = 0; d < D; ++d) in[at(d)] = lane<real>::floor((particles_[k].at[d] - origin_[d]) / side_);
            order_.push_back({in, k});
        }
        std::sort(order_.begin(), order_.end());
    }
    std::size_t end_of(std::size_t first) const {
        std::size_t k = first;
        while (k < order_.size() && order_[k].in == order_[first].in) ++k;
        return k;
    }
    std::size_t first_of(const cube& in) const {
        return static_cast<std::size_t>(std::lower_bound(order_.begin(), order_.end(), filed{in, 0}) - order_.begin());
    }
    bool is_filled(const cube& in) const {
        const std::size_t k = first_of(in);
        return k < order_.size() && order_[k].in == in;
    }
    bool is_lattice() const {
        const auto near = [](const real& a, double b, double most) { return std::abs(to_double(a) - b) <= most; };
        for (std::size_t k = 0; k < order_.size(); ++k) {
            if (end_of(k) != k + 1) return false;
            const auto& p = particles_[order_[k].particle];
            if (!near(p.side / side_, 1, 1e-4)) return false;
            for (int d = 0; d < D; ++d) {
                // Round-off of places grows with their distance from the origin.
                const double round_off =
                    8 * to_double(real(std::numeric_limits<real>::epsilon())) * std::abs(to_double(p.at[d] / side_));
                if (!near((p.at[d] - origin_[d]) / side_, order_[k].in[at(d)] + 0.5, 1e-3 + round_off)) return false;
            }
        }
        return true;
    }
    /// Share of a cell that its particles fill.
    real filled_part(const cube& in) const {
        real volume(0), whole(1);
        for (std::size_t k = first_of(in); k < order_.size() && order_[k].in == in; ++k)
            volume += particles_[order_[k].particle].volume;
        for (int d = 0; d < D; ++d) whole *= side_;
        return volume / whole;
    }
    /// Which part of a cell's face is the body's: as much as the cells behind it are filled, up to three; its own part
    /// where there are none.
    real filling(const cube& own, int axis, int inwards) const {
        real sum(0);
        int count = 0;
        for (; count < 3 && is_filled(beside(own, axis, (count + 1) * inwards)); ++count)
            sum += filled_part(beside(own, axis, (count + 1) * inwards));
        return count == 0 ? filled_part(own) : sum / real(count);
    }
    /// The outermost particles of a cell: those that no other one hides.
    template <class F>
    void share(std::size_t first, std::size_t last, int axis, bool upper, const real& area, const F& f) const {
        const auto particle = [&](std::size_t k) -> const auto& { return particles_[order_[k].particle]; };
        const auto hides = [&](std::size_t other, std::size_t own) {
            const auto &a = particle(other), &b = particle(own);
            const real ahead = upper ? a.at[axis] - b.at[axis] : b.at[axis] - a.at[axis];
            bool yes = ahead > real(0);
            for (int d = 0; d < D; ++d)
                yes = yes && (d == axis || std::abs(to_double(a.at[d] - b.at[d])) < 0.45 * to_double(a.side + b.side));
            return yes;
        };
        std::vector<std::size_t> outer;
        real all(0);
        const auto section = [&](std::size_t k) { return particle(k).volume / particle(k).side; };
        for (std::size_t k = first; k < last; ++k) {
            bool hidden = false;
            for (std::size_t other = first; other < last && !hidden; ++other) hidden = hides(other, k);
            if (hidden) continue;
            outer.push_back(k);
            all += section(k);
        }
        for (const std::size_t k : outer) f(order_[k].particle, area * section(k) / all);
    }
};

}  // namespace tamis::detail
