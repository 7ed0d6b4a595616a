#pragma once
#include "riemann.hpp"

#include <cstddef>
#include <vector>

/// A shock tube, 0 <= x <= 1 m: two ideal gases at rest meet at 1/2. By default Sod's.
struct tube {
    double gamma = 1.4;
    riemann::state left{1, 0, 1}, right{0.125, 0, 0.1};
    int cells = 200, per_cell = 4;
    double time = 0.2, courant = 0.2;
    double linear = 0.5, quadratic = 2;  // artificial viscosity
};

struct tube_particle {
    double x, density, velocity, pressure, energy;
};
struct tube_result {
    std::vector<tube_particle> particles;  // in the order of x
    std::size_t left_count = 0;            // of the left gas
    long steps = 0;
    double wall_seconds = 0;
    double energy_start = 0, energy_end = 0, boundary_work = 0, momentum = 0;
    double density_l1 = 0, velocity_l1 = 0, pressure_l1 = 0;  // integrals of |error| over the tube
    double contact = 0, shock = 0;                            // places
    double contact_off = 0, shock_off = 0;                    // from where they should be, in cells
    riemann::state behind_shock{}, behind_contact{};          // means over the middle of both plateaus
};

/// Errors, plateaus and fronts against the exact answer.
void measure(const tube& set, tube_result& result);
