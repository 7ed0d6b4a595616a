// Advection by the two-step Taylor-Galerkin scheme: a sine wave or a step is carried once through the domain.
//     advection --profile step --mass lumped --csv step.csv
#include "support/advection.hpp"
#include "support/galerkin_program.hpp"

int main(int argc, char** argv) {
    advection_options o;
    galerkin::outputs files;
    CLI::App app{"A profile is carried once through the domain by the two-step Taylor-Galerkin scheme.", "advection"};
    galerkin::add_options(app, o, files, {"sine", "step"});
    app.add_option("--ends", o.ends, "Ends of the domain")->check(CLI::IsMember({"periodic", "open"}));
    return galerkin::program(app, argc, argv, [&] {
        const advection_result r = run_advection(o);
        auto all = galerkin::summary_of("advection", o, r);
        all["ends"] = o.ends;
        galerkin::write(all, r, files);
    });
}
