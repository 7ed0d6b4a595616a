#pragma once
#include <tamis/core/fields.hpp>
#include <tamis/core/unroll.hpp>
#include <tamis/transfer/mass.hpp>

#include <array>
#include <limits>

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

namespace detail {

/// The number of terms of a mass policy's series, as far as it is known when compiling.
template <class Mass> inline constexpr int terms_of = dynamic;
template <class Mass>
requires requires { Mass::fixed_terms; }
inline constexpr int terms_of<Mass> = Mass::fixed_terms;

/// A mass policy that tells how many terms it takes, at most; of others nothing is known.
template <class Mass>
concept CountsTerms = requires(const Mass& mass) {
    mass.terms();
};

/// From how many terms on a product with the assembled matrix costs less than a sweep over the particles for each term:
/// benchmarks/mass_matrix measures it. Where particles are held the matrix is assembled once, where they move in every
/// step: that takes as long as a sweep where its entries are few, in 1D and in 2D with linear functions.
inline constexpr int never_pays = std::numeric_limits<int>::max();
inline constexpr int most_entries_if_moved = 5, most_entries_if_held = 25;
template <int Dim, class Shape, bool Moves> inline constexpr int matrix_pays_from = [] {
    constexpr int entries = matrix_entries<Dim, Shape::support>::count;
    if (Moves) return entries > most_entries_if_moved ? never_pays : Shape::support <= 3 ? 3 : 4;
    return entries > most_entries_if_held ? never_pays : Dim > 1 ? 3 : 2;
}();

/// Does a composition multiply by the assembled full mass matrix, for some number of terms at least, and not particle
/// by particle?
template <int Dim, class Shape, class Mass, bool Moves> inline constexpr bool may_assemble =
    contains<on_nodes_t<Mass>, field::image>&& matrix_pays_from<Dim, Shape, Moves> != never_pays &&
    (matrix_pays_from<Dim, Shape, Moves> <= 2 ||
     (CountsTerms<Mass> && (terms_of<Mass> == dynamic || terms_of<Mass> >= matrix_pays_from<Dim, Shape, Moves>)));

}  // namespace detail
}  // namespace tamis
