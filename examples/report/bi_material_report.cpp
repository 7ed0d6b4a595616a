#include "report_scene.hpp"

#include "support/bi_material.hpp"

#include <cmath>

namespace {

outcome run_one(const configuration& what) {
    bi_material_options o;
    o.set.young = o.set.density = 10;
    o.set.amplitude = 1e-6;
    o.set.cells = what.cells;
    o.set.per_cell = what.per_cell;
    o.shape = what.shape;
    o.update = what.update;
    o.order = what.order > 0 ? what.order : 1;
    o.particles = what.particles;
    o.set.courant = what.courant;
    const bi_material_result r = run_bi_material(o);
    outcome found;
    found.error_velocity = r.velocity_l2;
    found.error_other = r.strain_l2;
    found.error = std::sqrt((r.velocity_l2 * r.velocity_l2 + r.strain_l2 * r.strain_l2) / 2);
    found.energy_error = r.energy_gain;
    found.seconds = r.wall_seconds;
    found.steps = r.steps;
    found.particle_count = r.particle_count;
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
    all.run = run_one;
    all.shown = [](const configuration& c) {
        return c.particles == "moving" && c.per_cell == 2 && c.courant == 0.2 && c.order != 1 && c.order != 8;
    };
    return all;
}
