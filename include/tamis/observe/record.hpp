#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/run/reach.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <tuple>
#include <vector>

namespace tamis {

/// What is known of a particle, or of a node: there, the mass-weighted means over the particles in its reach.
template <int Dim, class Real> struct record {
    /// Place (m).
    point<Dim, Real> position;
    /// Mass (kg).
    Real mass;
    /// Density (kg/m^Dim).
    Real density;
    /// Velocity (m/s).
    point<Dim, Real> velocity;
    /// Kirchhoff stress (Pa) and strain.
    matrix<Dim, Real> stress, strain;
};

/// Can the strain of a body's particles be told? It can where the field is stored, or where the law gives it from the
/// stress.
template <class Body>
inline constexpr bool tells_strain = Body::has(symbols::epsilon) ||
                                     requires(const Body& body, const matrix<Body::dim, typename Body::real>& tau) {
    body.law.strain_at(*body.begin(), tau);
};
/// Can the density be told? It can where the field, the deformation or the strain is there.
template <class Body>
inline constexpr bool tells_density = Body::has(symbols::rho) || Body::has(symbols::F) || tells_strain<Body>;

/// Strain of a particle: the stored field or, without one, that of the law at the particle's stress.
template <class Body, class Particle>
matrix<Body::dim, typename Body::real> strain_of(const Body& body, const Particle& p) {
    using namespace symbols;
    if constexpr (Body::has(epsilon))
        return p[epsilon];
    else
        return body.law.strain_at(p, matrix<Body::dim, typename Body::real>(p[sigma]));
}
/// Density of a particle (kg/m^Dim): the stored field or, without one, M/V0 over J or over 1 + tr(strain).
template <class Body, class Particle> typename Body::real density_of(const Body& body, const Particle& p) {
    using namespace symbols;
    using real = typename Body::real;
    if constexpr (Body::has(rho))
        return p[rho];
    else if constexpr (Body::has(F))
        return p[m] / p[V] / matrix<Body::dim, real>(p[F]).determinant();
    else
        return p[m] / p[V] / (real(1) + strain_of(body, p).trace());
}

/// The record of one particle; what cannot be told is 0.
template <class Body, class Particle> auto record_of(const Body& body, const Particle& p) {
    using namespace symbols;
    using real = typename Body::real;
    record<Body::dim, real> r{p[x], p[m], real(0), p[v], p[sigma], matrix<Body::dim, real>::Zero()};
    if constexpr (tells_strain<Body>) r.strain = strain_of(body, p);
    if constexpr (tells_density<Body>) r.density = density_of(body, p);
    return r;
}

/// A node with its record, and what the particles' stresses push it with.
template <int Dim, class Real> struct node_record {
    /// Numbers along x, y, z.
    std::array<int, 3> index;
    /// Its mass, and means over the particles in its reach.
    record<Dim, Real> mean;
    /// What stresses push it with (N).
    point<Dim, Real> internal_force;
};

/// The nodes that have mass, in the grid's order, from the places and values that the particles have now.
template <class S, class Shape, class... Body>
auto node_records(const detail::lattice<S, Shape>& lattice, const Shape& functions, const std::tuple<Body&...>& all) {
    using namespace symbols;
    using real = typename S::real;
    using node_type = node_record<S::dim, real>;
    const auto& grid = lattice.grid();
    std::array<std::size_t, 3> count{1, 1, 1};
    for (int d = 0; d < S::dim; ++d) count[static_cast<std::size_t>(d)] = static_cast<std::size_t>(grid.cells(d)) + 1;
    const auto flat = [&](const std::array<int, 3>& index) {
        return (static_cast<std::size_t>(index[2]) * count[1] + static_cast<std::size_t>(index[1])) * count[0] +
               static_cast<std::size_t>(index[0]);
    };
    // Grids may be large and bodies small: only nodes that are reached get a record.
    detail::zeros<std::uint32_t> place(count[0] * count[1] * count[2]);
    std::vector<node_type> reached;
    const auto add = [&](const auto& body) {
        for (const auto p : body) {
            const auto r = record_of(body, p);
            const real volume = p[V];
            each_near_node(lattice, functions, p, [&](const auto& near) {
                std::uint32_t& k = place[flat(near.index)];
                if (k == 0) {
                    reached.push_back({near.index,
                                       {near.at, real(0), real(0), point<S::dim, real>::Zero(),
                                        matrix<S::dim, real>::Zero(), matrix<S::dim, real>::Zero()},
                                       point<S::dim, real>::Zero()});
                    k = static_cast<std::uint32_t>(reached.size());
                }
                node_type& node = reached[k - 1];
                const real share = near.weight * r.mass;
                node.mean.mass += share;
                node.mean.density += share * r.density;
                node.mean.velocity += share * r.velocity;
                node.mean.stress += share * r.stress;
                node.mean.strain += share * r.strain;
                node.internal_force -= volume * (r.stress * near.slope);
            });
        }
    };
    detail::each_of(all, add);

    std::erase_if(reached, [](const node_type& node) { return !(node.mean.mass > real(0)); });
    std::sort(reached.begin(), reached.end(),
              [&](const node_type& one, const node_type& other) { return flat(one.index) < flat(other.index); });
    for (node_type& node : reached) {
        const real share = real(1) / node.mean.mass;
        node.mean.density *= share;
        node.mean.velocity *= share;
        node.mean.stress *= share;
        node.mean.strain *= share;
    }
    return reached;
}

}  // namespace tamis
