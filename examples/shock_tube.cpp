// A shock tube: a dense gas at rest and a thin one meet at x = 1/2 (Sod's problem, or a stronger one by --ratio), with
// artificial viscosity. Errors are against the exact solution of the Riemann problem (support/riemann.hpp).
//     shock_tube --csv tube.csv && gnuplot -e "csv='tube.csv'; out='tube'" examples/plots/shock_tube.gp
#include "support/ranges.hpp"
#include "support/scene_program.hpp"
#include "support/shock_tube.hpp"

namespace {

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
    shock_tube_options o;
    tube& set = o.set;
    double ratio = 0;
    CLI::App app{"A shock tube: two ideal gases at rest meet at x = 1/2; by default Sod's problem."};
    app.add_option("--cells", set.cells, "Cells of the grid along the tube")->check(whole_from(10, 100000));
    app.add_option("--per-cell", set.per_cell, "Particles per cell")->check(whole_from(1, 100));
    add_composition(app, o);
    app.add_option("--ratio", ratio, "Ratio of pressures, at equal densities; without it Sod's tube")
        ->check(number_from(1.01, 1e12));
    app.add_option("--courant", set.courant, "Courant number")->check(number_from(1e-6, 1));
    app.add_option("--linear", set.linear, "Linear coefficient of the artificial viscosity")
        ->check(number_from(0, 100));
    app.add_option("--quadratic", set.quadratic, "Quadratic coefficient")->check(number_from(0, 100));
    CLI11_PARSE(app, argc, argv);
    if (ratio > 0) o.pressure_ratio(ratio);
    return run_program("shock_tube", [&] {
        const shock_tube_result r = run_shock_tube(o);
        put_summary(summary_of(o, r), o.summary);
        if (!o.csv.empty()) write_particles(set, r, o.csv);
    });
}
