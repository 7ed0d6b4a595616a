#pragma once
#include <tamis/core/fields.hpp>
#include <tamis/core/unroll.hpp>

#include <array>

namespace tamis {

namespace detail {

/// Where the entries of a row of the symmetric full mass matrix lie, for functions over N nodes along each of D axes:
/// those to the node itself and to the nodes after it in storage. By rows of nodes along x: the node's own has N (0 to
/// N - 1 places further), the others have 2N - 1 each (-(N - 1) to N - 1 places).
template <int D, int N> struct matrix_entries {
    static constexpr int across = 2 * N - 1;
    static constexpr int rows = (power(across, D - 1) + 1) / 2;
    static constexpr int count = N + (rows - 1) * across;
    /// The entry to the node dx places further in a row.
    static constexpr int of(int row, int dx) { return row == 0 ? dx : N + (row - 1) * across + N - 1 + dx; }
    /// The row dy, dz further along y and z; negative for those before.
    static constexpr int row(int dy, int dz) { return dz * across + dy; }
    /// How far along y and z a row is.
    static constexpr std::array<int, 2> steps(int row) {
        const int dz = (row + N - 1) / across;
        return {row - dz * across, dz};
    }
};

}  // namespace detail

namespace field {

/// Entries of the full mass matrix S^T M S at node i (kg), for functions over N nodes along an axis: those to i and to
/// the nodes after it, in the order of `matrix_entries`. In 1D (i, i), (i, i + 1), ... (i, i + N - 1).
template <int N> struct mass_entries {
    static constexpr std::string_view name = "mass_entries";
    template <class S> static constexpr int components = tamis::detail::matrix_entries<S::dim, N>::count;
    template <class S> using value = Eigen::Matrix<typename S::scalar, components<S>, 1, S::align>;
};

}  // namespace field

}  // namespace tamis
