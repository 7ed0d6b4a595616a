#pragma once
#include <tamis/run/body.hpp>

namespace tamis {

/// A node that reaches a particle.
template <int Dim, class Real> struct near_node {
    /// Numbers along x, y, z.
    std::array<int, 3> index;
    /// Place (m).
    point<Dim, Real> at;
    /// Value of its function at the particle.
    Real weight;
    /// Gradient of its function there (1/m).
    point<Dim, Real> slope;
};

namespace detail {

template <class S, class Shape, class F, class... Particle>
bool each_node_of(const lattice<S, Shape>& lattice, const Shape& functions,
                  const point<S::dim, typename S::real>& where, F&& f, const Particle&... of) {
    using real = typename S::real;
    constexpr int D = S::dim, N = Shape::support;
    std::array<int, 3> cell;
    point<D, real> local;
    if (!lattice.locate(where, cell, local)) return false;
    const auto st = stencil_at(lattice, functions, cell, local, of...);
    const auto& grid = lattice.grid();
    for (int row = 0; row < lattice.rows; ++row) {
        const auto across = st.row(row);
        for (int a = 0; a < N; ++a) {
            const std::array<int, 3> offset{a, row % N, row / N};
            near_node<D, real> node{{0, 0, 0}, {}, st.weight(a, across), st.slope(a, across)};
            bool exists = true;
            for (int d = 0; d < D; ++d) {
                const auto k = static_cast<std::size_t>(d);
                node.index[k] = cell[k] + offset[k] - ghosts<Shape>;
                if (grid.wraps(d)) node.index[k] = (node.index[k] + grid.cells(d)) % grid.cells(d);
                exists = exists && node.index[k] >= 0 && node.index[k] <= grid.cells(d);
            }
            if (!exists) continue;
            node.at = grid.node(node.index);
            f(std::as_const(node));
        }
    }
    return true;
}

}  // namespace detail

/// Calls f(near_node) for every node of the grid whose shape function reaches a point; for set-up and observation.
/// False if the point is outside the grid.
template <class S, class Shape, class F> bool each_near_node(const detail::lattice<S, Shape>& lattice,
                                                             const Shape& functions,
                                                             const point<S::dim, typename S::real>& where, F&& f) {
    return detail::each_node_of(lattice, functions, where, f);
}
/// The same for a particle, by the functions that its next step uses: some depend on the particle.
template <class S, class Shape, class Body, bool Const, class F>
bool each_near_node(const detail::lattice<S, Shape>& lattice, const Shape& functions, const particle<Body, Const>& p,
                    F&& f) {
    const point<S::dim, typename S::real> where = p[symbols::x];
    if constexpr (detail::reads_particles<Shape> && stores<typename Body::field_list, field::position>)
        return detail::each_node_of(lattice, functions, where, f, p);
    else
        return detail::each_node_of(lattice, functions, where, f);
}

}  // namespace tamis
