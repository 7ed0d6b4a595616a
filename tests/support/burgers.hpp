#pragma once
#include <tamis/conservation/law.hpp>

/// A user's conservation law: u_t + (u^2/2)_x = 0.
struct burgers {
    static constexpr int unknowns = 1;
    template <class State> State flux(const State& u, int) const {
        State f;
        f[0] = tamis::constant<typename State::Scalar>(0.5) * u[0] * u[0];
        return f;
    }
    double wave_speed(const auto& u) const { return std::abs(u[0]); }
};
