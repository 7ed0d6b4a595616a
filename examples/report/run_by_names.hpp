#pragma once
#include "measurement.hpp"

#include <algorithm>
#include <cmath>

/// Gives a scene's options the parts of a configuration that they have.
template <class Options> void give(Options& options, const configuration& what) {
    const auto resolution = [&](auto& set) {
        set.cells = what.cells;
        set.per_cell = what.per_cell;
        set.courant = what.courant;
    };
    if constexpr (requires { options.set; })
        resolution(options.set);
    else
        resolution(options);
    options.shape = what.shape;
    options.order = std::max(1, what.order);
    if constexpr (requires { options.update; }) options.update = what.update;
    if constexpr (requires { options.stress; }) options.stress = what.stress;
    if constexpr (requires { options.boundary; }) options.boundary = what.boundary;
    if constexpr (requires { options.particles; }) options.particles = what.particles;
}

/// What a run took.
template <class Result> outcome cost_of(const Result& run, std::size_t particle_count) {
    outcome found;
    found.seconds = run.wall_seconds;
    found.steps = run.steps;
    found.particle_count = particle_count;
    return found;
}

/// Errors of velocity and of another field, and the root of their mean square for both.
inline void put_errors(outcome& found, double velocity, double other) {
    found.error_velocity = velocity;
    found.error_other = other;
    found.error = std::sqrt((velocity * velocity + other * other) / 2);
}
