#pragma once
#include "page.hpp"
#include "report_scene.hpp"

/// The report as a page: of each scene the plots, the front, the best runs for given errors, and the observed orders.
/// `facts`: what it was measured on; `complete`: were all runs done? Throws `tamis::error` if gnuplot fails.
page error_page(const std::vector<report_scene>& scenes, const std::vector<measurement>& runs,
                const std::vector<std::vector<std::string>>& facts, bool complete);
