#pragma once
#include "bar.hpp"

#include <iosfwd>

/// The results as JSON text.
std::string summary_of(const bar_scene& scene, const bar_options& options, const bar_result& result);
/// The results as a short table.
void print_table(std::ostream& out, const bar_scene& scene, const bar_options& options, const bar_result& result);
