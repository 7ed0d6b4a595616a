#pragma once
#include <CLI/CLI.hpp>

/// `tamis_report stability`: the map of critical Courant numbers, checked by runs, and the extreme cases. The exit
/// code: 0, or 1 if something could not be done. Cases that fail are told in the page; they are results, not errors.
void add_stability_command(CLI::App& app, int& exit_code);
