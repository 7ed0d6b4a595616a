#pragma once
#include "scene.hpp"

#include <stdexcept>
#include <string>

/// What the command line of a scene chooses.
struct bar_options {
    int cells, per_cell = 2;
    std::string shape = "linear", update = "flip", stress = "usl-", boundary = "incremental", particles = "moving",
                precision = "double";
    /// Terms k of XPIC and FMPM; FLIP's share of a blend.
    int order = 2;
    double alpha = 0.99;
    /// dt = time/steps; steps 0 takes them from the Courant number.
    long steps = 0;
    double courant, time, amplitude;
    /// Records are made every so many steps; 0: about 20 of them.
    long every = 0;
    int threads = 1;
    /// Where records, the dump and the summary go; empty: nowhere.
    std::string csv, dump, summary;

    explicit bar_options(const bar_scene& scene)
        : cells(scene.cells), courant(scene.courant), time(scene.time), amplitude(scene.amplitude) {}

    bool has_order() const { return update == "xpic" || update == "fmpm"; }
};

/// An option that cannot be used: the program says why in one line and exits with code 2.
class bad_option : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Options of a scene from its command line, checked. False if only help was asked for, and printed. Throws
/// `bad_option`.
bool read_options(bar_options& options, const bar_scene& scene, int argc, const char* const* argv);

/// Number of steps: as asked, or such that dt is the Courant number's, rounded down to a whole part of the time.
long steps_of(const bar_options& options);
/// Number of steps between records.
long record_every(const bar_options& options);
