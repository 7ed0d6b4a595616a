#pragma once
#include "report_scene.hpp"

/// Error against run time of all runs of a scene, colours by update and markers by shape; the Pareto front as a line.
std::string work_precision_svg(const std::vector<measurement>& runs);
/// Error against the number of cells, a line for each family that the scene shows.
std::string convergence_svg(const report_scene& scene, const std::vector<measurement>& runs);
