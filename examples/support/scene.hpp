#pragma once
#include "exact.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>

/// Conditions at the two ends of the bar: both held, the right one at speed sin(omega t) (m/s). One type serves all
/// scenes, so that each composition is compiled once.
struct bar_ends {
    double speed = 0, omega = 0;
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    auto velocity(const auto& at, auto t) const {
        auto u = (at * 0).eval();
        if (at[0] >= 1) u[0] = static_cast<std::remove_cvref_t<decltype(u[0])>>(speed * std::sin(omega * t));
        return u;
    }
};

/// An exact answer and its energy.
struct bar_answer {
    std::function<exact::state(double x, double t)> at;
    std::function<double(double t)> energy;

    template <class Exact> bar_answer(const Exact& exact)
        : at(exact), energy([exact](double t) { return exact.energy(t); }) {}
};

/// A scene: an elastic bar, 0 <= x <= 1 m, E = 1 Pa, rho = 1 kg/m, hence c = 1 m/s. The exact answer at t = 0 is its
/// initial state.
struct bar_scene {
    static constexpr double young = 1, density = 1, wave_speed = 1, length = 1;

    std::string name, about;
    // Defaults of the options.
    int cells;
    double amplitude, time, courant;
    /// What --amplitude is.
    std::string amplitude_is;
    bar_ends (*ends)(double amplitude);
    bar_answer (*exact)(double amplitude);
    /// Errors are relative to this part of the amplitude.
    double scale = 1;
    /// Are there fronts at 1/2 +- t to follow?
    bool fronts = false;
};
