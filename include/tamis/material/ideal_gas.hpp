#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/power.hpp>
#include <tamis/core/tensor.hpp>

#include <cmath>

namespace tamis {

/// No artificial viscosity: nothing is stored or computed for it.
struct no_viscosity {
    static constexpr bool never = true;
    void check() const {}
};

/// Pressure that spreads shocks over a few cells (von Neumann & Richtmyer 1950, with Landshoff's linear term), where a
/// gas is compressed, d = div v < 0:
///
///     q = rho ((quadratic l d)^2 + linear l c |d|)
///
/// l is a length (m), usually the grid's spacing; c the speed of sound. Its work is heat.
struct artificial_viscosity {
    /// A length l (m), as a rule the grid's spacing.
    double length;
    /// The coefficients.
    double linear = 0.5, quadratic = 2;
    void check() const {
        if (!(length > 0 && std::isfinite(length)))
            throw error(detail::sentence("artificial_viscosity: the length is ", length,
                                         "; give a positive one, as a rule the grid's spacing"));
        if (!(linear >= 0 && quadratic >= 0 && std::isfinite(linear + quadratic)))
            throw error(detail::sentence("artificial_viscosity: its coefficients are ", linear, " and ", quadratic,
                                         "; give 0 or positive numbers"));
    }
};

/// Ideal gas, p = (gamma - 1) rho e, without viscosity and conduction of heat. `density` (kg/m^Dim) and `pressure` (Pa)
/// are those that it starts with.
///
/// Along a particle, whose volume changes by J = 1 + dt div v in a step, e' = e J^(1 - gamma): entropy is kept exactly,
/// and with it p/rho^gamma. The Kirchhoff stress is tau = -p V/V0 = -(gamma - 1) rho0 e, so stress is all that is
/// stored. With `artificial_viscosity` p + q takes the place of p, and q heats, e' = e J^(1 - gamma) - dt (q/rho) div
/// v: then energy is stored as well.
///
/// These are rates along a particle. For particles that are held still the rate at a fixed point has -v . grad p as
/// well, which this law leaves out: its error there is of second order in the amplitude. Where J is not positive the
/// stress is NaN, which stops a run by `integrate`.
template <class Viscosity> struct ideal_gas_of {
    /// Ratio of heats, density (kg/m^Dim) and pressure (Pa) at first.
    double gamma, density, pressure;
    /// `artificial_viscosity`, or none.
    [[no_unique_address]] Viscosity viscosity{};
    /// Is there one?
    static constexpr bool viscous = !requires { requires Viscosity::never; };
    using on_particles =
        std::conditional_t<viscous,
                           fields<const field::stress, field::internal_energy, const field::mass, const field::volume>,
                           fields<const field::stress>>;
    static constexpr std::string_view name = "ideal_gas";

    void check() const {
        if (!(gamma > 1 && std::isfinite(gamma)))
            throw error(detail::sentence(name, ": gamma is ", gamma, "; give a number above 1 (air: 1.4)"));
        if (!(density > 0 && std::isfinite(density)))
            throw error(detail::sentence(name, ": the density is ", density, "; give a positive number"));
        if (!(pressure > 0 && std::isfinite(pressure)))
            throw error(detail::sentence(name, ": the pressure is ", pressure, "; give a positive number"));
        viscosity.check();
    }
    /// A new particle has the law's pressure.
    void start(auto p) const {
        for (int d = 0; d < static_cast<int>(p[symbols::x].size()); ++d) p[symbols::sigma](d, d) = -pressure;
        if constexpr (viscous) p[field::internal_energy{}] = pressure / ((gamma - 1) * density);
    }
    void check(auto p) const {
        const double e = energy_per_mass(p);
        if (!(e > 0 && std::isfinite(e)))
            throw error(detail::sentence("its internal energy is ", e,
                                         " J/kg; give the gas a positive pressure, and take steps short enough to "
                                         "keep it so"));
    }
    /// Speed of sound (m/s), at the start and of a particle.
    double wave_speed(int) const { return std::sqrt(gamma * pressure / density); }
    double wave_speed_at(auto p, int) const { return std::sqrt(gamma * (gamma - 1) * energy_per_mass(p)); }

    /// Internal energy of a particle per mass (J/kg).
    double energy_per_mass(const auto& p) const {
        if constexpr (viscous)
            return detail::to_double(p[field::internal_energy{}]);
        else
            return -detail::to_double(p[symbols::sigma](0, 0) * p[symbols::V] / p[symbols::m]) / (gamma - 1);
    }
    /// Internal energy of a particle per reference volume (J/m^Dim).
    auto energy(auto&& p, const auto& tau) const {
        if constexpr (viscous)
            return p[field::internal_energy{}] * p[symbols::m] / p[symbols::V];
        else
            return -tau(0, 0) / constant<std::remove_cvref_t<decltype(tau(0, 0))>>(gamma - 1);
    }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        const T d = L.trace(), J = constant<T>(1) + d * dt;
        const T share = detail::power(J, 1 - gamma);
        if constexpr (!viscous)
            return p[symbols::sigma] * share;
        else {
            auto& e = p[field::internal_energy{}];
            const T by_mass = viscous_pressure_by_density(d, T(e));
            e = e * share - by_mass * d * dt;
            const T rho0 = p[symbols::m] / p[symbols::V];
            return detail::isotropic<Tensor>(-rho0 * (constant<T>(gamma - 1) * e + by_mass));
        }
    }

  private:
    /// q/rho.
    template <class T> T viscous_pressure_by_density(const T& d, const T& e) const {
        using std::sqrt;
        const T zero = constant<T>(0), rate = select(d < zero, -d, zero) * constant<T>(viscosity.length);
        const T c = sqrt(constant<T>(gamma * (gamma - 1)) * e);
        return rate *
               (constant<T>(viscosity.quadratic * viscosity.quadratic) * rate + constant<T>(viscosity.linear) * c);
    }
};
/// Without artificial viscosity.
using ideal_gas = ideal_gas_of<no_viscosity>;
/// With artificial viscosity, for shocks.
using shocked_gas = ideal_gas_of<artificial_viscosity>;

}  // namespace tamis
