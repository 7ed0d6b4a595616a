#pragma once
#include <functional>
#include <string>
#include <vector>

/// A composition's critical Courant numbers as they are shipped (tamis/run/critical_table.hpp).
struct map_row {
    std::string shape, stress, update;
    /// Of xpic and fmpm, else 0.
    int k = 0;
    int per_cell = 2;
    double inner = 0, free_end = 0;

    /// "FLIP", "FMPM(4)"
    std::string update_title() const;
};
std::vector<map_row> shipped_map();

/// A free bar at one place on the grid: the critical number by the step's eigenvalues, and by bisection over runs.
struct run_check {
    std::string composition;
    int per_cell = 2;
    double offset = 0;
    double predicted = 0, by_runs = 0;
};
using map_progress = std::function<void(std::size_t done, std::size_t all, const std::string& what)>;
std::vector<run_check> checks_by_runs(bool full, const map_progress& tell);

/// What theory says, and what the analysis finds.
struct known_value {
    std::string what, theory;
    double exact = 0, found = 0, within = 0;
    bool met() const;
};
std::vector<known_value> known_values();

/// The standing wave by FMPM(4) and linear functions, and what a light node at a free end does: by stress order.
struct cure {
    std::string stress;
    /// Relative errors after one period of 50 cells, 2 particles per cell, Courant number 0.1, held.
    double velocity_error = 0, strain_error = 0, energy_change = 0;
    /// Of a free bar whose lightest node has 1e-4 of an inner one's mass; Courant number.
    double critical = 0;
    /// Of a step of the wave, over USL-'s.
    double time_ratio = 0;
};
std::vector<cure> cures();
