#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/strain.hpp>
#include <tamis/material/tait.hpp>

#include <cmath>
#include <string_view>

namespace tamis {

/// Newtonian viscosity beside another law's stress:
///
///     tau = tau(Law) + (V/V0) (2 mu (D - tr D/3 1) + kappa tr D 1),    D = (grad v + grad v^T)/2
///
/// `viscosity` is mu, `bulk_viscosity` kappa (Pa s). The deviator is that of three axes in every dimension, so 1D and
/// 2D are flows that are the same along the axes left out: in 1D the viscous stress is (4/3 mu + kappa) dv/dx. The
/// law's own stress must not be read from the particle, where it is mixed with the viscous one. Stores the density.
///
/// Steps are explicit, so besides the Courant number dt must stay below about h^2 rho/(2 Dim (4/3 mu + kappa)):
/// `largest_step`, of which `integrate` takes a share.
template <class Law> struct newtonian {
    /// The law that gives the pressure.
    Law law;
    /// mu and kappa (Pa s).
    double viscosity, bulk_viscosity = 0;
    /// That of the law (kg/m^Dim); leave it out.
    double density = law.density;
    using on_particles = merge<on_particles_t<Law>, fields<field::density, field::mass, field::volume>>;
    static constexpr std::string_view name = "newtonian";
    static constexpr bool three_by_three = ThreeByThree<Law>;
    static_assert(!contains<on_particles_t<Law>, field::stress>,
                  "tamis: newtonian adds to the stress that a law makes of other fields, but this law adds to the "
                  "stress itself; give one that does not read field::stress, such as tait or neo_hookean");

    void check() const {
        if constexpr (requires { law.check(); }) law.check();
        if (!(viscosity >= 0 && bulk_viscosity >= 0 && std::isfinite(viscosity + bulk_viscosity)))
            throw error(detail::sentence(name, ": the viscosities are ", viscosity, " and ", bulk_viscosity,
                                         "; give 0 or positive numbers"));
        if (density != law.density)
            throw error(detail::sentence(name, ": the density is ", density, ", and that of the law inside ",
                                         law.density, "; leave it out here"));
    }
    void start(auto p) const {
        if constexpr (requires { law.start(p); }) law.start(p);
    }
    void check(auto p) const {
        if constexpr (requires { law.check(p); }) law.check(p);
    }
    double wave_speed(int dim) const {
        if constexpr (requires { law.wave_speed(dim); })
            return law.wave_speed(dim);
        else
            return law.wave_speed();
    }
    /// By viscosity (s), for cells of side h (m).
    double largest_step(double h, int dim) const {
        return h * h * density / (2 * dim * (viscosity * 4 / 3 + bulk_viscosity));
    }
    /// Stored energy of the law inside (J/m^Dim of reference volume).
    auto energy(auto&& p, const auto& tau) const requires requires { law.energy(p, tau); }
    { return law.energy(p, tau); }

    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using namespace symbols;
        using T = typename Tensor::Scalar;
        const T J = p[m] / (p[V] * p[rho]), d = L.trace();
        const T mu = constant<T>(viscosity), spread = constant<T>(bulk_viscosity - viscosity * 2 / 3);
        const Tensor viscous = (mu * J) * Tensor(L + L.transpose()) + detail::isotropic<Tensor>(spread * J * d);
        return law.stress(p, L, dt) + viscous;
    }
};
/// Slightly compressible viscous fluid.
using newtonian_fluid = newtonian<tait>;

}  // namespace tamis
