#pragma once
#include <tamis/core/fields.hpp>
#include <tamis/transfer/mass.hpp>

#include <array>

namespace tamis {

namespace field {

/// In 1D, entries (i, i), (i, i + 1), ... (i, i + Count - 1) of the full mass matrix S^T M S, at node i (kg).
template <int Count> struct mass_band {
    static constexpr std::string_view name = "mass_band";
    template <class S> using value = Eigen::Matrix<typename S::scalar, Count, 1, S::align>;
    template <class S> static constexpr int components = Count;
};

}  // namespace field

namespace detail {

/// S_pi M_p S_pj onto the bands: `weights` are a particle's at its N nodes, i the a-th of them.
template <int N> struct bands_to_nodes {
    static constexpr bool by_place = true;
    TAMIS_INLINE void operator()(auto p, auto near, const auto& weights, auto a) const {
        constexpr int first = decltype(a)::value;
        for (const auto& [i, w, dw] : near) {
            const auto part = w * p[symbols::m];
            // Clang 14 captures no structured binding.
            auto& band = i[field::mass_band<N>{}];
            unroll<N - first>([&](auto j) TAMIS_INLINE_LAMBDA { band[j] += part * weights[first + j]; });
        }
    }
};

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

/// From how many terms on assembling the bands in every step costs less than sweeping particles for each term:
/// measured, docs/method.md.
template <class Shape> inline constexpr int bands_pay_from = Shape::support <= 3 ? 3 : 4;

/// Does a composition multiply by the assembled full mass matrix, and not particle by particle? In 1D its bands are
/// few: a term costs a few operations a node. Where particles are held they are assembled once; where they move, in
/// every step, which pays from some terms on.
template <int Dim, class Shape, class Mass, bool Moves>
inline constexpr bool may_use_bands = Dim == 1 && contains<on_nodes_t<Mass>, field::image> &&
                                      (!Moves || (CountsTerms<Mass> && (terms_of<Mass> == dynamic ||
                                                                        terms_of<Mass> >= bands_pay_from<Shape>)));

}  // namespace detail
}  // namespace tamis
