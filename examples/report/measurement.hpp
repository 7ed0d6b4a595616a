#pragma once
#include <cstddef>
#include <string>

/// What a run of the report is made of: a scene, a composition by the names of the scenes' options, and its resolution.
/// Two runs with equal `text()` are the same run.
struct configuration {
    std::string scene, shape = "linear", update = "flip";
    /// k of xpic and fmpm, else 0.
    int order = 0;
    std::string stress = "usl-", boundary = "incremental", particles = "moving";
    int cells = 0, per_cell = 2;
    double courant = 0.1;

    /// The composition: all but cells. Runs of one family differ in resolution only.
    std::string family() const;
    /// All of it.
    std::string text() const { return family() + ' ' + std::to_string(cells); }
    /// For people: "quadratic, FMPM(2), USL-, held, Courant 0.1".
    std::string composition() const;
    bool operator==(const configuration&) const = default;
};
/// "FLIP", "FMPM(2)"
std::string update_title(const configuration& what);
/// ADMPM's own way: linear functions, FLIP, lumped mass, explicit Euler in stress and strain.
bool is_admpm(const configuration& what);

/// What a scene gives once.
struct outcome {
    /// Relative errors; their meaning is the scene's. `error` is what runs are compared by.
    double error = 0, error_velocity = 0, error_other = 0;
    /// Energy at the end less the exact one, relative; NaN where the scene does not say.
    double energy_error = 0;
    /// Of the stepping alone.
    double seconds = 0;
    long steps = 0;
    std::size_t particle_count = 0;
};

/// What was measured of a configuration: errors, and run times of repeats.
struct measurement {
    configuration what;
    outcome found;  // seconds: the median
    double seconds_least = 0, seconds_most = 0;
    int repeats = 0;
    /// Why there is no answer; empty if there is one.
    std::string failure;

    bool has_answer() const { return failure.empty(); }
    double ns_per_particle_step() const {
        return found.seconds * 1e9 / (static_cast<double>(found.steps) * static_cast<double>(found.particle_count));
    }
    /// (most - least)/median of the run time
    double spread() const { return (seconds_most - seconds_least) / found.seconds; }
};
