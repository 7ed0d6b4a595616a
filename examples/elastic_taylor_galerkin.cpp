// A small shock in an elastic bar by the two-step Taylor-Galerkin scheme in (stress, velocity).
//     elastic_taylor_galerkin --mass lumped --csv shock.csv
#include "support/ranges.hpp"
#include "support/elastic_taylor_galerkin.hpp"
#include "support/galerkin_program.hpp"

int main(int argc, char** argv) {
    elastic_taylor_galerkin_options o;
    galerkin::outputs files;
    CLI::App app{"A small shock in an elastic bar, by the two-step Taylor-Galerkin scheme in (stress, velocity).",
                 "elastic_taylor_galerkin"};
    galerkin::add_options(app, o, files, {"shock", "mode"});
    app.add_option("--amplitude", o.amplitude, "Strain A of the shock, -A on the left half; velocity of the mode")
        ->check(number_from(1e-12, 1e12));
    return galerkin::program(app, argc, argv, [&] {
        const elastic_taylor_galerkin_result r = run_elastic_taylor_galerkin(o);
        auto all = galerkin::summary_of("elastic_taylor_galerkin", o, r);
        all["amplitude"] = o.amplitude;
        all["energy_initial"] = r.energy_initial;
        all["energy_final"] = r.energy_final;
        if (o.profile == "shock") {
            all["front_speed_over_c"] = r.front_speed;
            all["overshoot"] = r.overshoot;
        }
        galerkin::write(all, r, files);
    });
}
