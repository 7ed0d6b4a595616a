#pragma once
#include "two_bars.hpp"

#include <string>

/// What can be chosen of the two bars besides their materials.
struct bi_material_options {
    two_bars set;
    /// "euler", ADMPM's order, goes with linear functions and flip.
    std::string shape = "quadratic", update = "flip", stress = "usl-", particles = "moving";
    int order = 2;        // terms of FMPM
    std::string summary;  // file of all numbers; empty: none
    bool has_order() const { return update == "fmpm"; }
};
using bi_material_result = two_bars_result;

/// Runs the composition that the options name. Throws `unusable_option` for a name that is not known, and for bars
/// whose wave speeds are so unlike that a pulse would be cut by an end or by the cells; `tamis::error` if the run
/// fails.
bi_material_result run_bi_material(const bi_material_options& options);
/// The JSON of all numbers.
std::string summary_of(const bi_material_options& options, const bi_material_result& result);
