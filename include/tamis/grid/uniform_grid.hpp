#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace tamis {

/// A box of cubic cells. Nodes are at the corners of cells, walls included. The number of coordinates is the dimension.
///
///     const uniform_grid box{{0., 0.}, {2., 1.}, 0.25};  // 8 x 4 cells, double
///     const auto tube = uniform_grid{{0.f}, {1.f}, 0.01f}.wrapped(0);  // periodic, float
template <int Dim, class Real = double> class uniform_grid {
  public:
    /// Number of dimensions.
    static constexpr int dim = Dim;
    /// Type of its numbers, and of those of all bodies on it.
    using real = Real;
    /// A place (m).
    using vector = point<Dim, Real>;

    /// Box from `lower` to `upper` with cells of side `spacing`, all in units of length; the box is a whole number of
    /// cells (to a millionth of its length), and a cell has 1024 or more numbers of its type. Throws `error` otherwise.
    uniform_grid(const Real (&lower)[Dim], const Real (&upper)[Dim], Real spacing) {
        for (std::size_t d = 0; d < Dim; ++d) {
            lower_[static_cast<Eigen::Index>(d)] = lower[d];
            upper_[static_cast<Eigen::Index>(d)] = upper[d];
        }
        if (!(spacing > Real(0)) || spacing - spacing != Real(0))
            throw error(detail::sentence("uniform_grid: the spacing is ", spacing, "; give a positive cell side"));
        for (int d = 0; d < Dim; ++d) {
            const Real extent = upper_[d] - lower_[d];
            if (!(extent > Real(0)) || extent - extent != Real(0))
                throw error(detail::sentence("uniform_grid: along axis ", d, " the upper corner (", upper_[d],
                                             ") is not above the lower one (", lower_[d], ")"));
            const Real cells = extent / spacing;
            if (cells > Real(1 << 20))
                throw error(detail::sentence("uniform_grid: ", cells, " cells along axis ", d,
                                             "; at most 1048576 are possible, give a larger spacing"));
            const int n = lane<Real>::floor(cells + Real(0.5));
            const Real off = cells - Real(n);
            const Real most = std::min<Real>(Real(1e-6) * Real(n + 1), Real(0.01));
            if (n < 1 || off > most || -off > most)
                throw error(detail::sentence("uniform_grid: the box is ", cells, " cells long along axis ", d,
                                             "; give corners a whole number of spacings apart"));
            cells_[static_cast<std::size_t>(d)] = n;
        }
        spacing_ = (upper_[0] - lower_[0]) / Real(cells_[0]);
        if constexpr (std::numeric_limits<Real>::is_specialized)
            for (int d = 0; d < Dim; ++d) {
                using std::abs;
                const Real farthest = std::max<Real>(abs(lower_[d]), abs(upper_[d]));
                if (spacing_ < Real(1024) * std::numeric_limits<Real>::epsilon() * farthest)
                    throw error(detail::sentence("uniform_grid: numbers near ", farthest, " (axis ", d,
                                                 ") are too coarse for cells of ", spacing_,
                                                 ": a cell has fewer than 1024 of them; give corners as double, or put "
                                                 "the origin near the bodies"));
            }
    }

    /// The corner with the smallest coordinates (m).
    const vector& lower() const { return lower_; }
    /// The corner with the largest coordinates (m).
    const vector& upper() const { return upper_; }
    /// Side of a cell (m).
    Real spacing() const { return spacing_; }
    /// Number of cells along axis d; there is one node more.
    int cells(int d) const { return cells_[static_cast<std::size_t>(d)]; }

    /// The same box, periodic along axis d: its upper wall is its lower one. Throws `error` if there is no such axis,
    /// or if it has fewer than 3 cells.
    uniform_grid wrapped(int d) const {
        if (d < 0 || d >= Dim) throw error(detail::sentence("uniform_grid: there is no axis ", d, " to wrap"));
        if (cells(d) < 3)
            throw error(detail::sentence("uniform_grid: ", cells(d), " cells along axis ", d,
                                         " cannot be wrapped; give 3 or more"));
        uniform_grid other = *this;
        other.wraps_[static_cast<std::size_t>(d)] = true;
        return other;
    }
    /// Is it periodic along axis d?
    bool wraps(int d) const { return wraps_[static_cast<std::size_t>(d)]; }

    /// Where node (i, j, k) is (m). Nodes on the walls are exactly there.
    vector node(const std::array<int, 3>& index) const {
        vector at;
        for (int d = 0; d < Dim; ++d) {
            const int i = index[static_cast<std::size_t>(d)];
            at[d] = i == cells(d) ? upper_[d] : lower_[d] + (upper_[d] - lower_[d]) * (Real(i) / Real(cells(d)));
        }
        return at;
    }

    /// f(index) for every node, i fastest.
    template <class F> void each_node(F f) const {
        std::array<int, 3> last{0, 0, 0};
        for (std::size_t d = 0; d < Dim; ++d) last[d] = cells_[d];
        for (int k = 0; k <= last[2]; ++k)
            for (int j = 0; j <= last[1]; ++j)
                for (int i = 0; i <= last[0]; ++i) f(std::array<int, 3>{i, j, k});
    }

  private:
    vector lower_, upper_;
    std::array<int, Dim> cells_{};
    std::array<bool, Dim> wraps_{};
    Real spacing_{};
};

namespace detail {

template <class G>
concept GridOfCells = requires(const G& grid) {
    typename G::real;
    G::dim;
    grid.spacing();
    grid.cells(0);
};

/// The number type of a grid given by plain numbers: whole numbers are taken as double.
template <class A, class B, class H> using grid_real =
    std::conditional_t<std::is_integral_v<std::common_type_t<A, B, H>>, double, std::common_type_t<A, B, H>>;

}  // namespace detail

template <class A, class B, class H, std::size_t N> uniform_grid(const A (&)[N], const B (&)[N], H)
    -> uniform_grid<static_cast<int>(N), detail::grid_real<A, B, H>>;

/// Corners that have not the same number of components.
template <class Real> class uniform_grid<0, Real> {
    static_assert(sizeof(Real) == 0,
                  "tamis: the corners of uniform_grid{lower, upper, spacing} have unlike numbers of components; give "
                  "each one for every axis, uniform_grid{{0., 0.}, {1., 1.}, 0.1} in 2D");

  public:
    /// Never made.
    template <class A, class B, std::size_t N, std::size_t M> uniform_grid(const A (&)[N], const B (&)[M], Real) {}
};
template <class A, class B, class H, std::size_t N, std::size_t M>
requires(N != M) uniform_grid(const A (&)[N], const B (&)[M], H)
->uniform_grid<0, detail::grid_real<A, B, H>>;

}  // namespace tamis
