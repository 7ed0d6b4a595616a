// Gases and fluids, held and moving; periodic grids.
#include "bits.hpp"

using namespace bits;

namespace {

constexpr extent all_of[3] = {{0, 24}, {0, 9}, {}};

const composition all[] = {
    {"1d_quadratic_flip_usl_minus_pressure_gas_held",
     [](account& out) {
         one_body(out, box<1>(), {{0, 44}, {}, {}}, pressure_gas{1.4, 1.1, 0.9}, fields<>{}, quadratic_spline{}, flip{},
                  swaying<1>(), held{});
     }},
    {"1d_linear_flip_euler_admpm_gas",
     [](account& out) {
         one_body(out, box<1>(), middle<1>, admpm_gas{1.4, 1.1, 0.9, 0.9}, kept{}, linear{}, flip{}, euler{});
     }},
    {"2d_linear_fmpm2_usavg_minus_pressure_gas_held",
     [](account& out) {
         one_body(out, box<2>(), all_of, pressure_gas{1.4, 1.1, 0.9}, fields<>{}, linear{}, fmpm<2>{}, usavg_minus{},
                  swaying<2>(), held{}, two_threads());
     }},
    {"2d_quadratic_blend_usl_plus_shocked_gas",
     [](account& out) {
         one_body(out, box<2>(), middle<2>, shocked_gas{1.4, 1.1, 0.9, artificial_viscosity{side, 0.6, 1.7}},
                  fields<>{}, quadratic_spline{}, blend{0.99}, usl_plus{}, swaying<2>());
     }},
    {"2d_cubic_fmpm2_usavg_plus_newtonian_periodic",
     [](account& out) {
         const newtonian_fluid law{tait{.bulk = 9.7, .density = 1.1}, 0.02, 0.01};
         one_body(out, box<2>().wrapped(0).wrapped(1), all_of, law, fields<>{}, cubic_spline{}, fmpm<2>{},
                  usavg_plus{});
     }},
    {"2d_linear_flip_usl_minus_ideal_gas_periodic",
     [](account& out) {
         one_body(out, box<2>().wrapped(0), {{0, 24}, {2, 6}, {}}, ideal_gas{1.4, 1.1, 0.9}, kept{}, linear{}, flip{});
     }},
    {"1d_quadratic_fmpm3_usl_minus_periodic_held",
     [](account& out) {
         one_body(out, box<1>().wrapped(0), {{0, 44}, {}, {}}, rubber(), fields<>{}, quadratic_spline{}, fmpm<3>{},
                  held{});
     }},
};

}  // namespace
