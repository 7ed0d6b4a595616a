#pragma once
#include <cstddef>
#include <string>
#include <vector>

/// What the Taylor-Galerkin scenes have in common.
struct galerkin_options {
    int cells = 100, per_cell = 2;
    std::string shape = "linear", mass = "fmpm", profile;
    /// Terms k of the full mass matrix.
    int order = 4;
    /// dt = time/steps; steps 0 takes them from the Courant number.
    long steps = 0;
    double courant = 0.4, time = 1;

    /// Waves run at 1 m/s through 1 m.
    long step_count() const;
};

/// An unknown at the end of a run: errors against the exact answer, of particles by l1, l2 and max, of nodes by
/// node_l2; how far it goes beyond the exact answer's range; its integral, and what came in through the ends.
struct galerkin_unknown {
    std::string name;
    double l1 = 0, l2 = 0, max = 0, node_l2 = 0, overshoot = 0;
    double total_initial = 0, total_final = 0, gain = 0;
};
struct galerkin_point {
    double x;
    std::vector<double> value, exact;
};
struct galerkin_result {
    long steps = 0;
    double dt = 0, wall_seconds = 0;
    std::size_t bytes_per_particle = 0, bytes_per_node = 0;
    std::vector<galerkin_unknown> unknowns;
    std::vector<galerkin_point> particles;  // in the order of x
};
