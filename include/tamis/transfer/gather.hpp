#pragma once
#include <tamis/transfer/near.hpp>

namespace tamis::detail {

/// What particles gather from nodes: S F for every field of a list, and the gradient of one field of so many
/// components.
template <class S, class List, int Components = S::dim> struct gathered {
    values<S, List> sums;
    // (c, d): slope along axis d of component c
    Eigen::Matrix<typename S::scalar, Components, S::dim, S::align> gradient;
};

/// No gradient wanted.
struct no_field {};

/// Gathers at place `first` (that of lane 0's first node). Components outside, rows inside: few sums at once, so they
/// fit in sixteen registers.
template <class Gradient, class S, class Shape, class Nodes, class... F, int Components>
TAMIS_INLINE void gather(const lattice<S, Shape>& lattice, const Nodes& nodes, const stencil<S, Shape::support>& st,
                         std::size_t first, gathered<S, fields<F...>, Components>& to) {
    using T = typename S::scalar;
    using real = typename S::real;
    using L = lane<T>;
    constexpr int D = S::dim, N = Shape::support, rows = tamis::detail::lattice<S, Shape>::rows;
    typename stencil<S, N>::across across[rows];
    unroll<rows>([&](auto r) TAMIS_INLINE_LAMBDA { across[r] = st.row(r); });

    const auto one = [&](auto tag, auto c, auto wants_sum, auto wants_slope) TAMIS_INLINE_LAMBDA {
        using G = typename decltype(tag)::type;
        const real* column = nodes.template column<G>(c) + first;
        T sum(real(0)), slope[3] = {T(real(0)), T(real(0)), T(real(0))};
        for (int r = 0; r < rows; ++r) {
            const real* p = column + lattice.row_offset(r);
            const auto& q = across[r];
            T u[N];
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA { u[a] = L::load(p + a); });
            if constexpr (wants_sum || D > 1) {
                T s = st.axis[0].w[0] * u[0];
                unroll<N - 1>([&](auto a) TAMIS_INLINE_LAMBDA { s += st.axis[0].w[a + 1] * u[a + 1]; });
                if constexpr (D == 1)
                    sum += s;
                else if constexpr (wants_sum)
                    sum += s * q.w;
                if constexpr (wants_slope && D > 1) slope[1] += s * q.d1;
                if constexpr (wants_slope && D > 2) slope[2] += s * q.d2;
            }
            if constexpr (wants_slope) {
                T e = st.axis[0].dw[0] * u[0];
                unroll<N - 1>([&](auto a) TAMIS_INLINE_LAMBDA { e += st.axis[0].dw[a + 1] * u[a + 1]; });
                if constexpr (D == 1)
                    slope[0] += e;
                else
                    slope[0] += e * q.w;
            }
        }
        if constexpr (wants_sum) component<S>(to.sums.template get<G>(), c) = sum;
        if constexpr (wants_slope)
            unroll<D>([&](auto d) TAMIS_INLINE_LAMBDA { to.gradient(int(c), int(d)) = slope[d]; });
    };
    const auto field = [&](auto tag, auto wants_sum) TAMIS_INLINE_LAMBDA {
        using G = std::remove_const_t<typename decltype(tag)::type>;
        unroll<G::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
            one(std::type_identity<G>{}, c, wants_sum, std::bool_constant<std::same_as<G, Gradient>>{});
        });
    };
    (field(std::type_identity<F>{}, std::true_type{}), ...);
    if constexpr (!std::same_as<Gradient, no_field> && !contains<fields<F...>, Gradient>)
        field(std::type_identity<Gradient>{}, std::false_type{});
}

}  // namespace tamis::detail
