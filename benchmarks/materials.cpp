// What laws, affine transfers and total_lagrangian cost in 3D, quadratic functions, 24^3 cells of 8 particles, beside
// the neo-Hookean FLIP step.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "ratios.hpp"

int main(int argc, char** argv) {
    using namespace tamis;
    constexpr int n = 24;
    ratio_run run;
    const neo_hookean rubber{.young = 1e6, .poisson = 0.3, .density = 1000};
    const std::string usual = "neo-Hookean, FLIP";
    const auto law = [&](const std::string& name, const auto& of, const std::string& to) {
        run.add(name, to, [=] { return block_of<3, double>(of, n, quadratic_spline{}, flip{}, usl_minus{}); });
    };
    law(usual, rubber, "");
    law("linear elastic", linear_elastic{.young = 1e6, .poisson = 0.3, .density = 1000}, usual);
    law("j2", j2{.young = 1e6, .poisson = 0.3, .density = 1000, .yield = 1e4}, usual);
    law("johnson_cook",
        johnson_cook{.young = 1e6, .poisson = 0.3, .density = 1000, .yield = 1e4, .hardening = 1e4, .exponent = 0.2},
        usual);
    law("drucker_prager", drucker_prager{.young = 1e6, .poisson = 0.3, .density = 1000, .friction = 30}, usual);
    law("mohr_coulomb", mohr_coulomb{.young = 1e6, .poisson = 0.3, .density = 1000, .friction = 30}, usual);
    law("granular_flow",
        granular_flow{.young = 1e6,
                      .poisson = 0.3,
                      .density = 1000,
                      .static_friction = 0.4,
                      .limit_friction = 0.7,
                      .inertial_number = 0.3,
                      .grain_diameter = 1e-3,
                      .grain_density = 2500},
        usual);
    const auto step = [&](const std::string& name, const auto& shape, const auto& transfer, const auto& motion,
                          const auto& order, const std::string& to) {
        run.add(name, to, [=] { return block_of<3, double>(rubber, n, shape, transfer, motion, order); });
    };
    step("TPIC", quadratic_spline{}, tpic{}, moving{}, usl_minus{}, usual);
    step("APIC", quadratic_spline{}, apic{}, moving{}, usl_minus{}, usual);
    step("total_lagrangian", quadratic_spline{}, flip{}, total_lagrangian{}, usl_minus{}, usual);
    step("APIC, total_lagrangian", quadratic_spline{}, apic{}, total_lagrangian{}, usl_minus{}, "APIC");
    step("USL+", quadratic_spline{}, flip{}, moving{}, usl_plus{}, usual);
    step("USL+, total_lagrangian", quadratic_spline{}, flip{}, total_lagrangian{}, usl_plus{}, "USL+");
    step("linear functions", linear{}, flip{}, moving{}, usl_plus{}, usual);
    step("linear functions, total_lagrangian", linear{}, flip{}, total_lagrangian{}, usl_plus{}, "linear functions");
    return run.run(argc, argv);
}
