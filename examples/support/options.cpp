#include "options.hpp"
#include "ranges.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

namespace {

constexpr double most_steps = 1e10;

/// One of several names.
CLI::Validator one_of(const std::vector<std::string>& names) {
    std::string list;
    for (const auto& name : names) list += (list.empty() ? "" : name == names.back() ? " or " : ", ") + name;
    return {[names, list](std::string& given) {
                return std::count(names.begin(), names.end(), given) > 0 ? std::string()
                                                                         : "'" + given + "' is unknown; give " + list;
            },
            list, "one_of"};
}
/// A finite number above 0, at most `most`.
CLI::Validator positive(double most = 1e300) {
    return {[most](std::string& given) {
                double value = 0;
                if (!CLI::detail::lexical_cast(given, value) || !std::isfinite(value))
                    return "'" + given + "' is not a number";
                if (!(value > 0)) return given + " is not positive";
                if (value > most) return given + " is too large; give at most " + CLI::detail::to_string(most);
                return std::string();
            },
            "", "positive"};
}

}  // namespace

bool read_options(bar_options& o, const bar_scene& scene, int argc, const char* const* argv) {
    CLI::App app(scene.about, scene.name);
    app.option_defaults()->always_capture_default();
    app.add_option("--cells", o.cells, "Cells of the grid along the bar")->check(whole_from(1, 1048576));
    app.add_option("--per-cell", o.per_cell, "Particles per cell")->check(whole_from(1, 1000));
    app.add_option("--shape", o.shape, "Shape functions")->check(one_of({"linear", "quadratic", "cubic"}));
    app.add_option("--update", o.update, "Particle update")->check(one_of({"pic", "flip", "blend", "xpic", "fmpm"}));
    app.add_option("--order", o.order, "Terms k of xpic and fmpm; the other updates have no order")
        ->check(whole_from(1, 1000));
    app.add_option("--alpha", o.alpha, "Share of FLIP in a blend, 0 to 1")->check(number_from(0, 1));
    app.add_option("--stress", o.stress, "When the particles are strained")
        ->check(one_of({"usf", "usl-", "usl+", "usavg-", "usavg+", "euler"}));
    app.add_option("--boundary", o.boundary, "How conditions enter the full mass matrix of fmpm")
        ->check(one_of(
            {"incremental", "lumped", "velocity", "combined", "unlumped1", "unlumped2", "partial", "collected"}));
    app.add_option("--particles", o.particles, "Do particles move with the material?")
        ->check(one_of({"moving", "held"}));
    auto* steps = app.add_option("--steps", o.steps, "Number of steps, dt = T/N")
                      ->check(whole_from(1, static_cast<long>(most_steps)));
    steps->default_str("from --courant");
    auto* courant = app.add_option("--courant", o.courant, "c dt/h, rounded down so that T is a whole number of steps");
    courant->check(positive(1))->excludes(steps);
    app.add_option("--time", o.time, "End time T (s)")->check(positive());
    app.add_option("--amplitude", o.amplitude, scene.amplitude_is)->check(positive());
    app.add_option("--csv", o.csv, "Folder for tables of particles, nodes and energies");
    app.add_option("--dump", o.dump, "File for all values of all nodes and particles, for debugging");
    auto* every = app.add_option("--every", o.every, "Steps between two records of --csv and --dump");
    every->check(whole_from(1, static_cast<long>(most_steps)))->default_str("about 20 records");
    app.add_option("--summary", o.summary, "File for the results, JSON");
    app.add_option("--threads", o.threads, "Threads; 1: serial")->check(whole_from(1, 1024));
    app.add_option("--precision", o.precision, "Numbers")->check(one_of({"float", "double"}));
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::fputs(app.help().c_str(), stdout);
        return false;
    } catch (const CLI::ParseError& e) {
        throw bad_option(e.what());
    }
    for (const auto* path : {&o.csv, &o.dump, &o.summary})
        if (path->empty() && app.count(path == &o.csv ? "--csv" : path == &o.dump ? "--dump" : "--summary") > 0)
            throw bad_option("an output has an empty name; give a folder for --csv, a file for --dump and --summary");
    std::vector<std::filesystem::path> outputs;
    for (const auto* path : {&o.csv, &o.dump, &o.summary})
        if (!path->empty()) outputs.push_back(std::filesystem::absolute(*path).lexically_normal());
    std::sort(outputs.begin(), outputs.end());
    if (std::adjacent_find(outputs.begin(), outputs.end()) != outputs.end())
        throw bad_option("two of --csv, --dump and --summary have the same name; give each one of its own");
    if (o.boundary != "incremental" && o.update != "fmpm")
        throw bad_option("--boundary: methods differ for a full mass matrix only; give --update fmpm, or leave it out");
    // Energies go with its square.
    const double least = o.precision == "float" ? 1e-15 : 1e-150;
    if (o.amplitude < least)
        throw bad_option("--amplitude: " + CLI::detail::to_string(o.amplitude) + " is too small for numbers in " +
                         o.precision + "; give at least " + CLI::detail::to_string(least));
    const double needed = o.time * bar_scene::wave_speed * o.cells / (o.courant * bar_scene::length);
    if (o.steps == 0 && !(needed <= most_steps))
        throw bad_option("--courant, --time: they ask for " + CLI::detail::to_string(needed) +
                         " steps; at most 1e10 are possible");
#if !defined(_OPENMP)
    if (o.threads > 1)
        throw bad_option(
            "--threads: this program was compiled without OpenMP, so it runs serially; leave the option out, "
            "or compile with OpenMP");
#endif
    return true;
}

long steps_of(const bar_options& o) {
    if (o.steps > 0) return o.steps;
    const double needed = o.time * bar_scene::wave_speed * o.cells / (o.courant * bar_scene::length);
    // A Courant number that divides the time must not get a step more by round-off.
    return std::max(1L, static_cast<long>(std::ceil(needed * (1 - 1e-12))));
}

long record_every(const bar_options& o) { return o.every > 0 ? o.every : std::max(1L, (steps_of(o) + 19) / 20); }
