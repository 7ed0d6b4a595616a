#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/space.hpp>

#include <cmath>
#include <concepts>

namespace tamis {

/// Conservation laws and ends of lines for `taylor_galerkin`.
namespace conservation {

/// The unknowns of a law at a place, as users see them.
template <int Count, class Real> using state = Eigen::Matrix<Real, Count, 1, Eigen::DontAlign>;

}  // namespace conservation

/// A conservation law u_t + div F(u) = 0: a plain struct that says how many `unknowns` it has, what flows along an
/// axis, `flux(u, axis)`, of the type of u (its scalar holds one number or several), and how fast a disturbance runs at
/// most, `wave_speed()` or, where it depends on the state, `wave_speed(u)`.
template <class L>
concept ConservationLaw = requires(const L& law, const conservation::state<L::unknowns, double>& u) {
    { law.flux(u, 0) } -> std::convertible_to<conservation::state<L::unknowns, double>>;
}
&&(
    requires(const L& law) {
        { law.wave_speed() } -> std::convertible_to<double>;
    } ||
    requires(const L& law, const conservation::state<L::unknowns, double>& u) {
        { law.wave_speed(u) } -> std::convertible_to<double>;
    });

namespace conservation {

/// u is carried along with a speed (m/s), that of the axis where there are several: F = c u.
template <int Dim = 1> struct advection {
    static constexpr int unknowns = 1;
    /// c along each axis (m/s).
    double speed[Dim];

    template <class State> State flux(const State& u, int axis) const {
        return constant<typename State::Scalar>(speed[axis]) * u;
    }
    double wave_speed() const {
        double most = 0;
        for (const double c : speed) most = std::max(most, std::abs(c));
        return most;
    }
};

/// A linear elastic bar in (stress, velocity): sigma_t = E v_x, rho v_t = sigma_x.
struct elastic_bar {
    static constexpr int unknowns = 2;
    /// Young's modulus (Pa) and density (kg/m^3).
    double young = 1, density = 1;

    template <class State> State flux(const State& u, int) const {
        using T = typename State::Scalar;
        State f;
        f[0] = constant<T>(-young) * u[1];
        f[1] = constant<T>(-1 / density) * u[0];
        return f;
    }
    double wave_speed() const { return std::sqrt(young / density); }
    void check() const {
        if (!(young > 0 && density > 0 && std::isfinite(young / density)))
            throw error(detail::sentence("elastic_bar: the modulus is ", young, " and the density ", density,
                                         "; give positive numbers"));
    }
};

}  // namespace conservation

namespace detail {

/// The fastest disturbance of a law at a state (m/s).
template <class Law, class State> double wave_speed_at(const Law& law, const State& u) {
    if constexpr (requires { law.wave_speed(u); })
        return static_cast<double>(law.wave_speed(u));
    else
        return static_cast<double>(law.wave_speed());
}
/// A state from what a user's function gives: a vector, or a number where there is one unknown.
template <class State, class Value> State as_state(const Value& value) {
    using real = typename State::Scalar;
    if constexpr (std::is_convertible_v<Value, real>) {
        static_assert(State::SizeAtCompileTime == 1,
                      "tamis: the law has several unknowns; give a vector with a number for each");
        return State(static_cast<real>(value));
    } else {
        static_assert(static_cast<int>(Value::SizeAtCompileTime) == static_cast<int>(State::SizeAtCompileTime),
                      "tamis: a state with another number of unknowns than the law's");
        return State(value.template cast<real>());
    }
}

}  // namespace detail
}  // namespace tamis
