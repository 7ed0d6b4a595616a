#pragma once
#include <tamis/conservation/law.hpp>
#include <tamis/core/names.hpp>
#include <tamis/transfer/gather.hpp>
#include <tamis/transfer/mass.hpp>

namespace tamis {

namespace field {

namespace detail {

template <int Count> struct column_field {
    template <class S> using value = Eigen::Matrix<typename S::scalar, Count, 1, S::align>;
    template <class S> static constexpr int components = Count;
};

}  // namespace detail

/// The unknowns of a conservation law at a node.
template <int Count> struct unknowns : detail::column_field<Count> {
    static constexpr std::string_view name = "unknowns";
};
/// Their fluxes F(u), those along x first.
template <int Count> struct fluxes {
    static constexpr std::string_view name = "fluxes";
    template <class S> using value = Eigen::Matrix<typename S::scalar, Count * S::dim, 1, S::align>;
    template <class S> static constexpr int components = (Count * S::dim);
};
/// What a step adds to the unknowns.
template <int Count> struct change : detail::column_field<Count> { static constexpr std::string_view name = "change"; };
/// Term of the full mass matrix's series; takes the fluxes' columns.
template <int Count> struct change_term : detail::column_field<Count> {
    using shares = fluxes<Count>;
    static constexpr std::string_view name = "change_term";
};
/// Sums over particles: sum V_p G_pi F(u_p), or the full mass matrix times a term.
template <int Count> struct rate : detail::column_field<Count> { static constexpr std::string_view name = "rate"; };

}  // namespace field

namespace detail {

template <class Mass> inline constexpr bool is_full_mass = false;
template <int K> inline constexpr bool is_full_mass<full_mass<K>> = true;

/// F(u) of nodes; 0 where there is no mass, whatever the law makes of zeros.
template <class S, class Law> struct flux_of_nodes {
    static constexpr int count = Law::unknowns;
    using list = fields<const field::inverse_mass, const field::unknowns<count>, field::fluxes<count>>;
    using T = typename S::scalar;
    const Law& law;
    TAMIS_INLINE void operator()(auto i) const {
        const auto& u = i[field::unknowns<count>{}];
        auto& all = i[field::fluxes<count>{}];
        const T zero(typename S::real(0));
        const auto there = i[symbols::im] > zero;
        for (int d = 0; d < S::dim; ++d) {
            const conservation::state<count, T> along = law.flux(u, d);
            for (int c = 0; c < count; ++c) all[d * count + c] = select(there, along[c], zero);
        }
    }
};

/// The first step takes particles to u_p = S u - dt/2 div F; the second puts V F(u_p) on the nodes, by their slopes.
template <class S, class Law> struct flux_to_nodes {
    static constexpr int count = Law::unknowns;
    using T = typename S::scalar;
    /// V F(u_p), along each axis.
    struct flow {
        conservation::state<count, T> along[S::dim];
    };
    using reads = fields<field::mass>;
    static constexpr bool uses_slopes = true;
    const Law& law;
    T half_dt;

    template <class Slot, class Gathered> TAMIS_INLINE flow make(const Slot& slot, const Gathered& g) const {
        conservation::state<count, T> u = g.sums.template get<field::unknowns<count>>();
        for (int d = 0; d < S::dim; ++d)
            for (int c = 0; c < count; ++c) u[c] -= half_dt * g.gradient(d * count + c, d);
        const T& V = slot.template get<field::mass>();
        const T zero(typename S::real(0));
        flow F;
        for (int d = 0; d < S::dim; ++d) {
            const conservation::state<count, T> along = law.flux(u, d);
            // Lanes without a particle: by select, for 0 times NaN is NaN.
            for (int c = 0; c < count; ++c) F.along[d][c] = select(V > zero, V * along[c], zero);
        }
        return F;
    }
    TAMIS_INLINE void operator()(auto, auto near, const flow& F) const {
        for (const auto& [i, w, dw] : near) {
            const typename S::vector slope = dw;
            for (int d = 0; d < S::dim; ++d) i[field::rate<count>{}] += slope[d] * F.along[d];
        }
    }
};

/// S^T V S times the term at hand.
template <int Count> struct spread_term {
    using reads = fields<field::mass>;
    static constexpr bool uses_slopes = false;
    /// V S times the term.
    TAMIS_INLINE static auto make(const auto& slot, const auto& term_p) {
        return (term_p.sums.template get<field::change_term<Count>>() * slot.template get<field::mass>()).eval();
    }
    TAMIS_INLINE void operator()(auto, auto near, const auto& term_p) const {
        for (const auto& [i, w, dw] : near) i[field::rate<Count>{}] += w * term_p;
    }
};

/// The first term of the series, dt m^-1 times the sums.
template <class T, int Count> struct first_term {
    using list =
        fields<const field::inverse_mass, const field::rate<Count>, field::change_term<Count>, field::change<Count>>;
    T dt;
    TAMIS_INLINE void operator()(auto i) const {
        i[field::change_term<Count>{}] = dt * i[symbols::im] * i[field::rate<Count>{}];
        i[field::change<Count>{}] = i[field::change_term<Count>{}];
    }
};
/// u becomes u + change.
template <int Count> struct add_change {
    using list = fields<const field::change<Count>, field::unknowns<Count>>;
    TAMIS_INLINE void operator()(auto i) const { i[field::unknowns<Count>{}] += i[field::change<Count>{}]; }
};
/// u becomes u + dt m^-1 times the sums.
template <class T, int Count> struct add_rate {
    using list = fields<const field::inverse_mass, const field::rate<Count>, field::unknowns<Count>>;
    T dt;
    TAMIS_INLINE void operator()(auto i) const {
        i[field::unknowns<Count>{}] += dt * i[symbols::im] * i[field::rate<Count>{}];
    }
};

}  // namespace detail
}  // namespace tamis
