#pragma once
#include <tamis/grid/uniform_grid.hpp>
#include <tamis/core/unroll.hpp>
#include <tamis/shape/stencil.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace tamis::detail {

/// Where a tile is: turns places in cells into places in space.
template <class S> struct frame {
    typename S::real spacing, inverse_spacing;
    std::array<typename S::real, static_cast<std::size_t>(S::dim)> corner;  // of lane 0's cell
};

/// So many times the round-off of numbers near 1.
template <class Real> Real round_offs(double count) {
    using known = std::conditional_t<std::numeric_limits<Real>::is_specialized, Real, double>;
    return constant<Real>(count * static_cast<double>(std::numeric_limits<known>::epsilon()));
}
/// How near to an edge of its cell a particle is on it, in cells. With linear functions round-off, which moves it to
/// and fro, must not give the nodes beyond hardly any mass, and then an acceleration without bounds.
template <class Shape, class Real> Real edge_width() { return Shape::support == 2 ? round_offs<Real>(2) : Real(0); }

/// How a grid is laid out for a shape and W lanes: cells of the bookkeeping (centred on nodes for shapes with shift
/// 0.5), and node rows along x padded to whole blocks of W. Node i of an axis is stored at i + ghosts; cell c reaches
/// storage places c ... c + N - 1.
template <class S, class Shape> class lattice {
  public:
    using real = typename S::real;
    static constexpr int D = S::dim, W = S::width, N = Shape::support;
    static constexpr int rows = power(N, D - 1);
    static_assert(ghosts<Shape> <= 1, "tamis: a shape may reach at most one node beyond a wall (support up to 4)");
    using cell_index = std::array<int, 3>;

    explicit lattice(const uniform_grid<D, real>& grid) : grid_(grid), inverse_spacing_(real(1) / grid.spacing()) {
        for (int d = 0; d < D; ++d) {
            bins_[at(d)] = grid.cells(d) + (Shape::shift > 0 ? 1 : 0);
            rows_of_nodes_[at(d)] = bins_[at(d)] + N - 1;
        }
        blocks_ = {(bins_[0] + W - 1) / W, bins_[1], bins_[2]};
        // One block more than the cells have: the last tile reaches into it.
        row_ = static_cast<std::size_t>(blocks_[0] + (N - 2) / W + 1) * static_cast<std::size_t>(W);
        plane_ = row_ * static_cast<std::size_t>(rows_of_nodes_[1]);
        size_ = plane_ * static_cast<std::size_t>(rows_of_nodes_[2]) + static_cast<std::size_t>(W + N);
        for (int l = 0; l < W; ++l) {
            first_lane_[at(l)] = real(l == 0 && !grid.wraps(0) ? 1 : 0);
            last_lane_[at(l)] = real(l == (bins_[0] - 1) % W && !grid.wraps(0) ? 1 : 0);
        }
    }

    const uniform_grid<D, real>& grid() const { return grid_; }
    real inverse_spacing() const { return inverse_spacing_; }
    /// Number of node places in storage, padding included.
    std::size_t size() const { return size_; }
    int bins(int d) const { return bins_[at(d)]; }
    /// Storage places of nodes along axis d, ghosts included.
    int places_along(int d) const { return rows_of_nodes_[at(d)]; }
    int blocks(int d) const { return blocks_[at(d)]; }
    std::size_t block_count() const {
        return static_cast<std::size_t>(blocks_[0]) * static_cast<std::size_t>(blocks_[1]) *
               static_cast<std::size_t>(blocks_[2]);
    }
    std::size_t block_place(const cell_index& tile) const {
        return (static_cast<std::size_t>(tile[2]) * static_cast<std::size_t>(blocks_[1]) +
                static_cast<std::size_t>(tile[1])) *
                   static_cast<std::size_t>(blocks_[0]) +
               static_cast<std::size_t>(tile[0]);
    }
    /// Storage place of the first node that a tile's lane 0 reaches.
    std::size_t first_node(const cell_index& tile) const {
        return static_cast<std::size_t>(tile[2]) * plane_ + static_cast<std::size_t>(tile[1]) * row_ +
               static_cast<std::size_t>(tile[0] * W);
    }
    /// Storage place of the r-th row of nodes around a cell, relative to the first.
    TAMIS_INLINE std::size_t row_offset(int r) const {
        if constexpr (D == 1)
            return 0;
        else
            return static_cast<std::size_t>(r % N) * row_ + static_cast<std::size_t>(r / N) * plane_;
    }
    /// How much further in storage the row of nodes is that is so many rows further along y and z.
    std::ptrdiff_t row_step(const std::array<int, 2>& rows_further) const {
        std::ptrdiff_t step = 0;
        if constexpr (D > 1) step += rows_further[0] * static_cast<std::ptrdiff_t>(row_);
        if constexpr (D > 2) step += rows_further[1] * static_cast<std::ptrdiff_t>(plane_);
        return step;
    }
    /// How far before or after a block of nodes others are read that share particles with it, at most: as blocks are
    /// read, two at a time.
    std::size_t reach() const {
        std::size_t farthest = static_cast<std::size_t>(2 * W + N);
        if constexpr (D > 1) farthest += static_cast<std::size_t>(N - 1) * row_;
        if constexpr (D > 2) farthest += static_cast<std::size_t>(N - 1) * plane_;
        return farthest;
    }
    /// Storage place of grid node (i, j, k).
    std::size_t node_place(const cell_index& node) const {
        std::size_t place = static_cast<std::size_t>(node[0] + ghosts<Shape>);
        if constexpr (D > 1) place += static_cast<std::size_t>(node[1] + ghosts<Shape>) * row_;
        if constexpr (D > 2) place += static_cast<std::size_t>(node[2] + ghosts<Shape>) * plane_;
        return place;
    }
    /// The same for a node that a user names. Throws `error` if the grid has no such node.
    std::size_t place_of_node(const cell_index& node) const {
        for (int d = 0; d < 3; ++d) {
            const int last = d < D ? grid_.cells(d) : 0;
            if (node[at(d)] < 0 || node[at(d)] > last)
                throw error(sentence("node (", node[0], ", ", node[1], ", ", node[2], "): the grid has none of index ",
                                     node[at(d)], " along axis ", d, "; give 0 to ", last));
        }
        return node_place(node);
    }

    /// Which node of the grid is at a storage place; ghosts and padding have indices that the grid has not.
    cell_index node_of(std::size_t place) const {
        const std::array<std::size_t, 3> along{D == 1 ? place : place % row_, D == 1 ? 0 : place % plane_ / row_,
                                               D < 3 ? 0 : place / plane_};
        cell_index node{0, 0, 0};
        for (int d = 0; d < D; ++d) node[at(d)] = static_cast<int>(along[at(d)]) - ghosts<Shape>;
        return node;
    }
    /// Where the node at a storage place is.
    point<D, real> place_of(std::size_t place) const {
        const cell_index node = node_of(place);
        point<D, real> where;
        for (int d = 0; d < D; ++d) where[d] = grid_.lower()[d] + grid_.spacing() * real(node[at(d)]);
        return where;
    }

    frame<S> frame_of(const cell_index& tile) const {
        frame<S> f{grid_.spacing(), inverse_spacing_, {}};
        for (int d = 0; d < D; ++d)
            f.corner[at(d)] =
                grid_.lower()[d] + grid_.spacing() * (real(d == 0 ? tile[0] * W : tile[at(d)]) - real(Shape::shift));
        return f;
    }
    /// Does the tile have cells whose functions are folded at a wall?
    TAMIS_INLINE bool at_wall(const cell_index& tile) const {
        if constexpr (ghosts<Shape> == 0)
            return false;
        else {
            bool yes = tile[0] == 0 || tile[0] == blocks_[0] - 1;
            for (int d = 1; d < D; ++d) yes = yes || tile[at(d)] == 0 || tile[at(d)] == bins_[at(d)] - 1;
            return yes;
        }
    }
    wall_lanes<S> walls_of(const cell_index& tile) const {
        using T = typename S::scalar;
        wall_lanes<S> walls;
        walls.low[0] = tile[0] == 0 ? lane<T>::load(first_lane_.data()) : T(real(0));
        walls.high[0] = tile[0] == blocks_[0] - 1 ? lane<T>::load(last_lane_.data()) : T(real(0));
        for (int d = 1; d < D; ++d) {
            walls.low[d] = T(real(tile[at(d)] == 0 && !grid_.wraps(d) ? 1 : 0));
            walls.high[d] = T(real(tile[at(d)] == bins_[at(d)] - 1 && !grid_.wraps(d) ? 1 : 0));
        }
        return walls;
    }

    /// Cell and place in it of a point; false if the point is not in the box. A point on a wall is in the cell beside
    /// it.
    bool locate(const point<D, real>& where, cell_index& cell, point<D, real>& local) const {
        cell = {0, 0, 0};
        for (int d = 0; d < D; ++d) {
            if (!(where[d] >= grid_.lower()[d] && where[d] <= grid_.upper()[d])) return false;
            const real q = (where[d] - grid_.lower()[d]) * inverse_spacing_ + real(Shape::shift);
            const int c = std::min(std::max(lane<real>::floor(q), 0), bins_[at(d)] - 1);
            cell[at(d)] = c;
            local[d] = q - real(c);
            // Round-off must not put a point on a wall beyond it.
            if (c == 0) local[d] = std::max<real>(local[d], real(Shape::shift));
            if (c == bins_[at(d)] - 1) local[d] = std::min<real>(local[d], real(1) - real(Shape::shift));
        }
        return true;
    }
    /// Is a place in a cell on an edge where functions have slopes, and no weights but those of round-off? Nodes beyond
    /// it may have no mass.
    bool on_edge(const cell_index& cell, const point<D, real>& local) const {
        bool yes = false;
        for (int d = 0; d < D; ++d) {
            const real& r = local[d];
            if constexpr (N == 2)
                yes = yes || r == real(0) || r == real(1);
            else if constexpr (ghosts < Shape >> 0) {
                const real near = constant<real>(Shape::shift) + round_offs<real>(64), far = real(1) - near;
                if (grid_.wraps(d)) continue;
                yes = yes || (cell[at(d)] == 0 && r <= near) || (cell[at(d)] == bins_[at(d)] - 1 && r >= far);
            }
        }
        return yes;
    }
    /// Along a periodic axis: the cell where a place is that may have left the box. False where that is none.
    bool bring_back(int d, int& cell, const real& local) const {
        if (!grid_.wraps(d) || !(local >= real(0) && local <= real(1))) return false;
        const int n = grid_.cells(d);
        cell = (cell % n + n) % n;
        // Cells centred on nodes: the one at the walls has a half at each.
        if (cell == 0 && local < real(Shape::shift)) cell = n;
        return true;
    }
    /// How far a place in a cell may go towards the walls: a cell centred on the wall's node has only its inner half.
    bool inside(const cell_index& cell, const point<D, real>& local) const {
        for (int d = 0; d < D; ++d) {
            if (cell[at(d)] < 0 || cell[at(d)] >= bins_[at(d)]) return false;
            if (cell[at(d)] == 0 && local[d] < real(Shape::shift)) return false;
            if (cell[at(d)] == bins_[at(d)] - 1 && local[d] > real(1) - real(Shape::shift)) return false;
        }
        return true;
    }

  private:
    static constexpr std::size_t at(int d) { return static_cast<std::size_t>(d); }
    uniform_grid<D, real> grid_;
    real inverse_spacing_;
    cell_index bins_{1, 1, 1}, blocks_{1, 1, 1}, rows_of_nodes_{1, 1, 1};
    std::size_t row_ = 0, plane_ = 0, size_ = 0;
    std::array<real, static_cast<std::size_t>(W)> first_lane_{}, last_lane_{};
};

/// Weights at one place of a cell: the functions of the step, one lane wide. `of`: the particle there, if one is meant
/// and the functions depend on it.
template <class S, class Shape, class... Particle> stencil<space<S::dim, typename S::real>, Shape::support> stencil_at(
    const lattice<S, Shape>& lattice, const Shape& functions, const std::array<int, 3>& cell,
    const point<S::dim, typename S::real>& local, const Particle&... of) {
    using real = typename S::real;
    using one = space<S::dim, real>;
    stencil<one, Shape::support> st;
    const typename one::vector r = local;
    if constexpr (sizeof...(Particle) > 0)
        st.set(functions, r, lattice.inverse_spacing(), of...);
    else
        st.set(functions_of_place(functions), r, lattice.inverse_spacing());
    if constexpr (ghosts < Shape >> 0) {
        wall_lanes<one> walls;
        for (int d = 0; d < S::dim; ++d) {
            const int c = cell[static_cast<std::size_t>(d)];
            const bool wall = !lattice.grid().wraps(d);
            walls.low[d] = real(c == 0 && wall ? 1 : 0);
            walls.high[d] = real(c == lattice.bins(d) - 1 && wall ? 1 : 0);
        }
        st.fold(walls);
    }
    return st;
}

}  // namespace tamis::detail
