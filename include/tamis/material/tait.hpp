#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/power.hpp>
#include <tamis/core/tensor.hpp>

#include <cmath>

namespace tamis {

/// Slightly compressible fluid (Tait; Murnaghan's form, Cole, *Underwater Explosions*, 1948), without viscosity:
///
///     p = (K/n) ((rho/rho0)^n - 1),    tau = -p V/V0 = -p rho0/rho
///
/// `bulk` is K (Pa), the bulk modulus at rho0; `exponent` is n (water: 7). rho0 is a particle's mass over its volume
/// V0. `density` (kg/m^Dim) is that of the particles `make_body` makes. Stores the density. Pressure can be negative:
/// the fluid does not tear.
struct tait {
    /// K (Pa), n, density of the particles that `make_body` makes (kg/m^Dim).
    double bulk, exponent = 7, density;
    using on_particles = fields<const field::density, const field::mass, const field::volume>;
    static constexpr std::string_view name = "tait";

    void check() const {
        if (!(bulk > 0 && std::isfinite(bulk)))
            throw error(detail::sentence(name, ": the bulk modulus is ", bulk, "; give a positive number"));
        if (!(exponent > 0 && std::isfinite(exponent)))
            throw error(detail::sentence(name, ": the exponent is ", exponent, "; give a positive number (water: 7)"));
        if (!(density > 0 && std::isfinite(density)))
            throw error(detail::sentence(name, ": the density is ", density, "; give a positive number"));
    }
    void check(auto p) const {
        if (!(p[symbols::rho] > 0))
            throw error(detail::sentence("its density is ", p[symbols::rho],
                                         "; give a positive one, and take steps short enough to keep it so"));
    }
    /// Speed of sound (m/s), at rest and of a particle.
    double wave_speed() const { return std::sqrt(bulk / density); }
    double wave_speed_at(auto p, int) const {
        using namespace symbols;
        const double rest = detail::to_double(p[m] / p[V]);
        return std::sqrt(bulk / rest * std::pow(detail::to_double(p[rho]) / rest, exponent - 1));
    }
    /// Pressure (Pa) at rho/rho0.
    template <class T> T pressure_at(const T& ratio) const {
        return constant<T>(bulk / exponent) * (detail::power(ratio, exponent) - constant<T>(1));
    }
    /// Work that compressed a particle from rho0 (J/m^Dim of reference volume).
    double energy(auto&& p, const auto&) const {
        using namespace symbols;
        const double J = detail::to_double(p[m] / (p[V] * p[rho])), n = exponent;
        const double cold = n == 1 ? -std::log(J) : std::expm1((1 - n) * std::log(J)) / (n - 1);
        return bulk / n * (cold + J - 1);
    }
    template <class Tensor> Tensor stress(auto p, const Tensor&, auto) const {
        using namespace symbols;
        using T = typename Tensor::Scalar;
        const T ratio = p[rho] * p[V] / p[m];
        return detail::isotropic<Tensor>(-pressure_at(ratio) / ratio);
    }
};

}  // namespace tamis
