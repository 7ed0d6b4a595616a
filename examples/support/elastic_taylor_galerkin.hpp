#pragma once
#include "galerkin.hpp"

/// An elastic bar in (stress, velocity), E = rho = 1, held at both ends: the small shock (the left half starts
/// compressed, strain -A), or its first mode (velocity A sin(pi x)).
struct elastic_taylor_galerkin_options : galerkin_options {
    double amplitude = 0.001;
    elastic_taylor_galerkin_options() {
        profile = "shock";
        cells = 400;
        time = 0.4;
    }
};
/// Energies are integrals of stress^2/(2 E) + rho velocity^2/2 (J). Errors and overshoot are relative to half the
/// amplitude for the shock, to the amplitude for the mode.
struct elastic_taylor_galerkin_result : galerkin_result {
    double energy_initial = 0, energy_final = 0;
    /// Of the shock: the fronts' speed, and how far the strain goes beyond the plateau, over the plateau.
    double front_speed = 0, overshoot = 0;
};
/// Throws `tamis::error` if the run fails.
elastic_taylor_galerkin_result run_elastic_taylor_galerkin(const elastic_taylor_galerkin_options& options);
