#pragma once
#include <filesystem>
#include <vector>

/// ADMPM's driven bar by hand (by_hand_1d.hpp), compiled by itself: with -ffast-math, which is not for the library.
namespace by_hand {

struct bar_run {
    int nodes, per_cell;
    double dt;
    long steps, record_every;
    bool moving;
};
/// Does the steps; writes tables of particles and nodes into a folder at the start and after every `record_every` of
/// them, unless it is empty. Velocities of the particles at the end, cell by cell.
std::vector<double> run_bar(const bar_run& run, const std::filesystem::path& folder);

}  // namespace by_hand
