#include "report_scene.hpp"
#include "run_by_names.hpp"

#include "support/manufactured.hpp"

namespace {

outcome run_one(int dim, const configuration& what) {
    manufactured_options o;
    o.dim = dim;
    give(o, what);
    const manufactured_result r = run_manufactured(o);
    outcome found = cost_of(r, r.particles);
    put_errors(found, r.velocity_l2, r.place_l2);
    found.energy_error = r.energy_error;
    return found;
}

/// What is compiled, with the orders k of series that the report looks at.
void add_compiled(std::vector<configuration>& to, const report_scene& scene, const std::vector<int>& orders,
                  const std::vector<int>& per_cells, const std::vector<double>& courants,
                  const std::vector<int>& cells) {
    for (const auto& one : manufactured_compositions(scene.dim)) {
        if (one.stress == "euler") continue;  // ADMPM's, with steps of its own
        const bool series = one.update == "xpic" || one.update == "fmpm";
        for (const int k : series ? orders : std::vector<int>{0})
            if (one.update != "xpic" || k == 2)
                add(to, scene.name,
                    {{one.shape}, {{one.update, k}}, {one.stress}, {"moving"}, per_cells, courants, cells});
    }
}

}  // namespace

report_scene manufactured_report_scene(int dim) {
    report_scene all;
    const std::string axes = std::to_string(dim) + "D";
    all.name = "manufactured_" + std::to_string(dim) + "d";
    all.title = "Manufactured solution, " + axes;
    all.dim = dim;
    all.about =
        "A neo-Hookean block is pushed to and fro in its box by a body force made such that u_i = A sin(pi X_i) "
        "sin(c pi t + phase_i), A = 0.05, is the exact motion: strains up to 0.16, particles cross cells, walls let "
        "the block slide. Nearly one period, until ct = 1.75. Nothing is linear here, so it shows what the other "
        "scenes "
        "hide: linear functions do not converge once particles cross cells.";
    all.error_is =
        "Error: root of the mean square of displacement and velocity errors over the particles at the end, each "
        "relative "
        "to its amplitude, A and A c pi. Energy: against the exact one, relative to the largest kinetic energy.";
    all.other_is = "displacement";
    if (dim == 2) {
        add_compiled(all.quick, all, {2, 4}, {2}, {0.2, 0.5}, {8, 16, 32, 48});
        add_compiled(all.full, all, {1, 2, 4, 8}, {2, 3}, {0.05, 0.1, 0.2, 0.5}, {8, 16, 32, 64});
        add_compiled(all.full, all, {1, 2, 4, 8}, {2}, {0.2, 0.5}, {128});
        add_admpm(all, {"moving"}, 2, {8, 16, 32}, {0.1, 0.01});
    } else {
        add_compiled(all.quick, all, {2}, {2}, {0.2, 0.5}, {6, 8, 12, 16});
        add_compiled(all.full, all, {1, 2, 4}, {2, 3}, {0.2, 0.5}, {6, 12, 24});
        add_compiled(all.full, all, {1, 2, 4}, {2}, {0.2, 0.5}, {36});
        add_admpm(all, {"moving"}, 2, {6, 8, 12}, {0.1, 0.01});
    }
    all.run = [dim](const configuration& what) { return run_one(dim, what); };
    all.shown = [](const configuration& c) {
        return c.per_cell == 2 && c.order != 1 && c.order != 8 && (is_admpm(c) ? c.courant == 0.01 : c.courant == 0.2);
    };
    return all;
}
