#include "report_scene.hpp"
#include "run_by_names.hpp"

#include "support/bi_material.hpp"

namespace {

outcome run_one(const configuration& what) {
    bi_material_options o;
    o.set.young = o.set.density = 10;
    o.set.amplitude = 1e-6;
    give(o, what);
    const bi_material_result r = run_bi_material(o);
    outcome found = cost_of(r, r.particle_count);
    put_errors(found, r.velocity_l2, r.strain_l2);
    found.energy_error = r.energy_gain;
    return found;
}

}  // namespace

report_scene bi_material_report_scene() {
    report_scene all;
    all.name = "bi_material";
    all.title = "Pulse at the joint of two bars";
    all.about =
        "A smooth pulse of velocity meets a second bar that is ten times as stiff and ten times as dense. Part of it "
        "comes back and part goes on, by the theory of impedances; the run ends when both parts have left the joint.";
    all.error_is =
        "Error: square root of the energy of the difference to the exact answer, over that of the answer; taken at the "
        "particles at the end.";
    const std::vector<int> cells{50, 100, 200, 400};
    add(all.quick, all.name,
        {{"linear", "quadratic"},
         {{"flip", 0}, {"fmpm", 2}, {"fmpm", 4}},
         {"usl-"},
         {"moving", "held"},
         {2},
         {0.1, 0.2, 0.5},
         cells});
    add(all.full, all.name,
        {{"linear", "quadratic"},
         {{"flip", 0}, {"fmpm", 1}, {"fmpm", 2}, {"fmpm", 4}, {"fmpm", 8}},
         {"usl-"},
         {"moving", "held"},
         {1, 2, 4},
         {0.05, 0.1, 0.2, 0.5},
         {50, 100, 200, 400, 800}});
    add_admpm(all, {"moving", "held"}, 2, cells, {0.1, 0.01});
    all.run = run_one;
    all.shown = [](const configuration& c) {
        return c.particles == "moving" && c.per_cell == 2 && c.order != 1 && c.order != 8 &&
               (is_admpm(c) ? c.courant == 0.01 : c.courant == 0.2);
    };
    return all;
}
