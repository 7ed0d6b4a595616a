#pragma once
#include <tamis/core/error.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/solver/composition.hpp>

#include <concepts>
#include <vector>

namespace tamis {

/// How many particles a cell gets along each axis; they are at (s + 1/2)/n of it.
struct per_cell {
    int count = 2;
};

template <class L>
concept HasDensity = requires(const L& law) {
    { law.density } -> std::convertible_to<double>;
};
/// `wave_speed()` or, where it depends on the dimension, `wave_speed(dim)` (m/s).
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

/// Puts a particle at a point of the grid: its slot and lane.
template <bool Moves, class Body, class Shape>
void add_particle(Body& body, const Shape& functions, const point<Body::dim, typename Body::real>& where,
                  const typename Body::real& volume, const typename Body::real& density) {
    using real = typename Body::real;
    using slot = typename Body::store_type::slot;
    constexpr int D = Body::dim, W = Body::space_type::width;
    const auto& lattice = body.lattice();
    point<D, real> local;
    const std::array<int, 3> cell = cell_of_particle(body, where, local);
    auto& store = body.store();
    const std::uint32_t s = store.add(lattice, cell);
    real* p = store.lane_of(s, cell[0] % W);
    if constexpr (stores<typename Body::field_list, field::position>)
        for (int d = 0; d < D; ++d) p[(slot::template first<field::position>() + d) * W] = local[d];
    if constexpr (!Moves) {
        using one = space<D, real>;
        using weights = held_weights<Shape>;
        typename weights::template value<one> kept;
        weights::template keep<one>(kept, stencil_at(lattice, functions, cell, local));
        for (int c = 0; c < weights::template components<one>; ++c)
            p[(slot::template first<weights>() + c) * W] = kept[c];
    }
    if constexpr (stores<typename Body::field_list, field::volume>)
        p[slot::template first<field::volume>() * W] = volume;
    p[slot::template first<field::mass>() * W] = density * volume;
    if constexpr (stores<typename Body::field_list, field::density>)
        p[slot::template first<field::density>() * W] = density;
    if constexpr (stores<typename Body::field_list, field::deformation>)
        for (int d = 0; d < D; ++d) p[(slot::template first<field::deformation>() + d * (D + 1)) * W] = real(1);
}

/// Fills a new body: a particle of the given volume at each point.
template <bool Moves, class Body, class Shape, class Execution>
void add_particles(Body& body, const Shape& functions, const Execution& run,
                   const std::vector<point<Body::dim, typename Body::real>>& points,
                   const typename Body::real& volume) {
    using real = typename Body::real;
    check_law(body.law);
    if (points.empty()) throw error("make_body: the body has no particle; give at least one point");
    if (!(volume > real(0) && volume - volume == real(0)))
        throw error(sentence("make_body: the particles' volume is ", volume, "; give a positive, finite number"));
    const auto each_cell = [&](const auto& f) {
        point<Body::dim, real> local;
        for (const auto& where : points) f(cell_of_particle(body, where, local));
    };
    body.store().prepare(body.lattice(), each_cell, run);
    for (const auto& where : points) add_particle<Moves>(body, functions, where, volume, real(body.law.density));
    if constexpr (requires(typename Body::template iterator<false> p) { body.law.start(*p); })
        for (auto p : body) body.law.start(p);
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
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const std::array<int, 3> index{i, j, k};
                point<D, real> where;
                for (int d = 0; d < D; ++d)
                    where[d] = grid.lower()[d] +
                               grid.spacing() * ((real(index[static_cast<std::size_t>(d)]) + real(0.5)) / real(count));
                if (region(std::as_const(where))) points.push_back(where);
            }
    if (points.empty())
        throw error("make_body: the region holds no particle; check it against the grid's corners and the spacing");
    return points;
}

}  // namespace detail
}  // namespace tamis
