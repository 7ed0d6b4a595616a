#pragma once
#include <tamis/boundary/conditions.hpp>
#include <tamis/core/error.hpp>
#include <tamis/run/body.hpp>
#include <tamis/step/composition.hpp>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace tamis {

/// How many particles a cell gets along each axis; they are at (s + 1/2)/n of it. `per_cell{2}`: 4 a cell in 2D, 8 in
/// 3D.
struct per_cell {
    /// Along an axis.
    int count = 2;
};

/// A law with a member `density` (kg/m^Dim).
template <class L>
concept HasDensity = requires(const L& law) {
    { law.density } -> std::convertible_to<double>;
};
/// A law with `wave_speed()` or, where it depends on the dimension, `wave_speed(dim)` (m/s).
template <class L>
concept HasWaveSpeed = requires(const L& law) {
    { law.wave_speed() } -> std::convertible_to<double>;
}
|| requires(const L& law) {
    { law.wave_speed(1) } -> std::convertible_to<double>;
};
/// A law: `density` (kg/m^Dim), a wave speed, and `stress(p, grad_v, dt)`, the new Kirchhoff stress of a particle
/// strained at rate grad_v (1/s) for dt (s). `on_particles` lists the fields it reads and writes.
template <class L>
concept Law = HasDensity<L> && HasWaveSpeed<L>;

namespace detail {

template <class L> void check_law(const L& law) {
    if constexpr (requires { law.check(); }) law.check();
    if constexpr (HasDensity<L>) {
        if (!(static_cast<double>(law.density) > 0))
            throw error(sentence("make_body: the law's density is ", static_cast<double>(law.density),
                                 "; give a positive number"));
    }
}

/// Cell of the grid that a particle's point is in, and the place in it.
template <class Body> std::array<int, 3> cell_of_particle(const Body& body,
                                                          const point<Body::dim, typename Body::real>& where,
                                                          point<Body::dim, typename Body::real>& local) {
    const auto& lattice = body.lattice();
    std::array<int, 3> cell;
    if (!lattice.locate(where, cell, local))
        throw error(sentence("make_body: the particle at (", list_of(where), ") is outside the grid, (",
                             list_of(lattice.grid().lower()), ") to (", list_of(lattice.grid().upper()),
                             "); enlarge the grid or leave it out"));
    return cell;
}

/// Throws `error` where the numbers of so many particles are more than `real` tells apart.
template <class real> void check_ids(std::uint64_t count) {
    using limits = std::numeric_limits<std::conditional_t<std::numeric_limits<real>::is_specialized, real, double>>;
    constexpr std::uint64_t most = std::uint64_t(1) << std::min(limits::digits, 63);
    if (count > most)
        throw error(sentence("make_body: field::id is asked for, and of ", count, " particles no more than ", most,
                             " can be numbered by a number of ", limits::digits,
                             " binary digits; give the grid's corners and spacing as double, or leave field::id out"));
}

/// Puts a particle at a point of the grid, in the slot and lane of its cell.
template <class Body, class Shape> void add_particle(Body& body, const Shape& functions, std::size_t number,
                                                     const point<Body::dim, typename Body::real>& where,
                                                     const typename Body::real& volume,
                                                     const typename Body::real& density) {
    using real = typename Body::real;
    using slot = typename Body::store_type::slot;
    constexpr int D = Body::dim, W = Body::space_type::width;
    const auto& lattice = body.lattice();
    point<D, real> local;
    const std::array<int, 3> cell = cell_of_particle(body, where, local);
    auto& store = body.store();
    const std::uint32_t s = store.add(lattice, cell);
    if (lattice.on_edge(cell, local)) store.note_edge(lattice, cell);
    real* p = store.lane_of(s, cell[0] % W);
    if constexpr (stores<typename Body::field_list, field::position>)
        for (int d = 0; d < D; ++d) p[(slot::template first<field::position>() + d) * W] = local[d];
    if constexpr (stores<typename Body::field_list, held_weights<Shape>>) {
        using one = space<D, real>;
        using weights = held_weights<Shape>;
        typename weights::template value<one> kept;
        weights::template keep<one>(kept, stencil_at(lattice, functions, cell, local));
        for (int c = 0; c < weights::template components<one>; ++c)
            p[(slot::template first<weights>() + c) * W] = kept[c];
    }
    if constexpr (stores<typename Body::field_list, field::id>)
        p[slot::template first<field::id>() * W] = static_cast<real>(static_cast<double>(number));
    if constexpr (stores<typename Body::field_list, field::volume>)
        p[slot::template first<field::volume>() * W] = volume;
    p[slot::template first<field::mass>() * W] = density * volume;
    if constexpr (stores<typename Body::field_list, field::density>)
        p[slot::template first<field::density>() * W] = density;
    if constexpr (stores<typename Body::field_list, field::deformation>)
        for (int d = 0; d < D; ++d) p[(slot::template first<field::deformation>() + d * (D + 1)) * W] = real(1);
}

/// A number for all points, or one for each.
template <class real> class for_points {
  public:
    template <class Number>
    requires std::convertible_to<const Number&, real> for_points(const Number& same) : same_(static_cast<real>(same)) {}
    for_points(const std::vector<real>& each) : each_(&each) {}
    const real& at(std::size_t k) const { return each_ ? (*each_)[k] : same_; }
    /// Throws `error` where one is not positive and finite, or if there are not as many as points.
    template <class Points> void check(const char* what, const Points& points) const {
        if (each_ && each_->size() != points.size())
            throw error(sentence("make_body: ", each_->size(), " numbers are given as the particles' ", what, " for ",
                                 points.size(), " points; give one for each, or a single number"));
        for (std::size_t k = 0; k < (each_ ? points.size() : 1); ++k)
            if (!(at(k) > real(0) && at(k) - at(k) == real(0)))
                throw error(sentence("make_body: the particles' ", what, " is ", at(k),
                                     each_ ? sentence(" at (", list_of(points[k]), ")") : std::string(),
                                     "; give a positive, finite number"));
    }

  private:
    real same_{};
    const std::vector<real>* each_ = nullptr;
};

/// Fills a new body: a particle of the given volume and density at each point.
template <class Body, class Shape, class Execution>
void add_particles(Body& body, const Shape& functions, const Execution& run,
                   const std::vector<point<Body::dim, typename Body::real>>& points,
                   const for_points<typename Body::real>& volume, const for_points<typename Body::real>& density) {
    using real = typename Body::real;
    check_law(body.law);
    if (points.empty()) throw error("make_body: the body has no particle; give at least one point");
    volume.check("volume", points);
    density.check("density", points);
    if constexpr (stores<typename Body::field_list, field::id>) check_ids<real>(points.size());
    const auto each_cell = [&](const auto& f) {
        point<Body::dim, real> local;
        for (const auto& where : points) f(cell_of_particle(body, where, local));
    };
    body.store().prepare(body.lattice(), each_cell, run);
    std::size_t number = 0;
    for (const auto& where : points) {
        add_particle(body, functions, number, where, volume.at(number), density.at(number));
        ++number;
    }
    if constexpr (requires(typename Body::template iterator<false> p) { body.law.start(*p); })
        for (auto p : body) body.law.start(p);
}

/// A new body. Without densities it has its law's.
template <class Body, class Motion, class L, class Lattice, class Shape, class Execution, class Points,
          class... Density>
auto new_body(const L& law, const Lattice& lattice, const Shape& functions, const Execution& run, const Points& points,
              const for_points<typename Body::real>& volume, const Density&... density) {
    // Here, not in check_law: clang names the user's line only for functions whose return type it must deduce.
    static_assert(HasDensity<L>, "tamis: the law has no density; give it a member `double density`");
    static_assert(HasWaveSpeed<L>,
                  "tamis: the law has no wave speed, from which time steps are chosen; give it a "
                  "member function `double wave_speed() const`");
    static_assert(is_total_lagrangian<Motion> || !keeps_first_place<typename Body::field_list>,
                  "tamis: field::displacement is kept by total_lagrangian{} only; keep particles' first places in a "
                  "field of your own, p[home] = p[symbols::x]");
    Body b(law, lattice);
    if constexpr (sizeof...(Density) > 0)
        add_particles(b, functions, run, points, volume, density...);
    else {
        check_law(law);
        add_particles(b, functions, run, points, volume, for_points<typename Body::real>(law.density));
    }
    return b;
}

/// f(place) for the centres of particles, `count` per cell and axis, as many along each axis as n says.
template <int D, class real, class F>
void each_centre(const uniform_grid<D, real>& grid, int count, const std::array<int, 3>& n, const F& f) {
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const std::array<int, 3> index{i, j, k};
                point<D, real> where;
                for (int d = 0; d < D; ++d)
                    where[d] = grid.lower()[d] +
                               grid.spacing() * ((real(index[static_cast<std::size_t>(d)]) + real(0.5)) / real(count));
                f(std::as_const(where));
            }
}
/// Centres of the particles of a region. Throws `error` if there are none.
template <int D, class real, class Region>
std::vector<point<D, real>> points_in(const uniform_grid<D, real>& grid, const Region& region, int count) {
    if (count < 1) throw error(sentence("make_body: ", count, " particles per cell; give per_cell{1} or more"));
    std::array<int, 3> n{1, 1, 1};
    for (int d = 0; d < D; ++d) {
        if (count > (1 << 30) / grid.cells(d))
            throw error(sentence("make_body: ", count, " particles per cell along an axis of ", grid.cells(d),
                                 " cells are more than can be numbered; give fewer"));
        n[static_cast<std::size_t>(d)] = grid.cells(d) * count;
    }
    std::vector<point<D, real>> points;
    each_centre(grid, count, n, [&](const auto& where) {
        if (region(where)) points.push_back(where);
    });
    if (points.empty())
        throw error("make_body: the region holds no particle; check it against the grid's corners and the spacing");
    return points;
}

/// A sentence about where the grid cuts off a part of a region that ends beyond it; empty if it does not. Regions that
/// have no end there, as a half-space, are meant to be cut.
template <int D, class real, class Region>
std::string region_beyond(const uniform_grid<D, real>& grid, const Region& region, int count) {
    if constexpr (std::same_as<Region, std::remove_const_t<decltype(everywhere)>>) return {};
    const auto holds = [&](const point<D, real>& where) {
        try {
            return static_cast<bool>(region(where));
        } catch (...) {  // it need not know of places beyond the grid
            return false;
        }
    };
    const real step = grid.spacing() / real(count);
    std::string told;
    for (int side = 0; side < 2 * D && told.empty(); ++side) {
        const int axis = side / 2;
        std::array<int, 3> n{1, 1, 1};
        for (int d = 0; d < D; ++d) n[static_cast<std::size_t>(d)] = d == axis ? 1 : grid.cells(d) * count;
        const real wall = side % 2 == 0 ? grid.lower()[axis] : grid.upper()[axis];
        const real outwards = side % 2 == 0 ? -step : step;
        each_centre(grid, count, n, [&](const auto& where) {
            if (!told.empty()) return;
            const auto at = [&](const real& place) {
                point<D, real> there = where;
                there[axis] = place;
                return there;
            };
            const point<D, real> beyond = at(wall + outwards / real(2));
            if (!holds(at(wall - outwards / real(2))) || !holds(beyond)) return;
            if (holds(at(wall + real(1000) * outwards * real(grid.cells(axis) * count)))) return;
            told = sentence("make_body: the region goes on beyond the grid, at (", list_of(beyond),
                            ") for one; what is there is not made. Enlarge the grid, or the region ends at it");
        });
    }
    return told;
}

}  // namespace detail
}  // namespace tamis
