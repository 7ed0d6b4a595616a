#pragma once
#include "bar.hpp"

#include <iosfwd>

/// Throws `tamis::error`, which says what to do, where a number of the results is none.
void check_measures(const bar_scene& scene, const bar_options& options, const bar_result& result);
/// The results as JSON text.
std::string summary_of(const bar_scene& scene, const bar_options& options, const bar_result& result);
/// The results as a short table.
void print_table(std::ostream& out, const bar_scene& scene, const bar_options& options, const bar_result& result);
