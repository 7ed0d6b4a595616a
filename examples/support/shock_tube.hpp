#pragma once
#include "tube.hpp"

#include <string>

/// What can be chosen of a shock tube besides the gases.
struct shock_tube_options {
    tube set;
    std::string shape = "quadratic", update = "flip", stress = "usavg-";
    /// Terms k of XPIC and FMPM; FLIP's share of a blend.
    int order = 2;
    double alpha = 0.99;
    /// Files of the particles with the exact answer, and of all numbers; empty: none.
    std::string csv, summary;
    bool has_order() const { return update == "xpic" || update == "fmpm"; }
    /// Gases of equal density and the given ratio of pressures, up to the time when the shock has come as far as Sod's.
    void pressure_ratio(double ratio);
};
using shock_tube_result = tube_result;

/// Runs the tube with the composition that the options name, and measures the result against the exact one. Throws
/// `unusable_option` for a name that is not known and `tamis::error` if the run fails.
shock_tube_result run_shock_tube(const shock_tube_options& options);
/// The JSON of all numbers.
std::string summary_of(const shock_tube_options& options, const shock_tube_result& result);
