#pragma once
#include <string>
#include <vector>

/// What can be chosen of the driven gas: a tube, 0 <= x <= 1 m, its left end fixed, its right end at speed v0 sin(10
/// t). rho0 = p0 = 1; c^2 = gamma.
struct gas_wave_options {
    int cells = 75, per_cell = 2;
    std::string shape = "linear", update = "flip", stress = "usl-", particles = "moving";
    /// "motion": the rate of pressure that goes with the particles; "admpm": that of a fixed point, for all.
    std::string rate = "motion";
    /// "sine", or "smooth": v0 sin^3(10 t), whose wave has no kink at its front.
    std::string drive = "sine";
    /// Terms k of XPIC and FMPM; FLIP's share of a blend.
    int order = 2;
    double alpha = 0.99;
    double gamma = 1, amplitude = 0.01, courant = 0.1;
    /// When errors are measured; the last one is the end (s).
    std::vector<double> times{0.5, 1, 1.4};
    /// Files of the particles at the end, with the exact answer, and of all numbers; empty: none.
    std::string csv, summary;
    bool has_order() const { return update == "xpic" || update == "fmpm"; }
};

/// Errors at the particles, relative to v0 and to the pressure gamma p0 v0/c: root of the mean square, and maximum.
struct gas_wave_record {
    double time = 0;
    /// Against the acoustic answer, which leaves out what is of second order in v0/c.
    double velocity_l2 = 0, velocity_max = 0, pressure_l2 = 0, pressure_max = 0;
    /// Against the exact answer for any amplitude; until the wave comes to the fixed end, afterwards NaN.
    double velocity_l2_finite = 0;
    double kinetic = 0, internal = 0, boundary_work = 0;
};
struct gas_wave_particle {
    double x, velocity, pressure;
};
struct gas_wave_result {
    std::vector<gas_wave_record> records;
    std::vector<gas_wave_particle> particles;  // at the end, in the order of x
    long steps = 0;
    double dt = 0;  // of the last step
    double wall_seconds = 0;
    double mass = 0, momentum = 0;
};

/// Exact answers of the driven gas.
struct gas_wave_exact {
    double gamma, amplitude;
    bool smooth;
    double wave_speed() const;
    /// Speed of the driven end.
    double drive(double t) const;
    /// Linear acoustics, with all images.
    double velocity(double x, double t) const;
    double pressure(double x, double t) const;
    /// For any amplitude, before the wave comes to the fixed end or steepens to a shock: a simple wave. The speed is
    /// given at the fixed place x = 1, as it is on the grid. Along a line of speed (gamma + 1)/2 u - c0 the velocity u
    /// is the same (Riemann's invariant u + 2 (c - c0)/(gamma - 1) = 0).
    double finite_velocity(double x, double t) const;
};

/// Throws `unusable_option` for a name that is not known and `tamis::error` if the run fails.
gas_wave_result run_gas_wave(const gas_wave_options& options);
/// One line for each thing, and the JSON of all.
std::string summary_of(const gas_wave_options& options, const gas_wave_result& result);
