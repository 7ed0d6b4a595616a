#pragma once
#include <tamis/conservation/law.hpp>
#include <tamis/core/names.hpp>
#include <tamis/mass/mass.hpp>
#include <tamis/step/node_stages.hpp>
#include <tamis/step/particle_kernel.hpp>

#include <string>

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
    static constexpr std::string_view name = "unknowns", letter = "u";
};
/// Their fluxes F(u), those along x first.
template <int Count> struct fluxes {
    static constexpr std::string_view name = "fluxes", letter = "F";
    template <class S> using value = Eigen::Matrix<typename S::scalar, Count * S::dim, 1, S::align>;
    template <class S> static constexpr int components = (Count * S::dim);
};
/// What a step adds to the unknowns.
template <int Count> struct change : detail::column_field<Count> {
    static constexpr std::string_view name = "change", letter = "du";
};
/// Term of the full mass matrix's series.
template <int Count> struct change_term : detail::column_field<Count> {
    static constexpr std::string_view name = "change_term", letter = "du_l";
};
/// Sums over particles: sum V_p G_pi F(u_p), or the full mass matrix times a term.
template <int Count> struct rate : detail::column_field<Count> {
    static constexpr std::string_view name = "rate", letter = "r";
};

}  // namespace field

namespace detail {

template <class Mass> inline constexpr bool is_full_mass = false;
template <int K> inline constexpr bool is_full_mass<full_mass<K>> = true;

/// F(u) of nodes; 0 where there is no mass, whatever the law makes of zeros.
template <class S, class Law> struct flux_of_nodes : over_nodes {
    static constexpr int count = Law::unknowns;
    using on_nodes = fields<const field::inverse_mass, const field::unknowns<count>, field::fluxes<count>>;
    using T = typename S::scalar;
    struct formula {
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
    static formula bind(const auto& now) { return {now.law}; }
    static std::string text() { return "F = F(u)"; }
};

/// V F(u_p), along each axis, times the slope of a weight.
template <class S, int Count> struct flux_term {
    conservation::state<Count, typename S::scalar> along[S::dim];
    TAMIS_INLINE void add(auto& to, const auto& node) const {
        const typename S::vector slope = node.dw;
        for (int d = 0; d < S::dim; ++d) to.template get<field::rate<Count>>() += slope[d] * along[d];
    }
};
/// The first step takes particles to u_p = S u - dt/2 div F; the second puts V F(u_p) on the nodes, by their slopes.
template <class S, class Law> struct flux_to_nodes {
    static constexpr over where = over::particles;
    static constexpr int count = Law::unknowns;
    using on_particles = fields<const field::mass>;
    using on_nodes = fields<const field::unknowns<count>, const field::fluxes<count>, field::rate<count>>;
    using T = typename S::scalar;
    struct part : gives<fields<field::rate<count>>, fields<field::mass>, true> {
        using gathers = tamis::detail::gathers<fields<field::unknowns<count>>, fields<field::fluxes<count>>>;
        const Law& law;
        T half_dt;
        TAMIS_INLINE auto make(const auto& slot, const auto&, const auto& g) const {
            conservation::state<count, T> u = g.template sum<field::unknowns<count>>();
            const auto& slopes = g.template gradient<field::fluxes<count>>();
            for (int d = 0; d < S::dim; ++d)
                for (int c = 0; c < count; ++c) u[c] -= half_dt * slopes(d * count + c, d);
            const T& V = slot.template get<field::mass>();
            const T zero(typename S::real(0));
            flux_term<S, count> F;
            for (int d = 0; d < S::dim; ++d) {
                const conservation::state<count, T> along = law.flux(u, d);
                // Lanes without a particle: by select, for 0 times NaN is NaN.
                for (int c = 0; c < count; ++c) F.along[d][c] = select(V > zero, V * along[c], zero);
            }
            return F;
        }
    };
    static part bind(const auto& now, auto&, auto&) { return {{}, now.law, T(now.half())}; }
    static std::string text() { return "u_p = S u - dt/2 div F(u); r = G^T V F(u_p)"; }
};

/// A field times dt/m, in place of another or added to it.
template <class From, class To> struct rate_over_mass : over_nodes {
    using on_nodes = fields<const field::inverse_mass, const From, To>;
    template <class T> struct formula {
        T dt;
        TAMIS_INLINE void operator()(auto i) const { i[To{}] = dt * i[symbols::im] * i[From{}]; }
    };
    static auto bind(const auto& now) { return formula<std::remove_cvref_t<decltype(now.lanes_dt())>>{now.lanes_dt()}; }
    static std::string text() { return letter<To>() + " = dt " + letter<From>() + "/m"; }
};
template <class From, class To> struct add_rate_over_mass : over_nodes {
    using on_nodes = fields<const field::inverse_mass, const From, const To, To>;
    template <class T> struct formula {
        T dt;
        TAMIS_INLINE void operator()(auto i) const { i[To{}] += dt * i[symbols::im] * i[From{}]; }
    };
    static auto bind(const auto& now) { return formula<std::remove_cvref_t<decltype(now.lanes_dt())>>{now.lanes_dt()}; }
    static std::string text() { return letter<To>() + " += dt " + letter<From>() + "/m"; }
};
template <class From, class To> struct copy_to : over_nodes {
    using on_nodes = fields<const From, To>;
    static copy_field<From, To> bind(const auto&) { return {}; }
    static std::string text() { return letter<To>() + " = " + letter<From>(); }
};
template <class From, class To> struct add_to : over_nodes {
    using on_nodes = fields<const From, const To, To>;
    struct formula {
        TAMIS_INLINE void operator()(auto i) const { i[To{}] += i[From{}]; }
    };
    static formula bind(const auto&) { return {}; }
    static std::string text() { return letter<To>() + " += " + letter<From>(); }
};

/// S^T V S times the term at hand: a kernel of `sweeps`.
template <class S, int Count> struct spread_change_term {
    using gathers = tamis::detail::gathers<fields<field::change_term<Count>>>;
    using sums = fields<field::rate<Count>>;
    using reads = fields<field::mass>;
    static constexpr bool sums_by_slopes = false, sums_by_offsets = false, updates = false, moves = false;
    TAMIS_INLINE auto make(const auto& slot, const auto&, const auto& term_p) const {
        return plain_term<field::rate<Count>, conservation::state<Count, typename S::scalar>>{
            term_p.template sum<field::change_term<Count>>() * slot.template get<field::mass>()};
    }
    static no_look look() { return {}; }
};

// What ends of a line do.

template <int Count> struct through_ends {
    static constexpr over where = over::whole;
    using on_particles = fields<>;
    using on_nodes =
        fields<const field::unknowns<Count>, const field::fluxes<Count>, const field::rate<Count>, field::rate<Count>>;
    static void run(auto& now) { now.flow_through_ends(); }
    static std::string text() { return "r -= flux through ends"; }
};
template <int Count> struct hold_unknowns {
    static constexpr over where = over::whole;
    using on_particles = fields<>;
    using on_nodes = fields<const field::unknowns<Count>, field::unknowns<Count>>;
    static void run(auto& now) { now.hold_unknowns(); }
    static std::string text() { return "hold u"; }
};
template <int Count> struct hold_change {
    static constexpr over where = over::whole;
    using on_particles = fields<>;
    using on_nodes = fields<const field::unknowns<Count>, const field::change<Count>, field::change<Count>,
                            const field::change_term<Count>, field::change_term<Count>>;
    static void run(auto& now) { now.hold_change(); }
    static std::string text() { return "hold du"; }
};
/// The terms of the full mass matrix's series beyond the first.
template <int Count> struct further_change_terms {
    static constexpr over where = over::whole;
    using on_particles = fields<const field::mass>;
    using on_nodes = fields<const field::inverse_mass, const field::unknowns<Count>, const field::change<Count>,
                            field::change<Count>, const field::change_term<Count>>;
    using scratch = fields<field::rate<Count>>;
    static void run(auto& now) { now.further_terms(); }
    static std::string text() { return "du += further terms"; }
};

/// One step of the two-step Taylor-Galerkin scheme (docs/taylor-galerkin.md): a second text for the engine of the MPM
/// step.
template <class S, class Law, class Mass> struct taylor_galerkin_text {
    static constexpr int N = Law::unknowns;
    using u = field::unknowns<N>;
    using r = field::rate<N>;
    using du = field::change<N>;
    using term = field::change_term<N>;
    using first = stages<flux_of_nodes<S, Law>,      // F = F(u)
                         flux_to_nodes<S, Law>,      // u_p = S u - dt/2 div F(u); r = G^T V F(u_p)
                         through_ends<N>>;           // r -= flux through the ends
    using lumped = stages<add_rate_over_mass<r, u>,  // u += dt r/m
                          hold_unknowns<N>>;
    using full = stages<rate_over_mass<r, term>,            // du_1 = dt r/m
                        copy_to<term, du>, hold_change<N>,  // du = du_1
                        further_change_terms<N>,            // du = sum of A^l du_1
                        add_to<du, u>>;                     // u += du
    using type = stages<first, std::conditional_t<Mass::full, full, lumped>>;
};

}  // namespace detail
}  // namespace tamis
