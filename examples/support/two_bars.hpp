#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>

/// A bar of two elastic materials, 0 <= x <= 1 m, that meet at 1/2. A pulse of velocity comes from the left, where
/// E = rho = 1 and c = 1; part of it goes on and part goes back.
struct two_bars {
    /// E and rho of the right half; its impedance is sqrt(E rho).
    double young = 100, density = 100;
    int cells = 400, per_cell = 2;
    double courant = 0.2, amplitude = 1e-4;

    double speed() const { return std::sqrt(young / density); }
    double impedance() const { return std::sqrt(young * density); }
    /// By theory, over the pulse's own amplitude.
    double reflected() const { return (1 - impedance()) / (1 + impedance()); }
    double transmitted() const { return 2 / (1 + impedance()); }
};

struct two_bars_result {
    double reflected = 0, transmitted = 0;  // amplitudes over that of the pulse, by least squares
    /// Largest velocity that neither pulse explains, over the pulse's amplitude: left and right.
    double rest_left = 0, rest_right = 0;
    double energy_gain = 0;  // relative
    /// Energies of the differences to d'Alembert's answer, by velocity and by strain, over half the energy of the
    /// answer, as square roots.
    double velocity_l2 = 0, strain_l2 = 0;
    long steps = 0;
    double wall_seconds = 0;
    std::size_t particle_count = 0;
};

/// The pulse of length 1/5, s from its tail to its head.
inline double pulse(double s) {
    const double part = std::sin(std::numbers::pi * s / 0.2);
    return s > 0 && s < 0.2 ? part * part : 0;
}
