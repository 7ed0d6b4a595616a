#include "report.hpp"

#include <tamis/core/error.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <ostream>

namespace {

double ns_per_particle_step(const bar_result& r) {
    return r.wall_seconds * 1e9 / (static_cast<double>(r.steps) * static_cast<double>(r.particles.size()));
}
double energy_error(const bar_scene& scene, const bar_options& o, const bar_result& r) {
    const double right = scene.exact(o.amplitude).energy(o.time);
    return (r.energy.back().total() - right) / right;
}

/// A number of the result, or an error that says why it is none.
double measured(double value, const char* what, const char* why) {
    if (std::isfinite(value)) return value;
    throw tamis::error(std::string(what) + " cannot be measured: " + why);
}
double front_speed_of(const bar_result& r) {
    return measured(front_speed(r.fronts) / bar_scene::wave_speed, "the speed of the fronts",
                    "they took no form, or no way; give more cells, or a longer --time");
}

}  // namespace

void check_measures(const bar_scene& scene, const bar_options& o, const bar_result& r) {
    const char* const grown =
        "the run's velocities or strains became too large; give a smaller --courant or --amplitude";
    const auto errors = errors_of(scene, o, r);
    for (const double error : {errors.velocity_l2, errors.velocity_max, errors.strain_l2, errors.strain_max})
        measured(error, "the error", grown);
    measured(energy_error(scene, o, r), "the energy's error", grown);
    measured(r.energy.back().boundary_work, "the work of the ends", grown);
    if (scene.fronts) front_speed_of(r);
}

std::string summary_of(const bar_scene& scene, const bar_options& o, const bar_result& r) {
    const auto errors = errors_of(scene, o, r);
    nlohmann::ordered_json all;
    all["scene"] = scene.name;
    all["cells"] = o.cells;
    all["per_cell"] = o.per_cell;
    all["shape"] = o.shape;
    all["update"] = o.update;
    all["order"] = o.has_order() ? nlohmann::ordered_json(o.order) : nlohmann::ordered_json();
    if (o.update == "blend") all["alpha"] = o.alpha;
    all["stress"] = o.stress;
    all["boundary"] = o.boundary;
    all["particles"] = o.particles;
    all["precision"] = o.precision;
    all["threads"] = std::max(1, o.threads);
    all["amplitude"] = o.amplitude;
    all["particle_count"] = r.particles.size();
    all["steps"] = r.steps;
    all["dt"] = r.dt;
    all["time"] = o.time;
    all["courant"] = bar_scene::wave_speed * r.dt * o.cells / bar_scene::length;
    all["wall_seconds"] = r.wall_seconds;
    all["ns_per_particle_step"] = ns_per_particle_step(r);
    all["bytes_per_particle"] = r.bytes_per_particle;
    all["bytes_per_node"] = r.bytes_per_node;
    all["velocity_l2"] = errors.velocity_l2;
    all["velocity_max"] = errors.velocity_max;
    all["strain_l2"] = errors.strain_l2;
    all["strain_max"] = errors.strain_max;
    all["energy_initial"] = r.energy.front().total();
    all["energy_final"] = r.energy.back().total();
    all["energy_exact"] = scene.exact(o.amplitude).energy(o.time);
    all["energy_error"] = energy_error(scene, o, r);
    all["boundary_work"] = r.energy.back().boundary_work;
    all["mass"] = r.mass;
    all["momentum"] = r.momentum;
    if (scene.fronts) {
        all["front_speed_over_c"] = front_speed_of(r);
        all["overshoot"] = overshoot(o.time, r.particles, o.amplitude);
    }
    return all.dump(2) + "\n";
}

void print_table(std::ostream& out, const bar_scene& scene, const bar_options& o, const bar_result& r) {
    const auto line = [&](const char* name, const char* format, auto... values) {
        char text[200];
        std::snprintf(text, sizeof text, format, values...);
        char whole[256];
        std::snprintf(whole, sizeof whole, "%-24s %s\n", name, text);
        out << whole;
    };
    const auto errors = errors_of(scene, o, r);
    const std::string update = o.update + (o.has_order()         ? "(" + std::to_string(o.order) + ")"
                                           : o.update == "blend" ? "(" + nlohmann::json(o.alpha).dump() + ")"
                                                                 : "");
    line("scene", "%s", scene.name.c_str());
    line("composition", "%s, %s, %s, %s, %s, %s", o.shape.c_str(), update.c_str(), o.stress.c_str(), o.boundary.c_str(),
         o.particles.c_str(), o.precision.c_str());
    line("cells, particles", "%d, %zu", o.cells, r.particles.size());
    line("steps, dt, T", "%ld, %.6g s, %.6g s", r.steps, r.dt, o.time);
    line("velocity error", "%.3e (L2), %.3e (max), relative", errors.velocity_l2, errors.velocity_max);
    line("strain error", "%.3e (L2), %.3e (max), relative", errors.strain_l2, errors.strain_max);
    line("energy", "%.6e J at first, %.6e J at last", r.energy.front().total(), r.energy.back().total());
    line("energy, exact", "%.6e J, difference %+.2e of it", scene.exact(o.amplitude).energy(o.time),
         energy_error(scene, o, r));
    line("work of the ends", "%.6e J", r.energy.back().boundary_work);
    if (scene.fronts) {
        line("front speed", "%.5f c", front_speed_of(r));
        line("overshoot", "%.1f %% of the plateau", 100 * overshoot(o.time, r.particles, o.amplitude));
    }
    line("run time", "%.3g s, %.3g ns per particle and step", r.wall_seconds, ns_per_particle_step(r));
    line("memory", "%zu bytes per particle, %zu bytes per node", r.bytes_per_particle, r.bytes_per_node);
}
