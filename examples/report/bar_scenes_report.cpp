#include "report_scene.hpp"
#include "run_by_names.hpp"

#include "scenes/reflection.hpp"
#include "scenes/shock.hpp"
#include "scenes/standing_wave.hpp"
#include "support/bar.hpp"

#include <cmath>

namespace {

/// Small enough that what moving particles do differently, of the order of the strain, is below all errors.
constexpr double amplitude = 1e-5;

outcome run_one(const bar_scene& scene, const configuration& what) {
    bar_options o(scene);
    give(o, what);
    o.amplitude = amplitude;
    const bar_result r = run_bar(scene, o);
    outcome found = cost_of(r, r.particles.size());
    if (scene.fronts) {
        // The mean of |error|: that of the square is ruled by the few particles beside a jump.
        const auto exact = scene.exact(o.amplitude);
        for (const auto& p : r.particles) {
            const auto right = exact.at(p.x, o.time);
            found.error_velocity += std::abs(p.velocity - right.velocity);
            found.error_other += std::abs(p.strain - right.strain);
        }
        const double all = o.amplitude * scene.scale * static_cast<double>(r.particles.size());
        found.error_velocity /= all;
        found.error_other /= all;
        found.error = (found.error_velocity + found.error_other) / 2;
    } else {
        const bar_errors e = errors_of(scene, o, r);
        put_errors(found, e.velocity_l2, e.strain_l2);
    }
    const double energy = scene.exact(o.amplitude).energy(o.time);
    found.energy_error = (r.energy.back().total() - energy) / energy;
    return found;
}

report_scene base(const bar_scene& scene, const std::string& title, const std::vector<int>& cells) {
    report_scene all;
    all.name = scene.name;
    all.title = title;
    add(all.quick, scene.name,
        {{"linear", "quadratic", "cubic"},
         {{"flip", 0}, {"xpic", 2}, {"fmpm", 2}, {"fmpm", 4}},
         {"usl-", "usavg-"},
         {"moving", "held"},
         {2},
         {0.1, 0.5},
         cells});
    add(all.full, scene.name,
        {{"linear", "quadratic", "cubic"},
         {{"pic", 0}, {"flip", 0}, {"xpic", 2}, {"xpic", 4}, {"fmpm", 2}, {"fmpm", 4}, {"fmpm", 8}},
         {"usl-", "usavg-", "usf", "usl+"},
         {"moving", "held"},
         {2, 4},
         {0.1, 0.25, 0.5},
         cells});
    const sweep other_conditions{{"linear"}, {{"fmpm", 2}}, {"usl-"}, {"moving", "held"},
                                 {2},        {0.1},         cells,    {"velocity", "lumped"}};
    add(all.full, scene.name, other_conditions);
    add_admpm(all, {"moving", "held"}, 2, cells);
    all.run = [scene](const configuration& what) { return run_one(scene, what); };
    all.shown = [](const configuration& c) {
        const bool usual = c.particles == "moving" && c.per_cell == 2 && c.boundary == "incremental";
        return usual &&
               ((is_admpm(c) && c.courant == 0.01) || (c.stress == "usl-" && c.courant == 0.1 && c.order != 8));
    };
    all.error_is =
        "Error: root of the mean square of velocity and strain errors over the particles at the end, each relative to "
        "its amplitude. That is the energy of the difference, relative.";
    return all;
}

}  // namespace

std::vector<report_scene> bar_report_scenes() {
    report_scene wave = base(standing_wave(), "Standing wave", {25, 50, 100, 200});
    wave.about =
        "An elastic bar, fixed at both ends, rings in its first mode for one period. The exact answer is a sine in "
        "space "
        "and time. The amplitude (1e-5 of the wave speed) is so small that moving particles solve the linear equation "
        "as well as held ones.";
    report_scene echo = base(reflection(), "Driven bar with reflection", {50, 100, 200, 400});
    echo.about =
        "The right end of the bar is driven by v0 sin 10t from rest, the left end is fixed: a wave with a kink at its "
        "front runs to the left end and back to the right one. The kink limits the order of every scheme.";
    report_scene jump = base(shock(), "Shock in an elastic bar", {50, 100, 200, 400});
    jump.about =
        "The left half of the bar starts compressed. Two fronts leave the middle at the wave speed; velocity and "
        "strain "
        "jump there. No scheme converges faster than first order at a jump.";
    jump.error_is =
        "Error: mean over the particles at the end of the absolute errors of velocity and strain, each relative to its "
        "jump.";
    return {wave, echo, jump};
}
