// A shock tube: a dense gas at rest and a thin one meet at x = 1/2 (Sod's problem, or a stronger one by --ratio), with
// artificial viscosity. Errors are against the exact solution of the Riemann problem (support/riemann.hpp).
//     shock_tube --csv tube.csv && gnuplot -e "csv='tube.csv'; out='tube'" examples/plots/shock_tube.gp
#include "support/tube.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <string>

namespace {

struct choice {
    std::string shape = "quadratic", update = "flip", stress = "usavg-", csv, summary;
    int order = 2;
    double ratio = 0;
};

template <class Shape, class Scheme> tube_result with_stress(const tube& set, const choice& o, const Scheme& scheme) {
    if (o.stress == "usl-") return run_tube(set, Shape{}, scheme, tamis::usl_minus{});
    return run_tube(set, Shape{}, scheme, tamis::usavg_minus{});
}
template <class Shape> tube_result with_update(const tube& set, const choice& o) {
    if (o.update == "flip") return with_stress<Shape>(set, o, tamis::flip{});
    return with_stress<Shape>(set, o, tamis::fmpm<tamis::dynamic>{o.order});
}
tube_result run(const tube& set, const choice& o) {
    if (o.shape == "linear") return with_update<tamis::linear>(set, o);
    if (o.shape == "cubic") return with_update<tamis::cubic_spline>(set, o);
    return with_update<tamis::quadratic_spline>(set, o);
}

nlohmann::ordered_json summary_of(const tube& set, const choice& o, const tube_result& r) {
    const riemann::solution exact(set.gamma, set.left, set.right);
    const double h = 1. / set.cells;
    nlohmann::ordered_json all;
    all["scene"] = "shock_tube";
    all["cells"] = set.cells;
    all["per_cell"] = set.per_cell;
    all["shape"] = o.shape;
    all["update"] = o.update;
    all["order"] = o.update == "fmpm" ? o.order : 0;
    all["stress"] = o.stress;
    all["pressure_ratio"] = set.left.pressure / set.right.pressure;
    all["particles"] = r.particles.size();
    all["steps"] = r.steps;
    all["time"] = set.time;
    all["wall_seconds"] = r.wall_seconds;
    all["ns_per_particle_step"] =
        r.wall_seconds * 1e9 / static_cast<double>(r.particles.size()) / static_cast<double>(r.steps);
    all["density_l1"] = r.density_l1;
    all["velocity_l1"] = r.velocity_l1;
    all["pressure_l1"] = r.pressure_l1;
    all["contact_off_in_cells"] = (r.contact - 0.5 - exact.velocity() * set.time) / h;
    all["shock_off_in_cells"] = (r.shock - 0.5 - exact.right_front() * set.time) / h;
    all["density_behind_shock"] = r.behind_shock.density;
    all["velocity_behind_shock"] = r.behind_shock.velocity;
    all["pressure_behind_shock"] = r.behind_shock.pressure;
    all["density_behind_contact"] = r.behind_contact.density;
    all["energy_initial"] = r.energy_start;
    all["energy_final"] = r.energy_end;
    all["boundary_work"] = r.boundary_work;
    all["momentum"] = r.momentum;
    return all;
}

void write_particles(const tube& set, const tube_result& r, const std::string& path) {
    const riemann::solution exact(set.gamma, set.left, set.right);
    tamis::atomic_file file(path);
    file.out() << "x,density,velocity,pressure,exact_density,exact_velocity,exact_pressure\n";
    for (const tube_particle& p : r.particles) {
        const riemann::state w = exact.at((p.x - 0.5) / set.time);
        file.out() << p.x << ',' << p.density << ',' << p.velocity << ',' << p.pressure << ',' << w.density << ','
                   << w.velocity << ',' << w.pressure << '\n';
    }
    file.commit();
}

}  // namespace

int main(int argc, char** argv) {
    tube set;
    choice o;
    CLI::App app{"A shock tube: two ideal gases at rest meet at x = 1/2; by default Sod's problem."};
    app.add_option("--cells", set.cells, "Cells of the grid along the tube")->check(CLI::Range(10, 100000));
    app.add_option("--per-cell", set.per_cell, "Particles per cell")->check(CLI::Range(1, 100));
    app.add_option("--shape", o.shape, "Shape functions")->check(CLI::IsMember({"linear", "quadratic", "cubic"}));
    app.add_option("--update", o.update, "Particle update")->check(CLI::IsMember({"flip", "fmpm"}));
    app.add_option("--order", o.order, "Order k of fmpm")->check(CLI::Range(1, 1000));
    app.add_option("--stress", o.stress, "Stress order")->check(CLI::IsMember({"usl-", "usavg-"}));
    app.add_option("--ratio", o.ratio, "Ratio of pressures, at equal densities; without it Sod's tube")
        ->check(CLI::Range(1.01, 1e12));
    app.add_option("--courant", set.courant, "Courant number")->check(CLI::Range(1e-6, 1.));
    app.add_option("--linear", set.linear, "Linear coefficient of the artificial viscosity")
        ->check(CLI::Range(0., 100.));
    app.add_option("--quadratic", set.quadratic, "Quadratic coefficient")->check(CLI::Range(0., 100.));
    app.add_option("--csv", o.csv, "Write the particles and the exact answer to this file");
    app.add_option("--summary", o.summary, "Write all numbers to this file, JSON");
    CLI11_PARSE(app, argc, argv);
    if (o.ratio > 0) {
        set.left = {1, 0, o.ratio};
        set.right = {1, 0, 1};
        // As far as Sod's shock comes.
        set.time = 0.3 / riemann::solution(set.gamma, set.left, set.right).right_front();
    }
    try {
        tube_result r = run(set, o);
        measure(set, r);
        const nlohmann::ordered_json all = summary_of(set, o, r);
        for (const auto& [name, value] : all.items())
            std::printf("%-24s %s\n", name.c_str(),
                        value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
        if (!o.csv.empty()) write_particles(set, r, o.csv);
        if (!o.summary.empty()) {
            tamis::atomic_file file(o.summary);
            file.out() << all.dump(4) << '\n';
            file.commit();
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "shock_tube: %s\n", e.what());
        return 1;
    }
    return 0;
}
