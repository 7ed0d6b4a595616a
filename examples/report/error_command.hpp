#pragma once
#include "results_file.hpp"
#include "report_scene.hpp"

#include <CLI/CLI.hpp>

#include <atomic>
#include <functional>

/// Measures a configuration: its errors, and run times until there are enough of them, or one where `stop` is true. A
/// run that fails is told as one.
measurement measure(const report_scene& scene, const configuration& what, const std::atomic<bool>& stop);

/// Runs what is not in the file yet, the quick lists or the full ones. Stops early when `stop` is true. `tell(done,
/// all, seconds_left, what)` is called before each run. True if all runs are done.
bool run_all(const std::vector<report_scene>& scenes, bool full, results_file& results, const std::atomic<bool>& stop,
             const std::function<void(std::size_t, std::size_t, double, const configuration&)>& tell);

/// `tamis_report error`, of the scenes that `scenes` makes when it is called for. The exit code: 0, 1 if something
/// failed, 130 if it was interrupted.
void add_error_command(CLI::App& app, int& exit_code, std::vector<report_scene> (*scenes)());
