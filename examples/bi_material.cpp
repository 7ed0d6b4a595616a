// A pulse meets the joint of two bars: how much comes back, and how much goes on, against the theory of impedances.
#include "support/ranges.hpp"
#include "support/bi_material.hpp"
#include "support/scene_program.hpp"

int main(int argc, char** argv) {
    bi_material_options o;
    two_bars& set = o.set;
    double density = 0;
    CLI::App app{
        "A pulse meets the joint of two bars; the right one's modulus and density are those of the left times a "
        "ratio."};
    app.add_option("--ratio", set.young, "Ratio of the moduli, and of the densities unless --density-ratio is given")
        ->check(number_from(1e-6, 1e6));
    app.add_option("--density-ratio", density, "Ratio of the densities")->check(number_from(1e-6, 1e6));
    app.add_option("--cells", set.cells, "Cells of the grid along both bars")->check(whole_from(20, 100000));
    app.add_option("--per-cell", set.per_cell, "Particles per cell")->check(whole_from(1, 100));
    app.add_option("--shape", o.shape, "Shape functions: linear or quadratic");
    app.add_option("--update", o.update, "Particle update: flip or fmpm");
    app.add_option("--order", o.order, "Order k of fmpm")->check(whole_from(1, 1000));
    app.add_option("--stress", o.stress, "Stress order: usl-, or euler (ADMPM's; linear functions, flip)");
    app.add_option("--particles", o.particles, "moving or held");
    app.add_option("--courant", set.courant, "Courant number of the faster bar")->check(number_from(1e-6, 1));
    app.add_option("--summary", o.summary, "Write all numbers to this file, JSON");
    CLI11_PARSE(app, argc, argv);
    set.density = density > 0 ? density : set.young;
    return run_program("bi_material", [&] { put_summary(summary_of(o, run_bi_material(o)), o.summary); });
}
