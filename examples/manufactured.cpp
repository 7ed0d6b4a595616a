// A manufactured solution of finite strain in 2D or 3D: a neo-Hookean block is pushed such that its motion is known
// (support/manufactured.hpp, docs/manufactured.md). Errors at the end, and the order in which they fall.
//     manufactured --dim 3 --cells 8,16,32
#include "support/ranges.hpp"
#include "support/manufactured.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <tamis/observe/atomic_file.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
    manufactured_options o;
    std::vector<int> cells{8, 16, 32};
    std::string summary;
    CLI::App app{"A neo-Hookean block with a manufactured solution: errors and their order."};
    app.add_option("--dim", o.dim, "Dimension")->check(whole_from(2, 3));
    app.add_option("--cells", cells, "Cells along an axis, several by commas")
        ->delimiter(',')
        ->check(whole_from(4, 4096));
    app.add_option("--per-cell", o.per_cell, "Particles per cell and axis")->check(whole_from(1, 10));
    app.add_option("--shape", o.shape, "Shape functions: linear, ugimp, cpgimp, quadratic, cubic");
    app.add_option("--update", o.update, "Particle update: flip, xpic, fmpm");
    app.add_option("--order", o.order, "Terms k of xpic and fmpm")->check(whole_from(1, 1000));
    app.add_option("--stress", o.stress, "Stress order: usl-, usavg-, euler");
    app.add_option("--courant", o.courant, "Courant number")->check(number_from(1e-6, 1));
    app.add_option("--amplitude", o.amplitude, "Amplitude A (m)")->check(number_from(1e-9, 0.25));
    app.add_option("--poisson", o.poisson, "Poisson's ratio");
    app.add_option("--time", o.time, "End time (s); a period is 2 s")->check(number_from(1e-6, 1000));
    app.add_option("--summary", summary, "Write all numbers to this file, JSON");
    CLI11_PARSE(app, argc, argv);
    try {
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        std::printf("cells  particles  steps  displacement  velocity    order  energy      s\n");
        double before = 0;
        int cells_before = 0;
        for (const int n : cells) {
            o.cells = n;
            const manufactured_result r = run_manufactured(o);
            const double error = std::hypot(r.place_l2, r.velocity_l2);
            char order[16] = "-";
            if (cells_before > 0 && n != cells_before)
                std::snprintf(order, sizeof order, "%.2f",
                              std::log(before / error) / std::log(double(n) / cells_before));
            std::printf("%5d %10zu %6ld     %.3e %.3e %7s %+.1e  %.3g\n", n, r.particles, r.steps, r.place_l2,
                        r.velocity_l2, order, r.energy_error, r.wall_seconds);
            before = error;
            cells_before = n;
            all.push_back({{"scene", "manufactured"},
                           {"dim", o.dim},
                           {"cells", n},
                           {"per_cell", o.per_cell},
                           {"shape", o.shape},
                           {"update", o.update},
                           {"order", o.order},
                           {"stress", o.stress},
                           {"particles", r.particles},
                           {"crossings", r.crossings},
                           {"steps", r.steps},
                           {"displacement_l2", r.place_l2},
                           {"displacement_max", r.place_max},
                           {"velocity_l2", r.velocity_l2},
                           {"velocity_max", r.velocity_max},
                           {"energy_error", r.energy_error},
                           {"wall_seconds", r.wall_seconds}});
        }
        if (!summary.empty()) {
            tamis::atomic_file file(summary);
            file.out() << all.dump(4) << '\n';
            file.commit();
        }
    } catch (const std::exception& e) {
        std::fprintf(stderr, "manufactured: %s\n", e.what());
        return 1;
    }
    return 0;
}
