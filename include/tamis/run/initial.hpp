#pragma once
#include <tamis/core/tensor.hpp>
#include <tamis/load/body_load.hpp>
#include <tamis/run/reach.hpp>

#include <type_traits>
#include <utility>

namespace tamis {

/// Particle velocities from velocity(place), in m/s. Where particles carry a slope of the velocity (APIC and its
/// relatives) it is that between the particle's sides: without it they would lose at once the rotation that they have
/// on the scale of a particle.
template <class Body, class F> void set_velocity_of(Body& body, const F& velocity) {
    using real = typename Body::real;
    using at_point = point<Body::dim, real>;
    for (auto p : body) {
        const at_point where = p[symbols::x];
        p[symbols::v] = detail::as_point<Body::dim, real>(velocity(where));
        if constexpr (Body::has(symbols::C)) {
            const real side = detail::side_of<Body::dim>(real(p[symbols::V]));
            for (int d = 0; d < Body::dim; ++d) {
                at_point low = where, high = where;
                low[d] -= side / 2;
                high[d] += side / 2;
                const at_point change = detail::as_point<Body::dim, real>(velocity(std::as_const(high))) -
                                        detail::as_point<Body::dim, real>(velocity(std::as_const(low)));
                for (int c = 0; c < Body::dim; ++c) p[symbols::C](c, d) = change[c] / side;
            }
        }
    }
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
namespace detail {

/// A tensor, or a number that makes a multiple of the identity.
template <class Body, class Value> auto as_tensor(const Value& value) {
    using real = typename Body::real;
    using tensor = matrix<Body::dim, real>;
    if constexpr (std::is_convertible_v<Value, real>)
        return isotropic<tensor>(static_cast<real>(value));
    else
        return tensor(value);
}

}  // namespace detail

/// Particle stresses from strain(place), a tensor or, in 1D, a number: what the law gives at that strain. Density,
/// strain and deformation of particles follow where they are stored: rho = rho0/(1 + tr strain), F = 1 + strain.
template <class Body, class Map> void set_strain_of(Body& body, const Map& strain) {
    using namespace symbols;
    using real = typename Body::real;
    using tensor = matrix<Body::dim, real>;
    for (auto p : body) {
        const tensor value = detail::as_tensor<Body>(strain(p[x]));
        static_assert(
            requires { body.law.at_strain(p, value); },
            "tamis: the law tells no stress of a strain alone; give it at_strain(p, strain), or set the "
            "deformation gradient of a law of finite strain by set_deformation_of");
        p[sigma] = tensor(body.law.at_strain(p, value));
        if constexpr (Body::has(epsilon)) p[epsilon] = value;
        if constexpr (Body::has(F)) p[F] = tensor(tensor::Identity() + value);
        if constexpr (Body::has(rho)) p[rho] = p[m] / p[V] / (real(1) + value.trace());
    }
}

/// Deformation gradients from deformation(place), a tensor or, in 1D, a number, and the stresses that a law of finite
/// strain gives them. Density and strain follow where they are stored: rho = rho0/det F, strain = (F + F^T)/2 - 1.
template <class Body, class Map> void set_deformation_of(Body& body, const Map& deformation) {
    using namespace symbols;
    using real = typename Body::real;
    using tensor = matrix<Body::dim, real>;
    static_assert(
        Body::has(F) && requires(const tensor& value) { body.law.at_deformation(value); },
        "tamis: the law tells no stress of a deformation gradient; set_deformation_of is for laws of finite strain, "
        "such as neo_hookean, and set_strain_of for the others");
    for (auto p : body) {
        const tensor value = detail::as_tensor<Body>(deformation(p[x]));
        const real J = detail::determinant(value);
        if (!(J > real(0) && J - J == real(0)))
            throw error(detail::sentence("set_deformation_of: the deformation gradient at (", detail::list_of(p[x]),
                                         ") has the determinant ", J, "; give it a positive, finite one"));
        p[F] = value;
        p[sigma] = tensor(body.law.at_deformation(value));
        if constexpr (Body::has(epsilon)) p[epsilon] = (value + value.transpose()) / real(2) - tensor::Identity();
        if constexpr (Body::has(rho)) p[rho] = p[m] / p[V] / J;
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
