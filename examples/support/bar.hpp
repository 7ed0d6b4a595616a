#pragma once
#include "front.hpp"
#include "options.hpp"

#include <cstddef>
#include <vector>

/// Energies of the bar at a time (J), and the work that its ends have done.
struct bar_energy {
    double t, kinetic, elastic, boundary_work;
    double total() const { return kinetic + elastic; }
};

/// What a run gives.
struct bar_result {
    long steps = 0;
    double dt = 0;
    /// Time of the stepping alone, without records (s).
    double wall_seconds = 0;
    std::size_t bytes_per_particle = 0, bytes_per_node = 0;
    /// At the end, in the order of x.
    std::vector<bar_particle> particles;
    /// At the beginning, at every record, at the end.
    std::vector<bar_energy> energy;
    double mass = 0, momentum = 0;
    /// Of scenes with fronts, at about 100 times.
    std::vector<front_places> fronts;
};

/// Errors at the particles against the exact answer at their places and at the end time: square root of the mean
/// square, and maximum; relative to the scene's velocity and strain.
struct bar_errors {
    double velocity_l2, velocity_max, strain_l2, strain_max;
};
bar_errors errors_of(const bar_scene& scene, const bar_options& options, const bar_result& result);

/// Runs the scene with the composition that the options name. Throws `unusable_option` if the build leaves the
/// composition out (TAMIS_QUICK, TAMIS_SCENES_FLOAT), or if an output cannot be written; `tamis::error` if the run
/// fails.
bar_result run_bar(const bar_scene& scene, const bar_options& options);

/// Has this build the shape, motion and precision that the options name?
bool is_built(const bar_options& options);

/// A run with one shape, motion and precision: each of the twelve is compiled by itself, with its 30 updates and
/// stress orders.
template <class Shape, class Motion, class Real>
bar_result run_bar_with(const bar_scene& scene, const bar_options& options);
