#pragma once
#include "scene.hpp"

/// A scene as a program: options from the command line, the run, a table on stdout, files if asked for. The exit code:
/// 0, 1 if the run failed, 2 if an option makes no sense.
int run_scene(const bar_scene& scene, int argc, const char* const* argv);
