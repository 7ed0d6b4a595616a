#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

/// A manufactured solution of finite strain in a box, 0 <= X_i <= 1 m: every axis moves by itself,
///
///     u_i(X, t) = A sin(pi X_i) sin(c pi t + phase_i),    c^2 = E/rho0
///
/// X the place in the undeformed body. What is missing to Newton's law for a neo-Hookean solid is given to it as a body
/// force (Wallstedt & Guilkey 2008, "axis-aligned displacement"; derived in docs/manufactured.md). The walls let the
/// body slide along them, and particles cross cells.
struct manufactured_options {
    int dim = 2;  // 2 or 3
    int cells = 32, per_cell = 2;
    std::string shape = "quadratic", update = "flip", stress = "usl-";
    int order = 2;  // k of xpic and fmpm
    double courant = 0.2, time = 1.75, amplitude = 0.05, poisson = 0.3;
};

struct manufactured_result {
    long steps = 0;
    std::size_t particles = 0;
    std::size_t crossings = 0;  // of particles to other cells
    double wall_seconds = 0;
    /// At the end, over the particles: square root of the mean square, and maximum. Of |x - x_exact|/A and
    /// |v - v_exact|/(A c pi).
    double place_l2 = 0, place_max = 0, velocity_l2 = 0, velocity_max = 0;
    /// Kinetic and stored energy at the end, less the exact one (J/m^(3-Dim)), over the largest kinetic energy.
    double energy_error = 0;
};

namespace manufactured {

inline constexpr double young = 1, density = 1;

/// The exact answer along axis i.
struct answer {
    double amplitude, phase;
    double factor(double t) const { return amplitude * std::sin(std::numbers::pi * t + phase); }
    double displacement(double X, double t) const { return factor(t) * std::sin(std::numbers::pi * X); }
    double velocity(double X, double t) const {
        return amplitude * std::numbers::pi * std::cos(std::numbers::pi * t + phase) * std::sin(std::numbers::pi * X);
    }
    /// F_ii
    double stretch(double X, double t) const {
        return 1 + factor(t) * std::numbers::pi * std::cos(std::numbers::pi * X);
    }
    /// X of what is at x at time t, by Newton's method; A pi < 1, so the way is monotone.
    double start_of(double x, double t) const {
        double X = x;
        for (int k = 0; k < 50; ++k) {
            const double step = (X + displacement(X, t) - x) / stretch(X, t);
            X -= step;
            if (std::abs(step) < 1e-16) break;
        }
        return X;
    }
};
/// Phases as in the literature: 0 and pi in 2D, thirds of 2 pi in 3D, where the body starts deformed.
inline double phase(int dim, int axis) { return axis * (dim == 2 ? 1. : 2. / 3) * std::numbers::pi; }

}  // namespace manufactured

/// What of a composition is compiled: names as in `manufactured_options`.
struct manufactured_composition {
    std::string shape, update, stress;
};
std::vector<manufactured_composition> manufactured_compositions(int dim);

/// Runs the scene. Throws `std::invalid_argument` for options that make no sense or a composition that is not compiled,
/// `tamis::error` if the run fails.
manufactured_result run_manufactured(const manufactured_options& options);
