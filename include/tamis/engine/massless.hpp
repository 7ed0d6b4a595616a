#pragma once
#include <tamis/engine/gather.hpp>
#include <tamis/engine/tile.hpp>

namespace tamis::detail {

/// A node without mass has no part in a gradient. Particles exactly on an edge of their cell, and alone there, give
/// some nodes no mass, and yet those nodes' functions have slopes: what stands at such a node is no value of the field,
/// and a body in rigid motion would be strained by it. Instead it has here the value that goes on linearly from the
/// nodes with mass beside it, and where there is but one, that one's.
template <class S, class Shape, class Mass, class Gradients> struct massless;
template <class S, class Shape, class Mass, class... F> struct massless<S, Shape, Mass, fields<F...>> {
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    static constexpr int D = S::dim, W = S::width, N = Shape::support;

    /// Values around a tile, mended.
    template <class Around, class Nodes>
    TAMIS_SELDOM static Around mended(const lattice_type& lattice, const Nodes& nodes, const tile& t) {
        Around around(lattice, nodes, t.node);
        for (int l = 0; l < W; ++l)
            for (int r = 0; r < lattice_type::rows; ++r) {
                const std::array<int, 2> row{r % N, r / N};
                const std::size_t first = t.node + lattice.row_offset(r) + static_cast<std::size_t>(l);
                bool lacks = false;
                for (int a = 0; a < N; ++a) lacks = lacks || !has_mass(nodes, first + static_cast<std::size_t>(a));
                if (lacks) (mend_row<F>(around, lattice, nodes, first, row, r, l), ...);
            }
        return around;
    }

  private:
    template <class Nodes> static bool has_mass(const Nodes& nodes, std::size_t place) {
        // Where 1/m has taken the column of m, it is 0 at the same nodes.
        return nodes.template at<Mass>(place) >= least_mass<real>();
    }
    template <class G, class Around, class Nodes> static void mend_row(Around& around, const lattice_type& lattice,
                                                                       const Nodes& nodes, std::size_t first,
                                                                       const std::array<int, 2>& row, int r, int l) {
        for (int c = 0; c < G::template components<S>; ++c) {
            real value[N];
            for (int a = 0; a < N; ++a) {
                const std::size_t place = first + static_cast<std::size_t>(a);
                value[a] = has_mass(nodes, place) ? nodes.template at<G>(place, c)
                                                  : continued<G>(lattice, nodes, place, {a, row[0], row[1]}, c);
            }
            around.template put_row<G>(c, r, l, value);
        }
    }
    /// The mean of what goes on from the nodes with mass, of those that the same particles reach.
    template <class G, class Nodes> static real continued(const lattice_type& lattice, const Nodes& nodes,
                                                          std::size_t place, const std::array<int, 3>& of, int c) {
        real sum(0);
        int count = 0;
        const std::array<int, 3> node = lattice.node_of(place);
        for (int d = 0; d < D; ++d)
            for (const int way : {-1, 1}) {
                const auto k = static_cast<std::size_t>(d);
                const auto beside = [&](int nodes_away) {
                    std::array<int, 3> other = node;
                    other[k] += nodes_away * way;
                    return other;
                };
                const auto massive = [&](const std::array<int, 3>& other) {
                    return other[k] >= 0 && other[k] <= lattice.grid().cells(d) &&
                           has_mass(nodes, lattice.node_place(other));
                };
                if (of[k] + way < 0 || of[k] + way >= N || !massive(beside(1))) continue;
                const auto value = [&](const std::array<int, 3>& other) {
                    return nodes.template at<G>(lattice.node_place(other), c);
                };
                sum += value(beside(1));
                if (massive(beside(2))) sum += value(beside(1)) - value(beside(2));
                ++count;
            }
        return count == 0 ? real(0) : sum / real(count);
    }
};

}  // namespace tamis::detail
