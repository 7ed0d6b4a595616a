#pragma once
#include "ranges.hpp"
#include "galerkin.hpp"

#include <tamis/observe/atomic_file.hpp>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

/// The command line and the outputs of a Taylor-Galerkin scene.
namespace galerkin {

struct outputs {
    std::string csv, summary;
};

inline void add_options(CLI::App& app, galerkin_options& o, outputs& files, const std::vector<std::string>& profiles) {
    app.option_defaults()->always_capture_default();
    app.add_option("--cells", o.cells, "Cells of the grid")->check(whole_from(4, 1048576));
    app.add_option("--per-cell", o.per_cell, "Particles per cell")->check(whole_from(1, 1000));
    app.add_option("--shape", o.shape, "Shape functions")->check(CLI::IsMember({"linear", "quadratic", "cubic"}));
    app.add_option("--mass", o.mass, "Mass matrix")->check(CLI::IsMember({"lumped", "fmpm"}));
    app.add_option("--order", o.order, "Terms k of fmpm")->check(whole_from(1, 1000));
    app.add_option("--profile", o.profile, "Initial state")->check(CLI::IsMember(profiles));
    auto* steps = app.add_option("--steps", o.steps, "Number of steps, dt = T/N")->check(whole_from(1, 10000000000));
    steps->default_str("from --courant");
    app.add_option("--courant", o.courant, "c dt/h, rounded down so that T is a whole number of steps")
        ->check(number_from(1e-6, 1))
        ->excludes(steps);
    app.add_option("--time", o.time, "End time T (s)")->check(number_from(1e-9, 1e6));
    app.add_option("--csv", files.csv, "File for the particles and the exact answer");
    app.add_option("--summary", files.summary, "File for the results, JSON");
}

inline nlohmann::ordered_json summary_of(const std::string& scene, const galerkin_options& o,
                                         const galerkin_result& r) {
    nlohmann::ordered_json all;
    all["scene"] = scene;
    all["cells"] = o.cells;
    all["per_cell"] = o.per_cell;
    all["shape"] = o.shape;
    all["mass"] = o.mass;
    all["order"] = o.mass == "fmpm" ? nlohmann::ordered_json(o.order) : nlohmann::ordered_json();
    all["profile"] = o.profile;
    all["particle_count"] = r.particles.size();
    all["steps"] = r.steps;
    all["dt"] = r.dt;
    all["time"] = o.time;
    all["courant"] = r.dt * o.cells;
    all["wall_seconds"] = r.wall_seconds;
    all["ns_per_particle_step"] =
        r.wall_seconds * 1e9 / (static_cast<double>(r.steps) * static_cast<double>(r.particles.size()));
    all["bytes_per_particle"] = r.bytes_per_particle;
    all["bytes_per_node"] = r.bytes_per_node;
    for (const galerkin_unknown& u : r.unknowns) {
        all[u.name + "_l1"] = u.l1;
        all[u.name + "_l2"] = u.l2;
        all[u.name + "_max"] = u.max;
        all[u.name + "_node_l2"] = u.node_l2;
        all[u.name + "_overshoot"] = u.overshoot;
        all[u.name + "_total_initial"] = u.total_initial;
        all[u.name + "_total_final"] = u.total_final;
        all[u.name + "_gain"] = u.gain;
    }
    return all;
}

inline void write(const nlohmann::ordered_json& all, const galerkin_result& r, const outputs& files) {
    for (const auto& [name, value] : all.items())
        std::printf("%-24s %s\n", name.c_str(),
                    value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
    if (!files.csv.empty()) {
        tamis::atomic_file file(files.csv);
        file.out().precision(12);
        file.out() << 'x';
        for (const char* kind : {"", "exact_"})
            for (const galerkin_unknown& u : r.unknowns) file.out() << ',' << kind << u.name;
        file.out() << '\n';
        for (const galerkin_point& p : r.particles) {
            file.out() << p.x;
            for (const auto* values : {&p.value, &p.exact})
                for (const double value : *values) file.out() << ',' << value;
            file.out() << '\n';
        }
        file.commit();
    }
    if (!files.summary.empty()) {
        tamis::atomic_file file(files.summary);
        file.out() << all.dump(2) << '\n';
        file.commit();
    }
}

/// run() for an application whose options are these; the program's exit code.
template <class Run> int program(CLI::App& app, int argc, char** argv, const Run& run) {
    CLI11_PARSE(app, argc, argv);
    try {
        run();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), e.what());
        return 1;
    }
    return 0;
}

}  // namespace galerkin
