// A pulse meets the joint of two bars: how much comes back, and how much goes on, against the theory of impedances.
#include "support/two_bars.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <exception>
#include <string>

namespace {

struct choice {
    std::string shape = "quadratic", update = "flip", particles = "moving", summary;
    int order = 2;
};

template <class Shape, class Scheme>
two_bars_result with_motion(const two_bars& set, const choice& o, const Scheme& scheme) {
    if (o.particles == "held") return run_two_bars(set, Shape{}, scheme, tamis::usl_minus{}, tamis::held{});
    return run_two_bars(set, Shape{}, scheme, tamis::usl_minus{}, tamis::moving{});
}
template <class Shape> two_bars_result with_update(const two_bars& set, const choice& o) {
    if (o.update == "flip") return with_motion<Shape>(set, o, tamis::flip{});
    return with_motion<Shape>(set, o, tamis::fmpm<tamis::dynamic>{o.order});
}
two_bars_result run(const two_bars& set, const choice& o) {
    if (o.shape == "linear") return with_update<tamis::linear>(set, o);
    return with_update<tamis::quadratic_spline>(set, o);
}

}  // namespace

int main(int argc, char** argv) {
    two_bars set;
    choice o;
    double modulus = 100, density = 0;
    CLI::App app{
        "A pulse meets the joint of two bars; the right one's modulus and density are those of the left times a "
        "ratio."};
    app.add_option("--ratio", modulus, "Ratio of the moduli, and of the densities unless --density-ratio is given")
        ->check(CLI::Range(1e-6, 1e6));
    app.add_option("--density-ratio", density, "Ratio of the densities")->check(CLI::Range(1e-6, 1e6));
    app.add_option("--cells", set.cells, "Cells of the grid along both bars")->check(CLI::Range(20, 100000));
    app.add_option("--per-cell", set.per_cell, "Particles per cell")->check(CLI::Range(1, 100));
    app.add_option("--shape", o.shape, "Shape functions")->check(CLI::IsMember({"linear", "quadratic"}));
    app.add_option("--update", o.update, "Particle update")->check(CLI::IsMember({"flip", "fmpm"}));
    app.add_option("--order", o.order, "Order k of fmpm")->check(CLI::Range(1, 1000));
    app.add_option("--particles", o.particles, "Do particles move?")->check(CLI::IsMember({"moving", "held"}));
    app.add_option("--courant", set.courant, "Courant number of the faster bar")->check(CLI::Range(1e-6, 1.));
    app.add_option("--summary", o.summary, "Write all numbers to this file, JSON");
    CLI11_PARSE(app, argc, argv);
    set.young = modulus;
    set.density = density > 0 ? density : modulus;
    if (!(set.speed() > 0.2 && set.speed() < 1.6)) {
        std::fprintf(
            stderr,
            "bi_material: the right bar's wave speed is %g times the left one's, and its pulse would be cut by "
            "the end or by the cells; give ratios of modulus and density whose quotient is from 0.04 to 2.5\n",
            set.speed());
        return 2;
    }
    try {
        const two_bars_result r = run(set, o);
        nlohmann::ordered_json all;
        all["scene"] = "bi_material";
        all["cells"] = set.cells;
        all["per_cell"] = set.per_cell;
        all["shape"] = o.shape;
        all["update"] = o.update;
        all["order"] = o.update == "fmpm" ? o.order : 0;
        all["particles"] = o.particles;
        all["modulus_ratio"] = set.young;
        all["density_ratio"] = set.density;
        all["steps"] = r.steps;
        all["reflected"] = r.reflected;
        all["reflected_by_theory"] = set.reflected();
        all["transmitted"] = r.transmitted;
        all["transmitted_by_theory"] = set.transmitted();
        all["unexplained_left"] = r.rest_left;
        all["unexplained_right"] = r.rest_right;
        all["energy_gain"] = r.energy_gain;
        for (const auto& [name, value] : all.items())
            std::printf("%-24s %s\n", name.c_str(),
                        value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
        if (!o.summary.empty()) {
            tamis::atomic_file file(o.summary);
            file.out() << all.dump(4) << '\n';
            file.commit();
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bi_material: %s\n", e.what());
        return 1;
    }
    return 0;
}
