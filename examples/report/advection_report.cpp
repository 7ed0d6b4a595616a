#include "report_scene.hpp"
#include "run_by_names.hpp"

#include "support/advection.hpp"

#include <cmath>

namespace {

outcome run_one(const std::string& profile, const configuration& what) {
    advection_options o;
    o.profile = profile;
    o.mass = what.order > 0 ? "fmpm" : "lumped";
    give(o, what);
    const advection_result r = run_advection(o);
    const galerkin_unknown& u = r.unknowns.at(0);
    outcome found = cost_of(r, r.particles.size());
    found.error = profile == "sine" ? u.l2 : u.l1;
    found.error_velocity = u.l2;
    found.error_other = u.max;
    // What is carried is kept, not an energy.
    found.energy_error = u.total_final - u.total_initial;
    return found;
}

}  // namespace

report_scene advection_report_scene(const std::string& profile) {
    report_scene all;
    const bool sine = profile == "sine";
    all.name = "advection_" + profile;
    all.title = sine ? "Advection of a sine" : "Advection of a step";
    all.about = std::string("Not a body but a law of conservation: ") + (sine ? "a sine wave" : "a step up and down") +
                " is carried once through a periodic domain. The two-step Taylor-Galerkin method takes particles as "
                "points of quadrature, with the lumped mass matrix or k terms of the full one's inverse. ADMPM's way "
                "of stepping velocities and stresses cannot be run here, for there are none.";
    all.error_is =
        sine ? "Error: root of the mean square over the particles, relative to the amplitude. In place of the "
               "energy: what of the carried quantity was lost or won."
             : "Error: mean absolute error over the particles, relative to the step. In place of the energy: what "
               "of the carried quantity was lost or won.";
    all.velocity_is = "mean square";
    all.other_is = "largest";
    const std::vector<int> cells{25, 50, 100, 200};
    add(all.quick, all.name,
        {{"linear", "quadratic", "cubic"},
         {{"galerkin", 0}, {"galerkin", 2}, {"galerkin", 4}},
         {"-"},
         {"held"},
         {2, 3},
         {0.1, 0.25, 0.5},
         cells});
    add(all.full, all.name,
        {{"linear", "quadratic", "cubic"},
         {{"galerkin", 0}, {"galerkin", 1}, {"galerkin", 2}, {"galerkin", 4}, {"galerkin", 8}},
         {"-"},
         {"held"},
         {1, 2, 3, 4},
         {0.05, 0.1, 0.25, 0.5},
         {25, 50, 100, 200, 400}});
    all.run = [profile](const configuration& what) { return run_one(profile, what); };
    all.shown = [](const configuration& c) {
        return c.per_cell == 2 && c.courant == 0.25 && c.order != 1 && c.order != 8;
    };
    return all;
}
