#pragma once
#include "galerkin.hpp"

/// A profile is carried once through the domain, u_t + u_x = 0 on 0 <= x <= 1: a sine wave, or a step up and down,
/// u = 1 for 1/4 < x < 3/4. Ends: periodic, or open (the profile comes in through the left one as well).
struct advection_options : galerkin_options {
    std::string ends = "periodic";
    advection_options() { profile = "sine"; }
};
using advection_result = galerkin_result;
/// Throws `tamis::error` if the run fails.
advection_result run_advection(const advection_options& options);
/// The exact answer.
double advected(const std::string& profile, double x, double t);
