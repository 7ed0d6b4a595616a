#pragma once
#include <tamis/particles/reach.hpp>

#include <type_traits>

namespace tamis {

/// Particle velocities from velocity(place), in m/s.
template <class Body, class F> void set_velocity_of(Body& body, const F& velocity) {
    for (auto p : body) p[symbols::v] = detail::as_point<Body::dim, typename Body::real>(velocity(p[symbols::x]));
}
/// Particle masses from density(place), in kg/m^Dim: M = rho V0.
template <class Body, class F> void set_density_of(Body& body, const F& density) {
    using namespace symbols;
    using real = typename Body::real;
    for (auto p : body) {
        const real value = static_cast<real>(density(p[x]));
        if (!(value > real(0)))
            throw error(detail::sentence("set_density_of: the density at (", detail::list_of(p[x]), ") is ", value,
                                         "; give a positive number"));
        p[m] = value * p[V];
        if constexpr (Body::has(rho)) p[rho] = value;
    }
}
/// Particle stresses from strain(place), a tensor or, in 1D, a number: what the law gives at that strain. Density and
/// strain of particles follow where they are stored: rho = rho0/(1 + tr strain).
template <class Body, class F> void set_strain_of(Body& body, const F& strain) {
    using namespace symbols;
    using real = typename Body::real;
    using tensor = matrix<Body::dim, real>;
    for (auto p : body) {
        tensor value;
        if constexpr (std::is_convertible_v<decltype(strain(p[x])), real>)
            value = tensor::Identity() * static_cast<real>(strain(p[x]));
        else
            value = strain(p[x]);
        p[sigma] = tensor(body.law.at_strain(p, value));
        if constexpr (Body::has(epsilon)) p[epsilon] = value;
        if constexpr (Body::has(rho)) p[rho] = p[m] / p[V] / (real(1) + value.trace());
    }
}

/// ADMPM's way: f is evaluated at the nodes, and particles get what the shape functions make of it there.
template <class Solver, class F> auto through_nodes(const Solver& mpm, const F& f) {
    using real = typename Solver::real;
    using point_type = point<Solver::dim, real>;
    return [&mpm, f](const point_type& where) {
        using value = std::remove_cvref_t<decltype(f(where))>;
        value total = value(f(where) * 0);
        each_near_node(mpm.lattice(), mpm.functions(), where,
                       [&](const auto& node) { total += node.weight * f(node.at); });
        return total;
    };
}

}  // namespace tamis
