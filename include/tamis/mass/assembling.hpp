#pragma once
#include <tamis/engine/mass_entries.hpp>
#include <tamis/mass/mass.hpp>

#include <limits>

namespace tamis::detail {

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

}  // namespace tamis::detail
