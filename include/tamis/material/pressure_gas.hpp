#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/power.hpp>
#include <tamis/core/tensor.hpp>

#include <cmath>

namespace tamis {

/// How the pressure of a gas changes.
namespace pressure_rate {

/// As the particles' motion asks for: dp/dt = -gamma p div v along particles that move; at fixed points, where
/// particles are held, dp/dt = -v . grad p - gamma p div v = (gamma - 1) v . grad p - gamma div(p v) (Perez, ADMPM,
/// 2021, Eq. 1.51).
struct by_motion {
    /// Is the flow past moving particles needed?
    static constexpr bool carries_when_moving = false;
};
/// That of fixed points, for moving particles too. Wrong for those, whose v . grad p is counted twice: once by
/// the rate and once by the motion. Offered to reproduce ADMPM, not for use.
struct admpm {
    /// Is the flow past moving particles needed?
    static constexpr bool carries_when_moving = true;
};

}  // namespace pressure_rate

/// Gas without viscosity and conduction of heat, whose entropy is the same everywhere, followed by the rate of its
/// pressure; gamma = 1 is a gas of constant temperature. `density` (kg/m^Dim) and `pressure` (Pa) are those of the
/// state that a particle's volume V0 refers to. `ambient` (Pa) is the pressure around the body, which is taken off:
/// only the difference makes forces. (A uniform pressure has no force inside a body, but linear functions do not see
/// that its particles' volumes change while none of them changes cell: there, give the ambient pressure.)
///
/// Moving particles: p' = p J^-gamma for a change of volume by J = 1 + dt div v in a step, and the Kirchhoff stress is
/// -(p - ambient) V/V0 with V/V0 = (pressure/p)^(1/gamma). Held ones are fixed points in space, so V = V0; forces then
/// leave out rho v . grad v and the change of density, whose parts are of second order in the amplitude like that of
/// v . grad p. Where J is not positive the stress is NaN, which stops a run by `integrate`.
template <class Rate> struct pressure_gas_of {
    /// Ratio of heats, density (kg/m^Dim), pressure of the reference state and ambient pressure (Pa).
    double gamma, density, pressure, ambient = 0;
    using on_particles = fields<field::pressure>;
    /// What the law wants to know of the flow past a particle.
    using carries = field::pressure;
    /// Of moving particles too?
    static constexpr bool carries_when_moving = Rate::carries_when_moving;
    static constexpr std::string_view name = "pressure_gas";

    void check() const {
        if (!(gamma >= 1 && std::isfinite(gamma)))
            throw error(detail::sentence(name, ": gamma is ", gamma, "; give 1 (constant temperature) or more"));
        if (!(density > 0 && std::isfinite(density)))
            throw error(detail::sentence(name, ": the density is ", density, "; give a positive number"));
        if (!(pressure > 0 && std::isfinite(pressure)))
            throw error(detail::sentence(name, ": the pressure is ", pressure, "; give a positive number"));
        if (!std::isfinite(ambient))
            throw error(detail::sentence(name, ": the ambient pressure is ", ambient, "; give a finite number"));
    }
    /// A new particle has the law's pressure.
    void start(auto p) const {
        p[field::pressure{}] = pressure;
        for (int d = 0; d < static_cast<int>(p[symbols::x].size()); ++d) p[symbols::sigma](d, d) = ambient - pressure;
    }
    void check(auto p) const {
        const double now = detail::to_double(p[field::pressure{}]);
        if (!(now > 0 && std::isfinite(now)))
            throw error(detail::sentence("its pressure is ", now,
                                         " Pa; give a gas a positive one, and take steps short enough to keep it so"));
    }
    /// Speed of sound (m/s), at the start.
    double wave_speed() const { return std::sqrt(gamma * pressure / density); }
    /// Work that compressed a particle from `pressure`, less what the ambient pressure did (J/m^Dim of reference
    /// volume).
    double energy(auto&& p, const auto&) const {
        const double now = detail::to_double(p[field::pressure{}]), J = std::pow(now / pressure, -1 / gamma);
        const double work =
            gamma == 1 ? -pressure * std::log(J) : pressure * std::expm1((1 - gamma) * std::log(J)) / (gamma - 1);
        return work + ambient * (J - 1);
    }

    /// Along a particle that moves.
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        auto& now = p[field::pressure{}];
        now = now * detail::power(T(constant<T>(1) + L.trace() * dt), -gamma);
        const T J = detail::power(T(now * constant<T>(1 / pressure)), -1 / gamma);
        return detail::isotropic<Tensor>((constant<T>(ambient) - now) * J);
    }
    /// At a fixed point.
    template <class Tensor> Tensor stress(auto p, const Tensor&, auto dt, const auto& flow) const {
        using T = typename Tensor::Scalar;
        auto& now = p[field::pressure{}];
        now += dt * (constant<T>(gamma - 1) * T(flow.velocity.dot(flow.slope)) - constant<T>(gamma) * flow.flux);
        return detail::isotropic<Tensor>(constant<T>(ambient) - now);
    }
};
/// By the rate that goes with the motion of the particles.
using pressure_gas = pressure_gas_of<pressure_rate::by_motion>;
/// ADMPM's gas: the rate of a fixed point, whether particles move or not.
using admpm_gas = pressure_gas_of<pressure_rate::admpm>;

}  // namespace tamis
