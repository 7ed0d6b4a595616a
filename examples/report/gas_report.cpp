#include "report_scene.hpp"
#include "run_by_names.hpp"

#include "support/gas_wave.hpp"
#include "support/shock_tube.hpp"

namespace {

outcome run_wave(const configuration& what) {
    gas_wave_options o;
    give(o, what);
    // ADMPM takes the rate of pressure at a fixed point for moving particles too.
    o.rate = is_admpm(what) && what.particles == "moving" ? "admpm" : "motion";
    o.drive = "smooth";
    o.amplitude = 1e-5;
    o.times = {1.4};
    const gas_wave_result r = run_gas_wave(o);
    const gas_wave_record& end = r.records.back();
    outcome found = cost_of(r, r.particles.size());
    put_errors(found, end.velocity_l2, end.pressure_l2);
    found.energy_error = (end.kinetic + end.internal - end.boundary_work) / end.boundary_work;
    return found;
}

outcome run_tube(const configuration& what) {
    shock_tube_options o;
    give(o, what);
    const shock_tube_result r = run_shock_tube(o);
    const double fastest = riemann::solution(o.set.gamma, o.set.left, o.set.right).velocity();
    outcome found = cost_of(r, r.particles.size());
    found.error = found.error_other = r.density_l1 / o.set.left.density;
    found.error_velocity = r.velocity_l1 / fastest;
    found.energy_error = r.energy_end / r.energy_start - 1;
    return found;
}

}  // namespace

report_scene gas_wave_report_scene() {
    report_scene all;
    all.name = "gas_wave";
    all.title = "Sound in a driven gas";
    all.about =
        "An ideal gas (gamma = 1) in a tube: its right end moves with v0 sin^3 10t, its left end is fixed; the sound "
        "has "
        "come back from there when the run ends, at t = 1.4. v0 is 1e-5 of the speed of sound. For moving particles "
        "ADMPM's "
        "way takes the rate of pressure at a fixed point.";
    all.error_is =
        "Error: root of the mean square of velocity and pressure errors over the particles at the end, each relative "
        "to "
        "the amplitude of the sound. Energy: kinetic and internal less the work of the driven end, over that work.";
    all.other_is = "pressure";
    const std::vector<int> cells{38, 75, 150, 300};
    for (auto* list : {&all.quick, &all.full}) {
        const bool full = list == &all.full;
        const std::vector<std::string> stresses{"usl-", "usavg-"}, motions{"moving", "held"};
        const std::vector<double> courants = full ? std::vector<double>{0.1, 0.25, 0.5} : std::vector<double>{0.1, 0.5};
        const std::vector<int> per_cells = full ? std::vector<int>{2, 4} : std::vector<int>{2};
        add(*list, all.name,
            {{"linear"},
             {{"flip", 0}, {"xpic", 2}, {"fmpm", 2}, {"fmpm", 4}},
             stresses,
             motions,
             per_cells,
             courants,
             cells});
        add(*list, all.name,
            {{"quadratic"}, {{"flip", 0}, {"fmpm", 2}, {"fmpm", 4}}, stresses, motions, per_cells, courants, cells});
        if (full)
            add(*list, all.name,
                {{"linear"}, {{"pic", 0}, {"flip", 0}}, {"usf", "usl+"}, motions, per_cells, courants, cells});
    }
    add_admpm(all, {"moving", "held"}, 2, cells);
    all.run = run_wave;
    all.shown = [](const configuration& c) {
        return c.particles == "moving" && c.per_cell == 2 &&
               ((is_admpm(c) && c.courant == 0.01) || (c.stress == "usl-" && c.courant == 0.1));
    };
    return all;
}

report_scene shock_tube_report_scene() {
    report_scene all;
    all.name = "shock_tube";
    all.title = "Shock tube (Sod)";
    all.about =
        "A dense gas at rest and a thin one meet at x = 1/2: a shock, a contact and a rarefaction leave the place. The "
        "gases have artificial viscosity, particles move. ADMPM has no such scene; its "
        "way of stepping is run with the same gases.";
    all.error_is =
        "Error: mean absolute error of the density at the end over the tube, relative to the density of the left gas. "
        "No "
        "scheme is better than first order at a shock.";
    all.other_is = "density";
    const std::vector<int> cells{50, 100, 200, 400};
    const std::vector<std::string> usual{"usl-", "usavg-"};
    add(all.quick, all.name,
        {{"linear"}, {{"flip", 0}, {"fmpm", 2}, {"fmpm", 4}}, usual, {"moving"}, {4}, {0.2, 0.4}, cells});
    add(all.quick, all.name,
        {{"quadratic", "cubic"},
         {{"flip", 0}, {"xpic", 2}, {"fmpm", 2}, {"fmpm", 4}},
         usual,
         {"moving"},
         {4},
         {0.2, 0.4},
         cells});
    // What is compiled: XPIC not with linear functions, all stress orders with quadratic ones only.
    const std::vector<int> many_cells{50, 100, 200, 400, 800}, per_cells{2, 4, 6};
    const std::vector<double> courants{0.1, 0.2, 0.4};
    const std::vector<std::pair<std::string, int>> updates{{"pic", 0},  {"flip", 0}, {"xpic", 2}, {"xpic", 4},
                                                           {"fmpm", 2}, {"fmpm", 4}, {"fmpm", 8}};
    add(all.full, all.name,
        {{"linear"},
         {{"pic", 0}, {"flip", 0}, {"fmpm", 2}, {"fmpm", 4}, {"fmpm", 8}},
         usual,
         {"moving"},
         per_cells,
         courants,
         many_cells});
    add(all.full, all.name,
        {{"quadratic"}, updates, {"usl-", "usavg-", "usf", "usl+"}, {"moving"}, per_cells, courants, many_cells});
    add(all.full, all.name, {{"cubic"}, updates, usual, {"moving"}, per_cells, courants, many_cells});
    add_admpm(all, {"moving"}, 4, cells, {0.1, 0.01});
    all.run = run_tube;
    all.shown = [](const configuration& c) {
        return (is_admpm(c) && c.courant == 0.01) ||
               (c.stress == "usavg-" && c.courant == 0.2 && c.per_cell == 4 && c.order != 8 && c.update != "pic");
    };
    return all;
}
