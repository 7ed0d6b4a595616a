// 2D: how conditions enter a full mass matrix.
#include "bits.hpp"
#include "optional.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"2d_quadratic_fmpm4_usl_minus_incremental",
     [](account& out) { block<2>(out, fields<>{}, quadratic_spline{}, fmpm<4>{}, usl_minus{}, swaying<2>()); }},
    {"2d_linear_fmpm2_usl_minus_velocity",
     [](account& out) { block<2>(out, fields<>{}, linear{}, fmpm<2>{}, boundary_method::velocity{}, swaying<2>()); }},
    {"2d_quadratic_fmpm2_usl_minus_combined_held",
     [](account& out) {
         block<2>(out, kept{}, quadratic_spline{}, fmpm<2>{}, boundary_method::combined{}, swaying<2>(), held{});
     }},
    // Nodes of little mass make this one unstable at the step of the others.
    {"2d_linear_fmpm3_usl_minus_unlumped1",
     [](account& out) {
         auto mpm = solver_of(box<2>(), linear{}, fmpm<3>{}, boundary_method::unlumped1{}, swaying<2>());
         auto body = rough_body(mpm, rubber(), middle<2>, fields<>{});
         roughen(body, 1.2, 0.4, 0.5);
         steps(mpm, 28, step_size / 2, body);
         put_all(out, mpm, body);
     }},
    {"2d_quadratic_fmpm2_usf_unlumped2",
     [](account& out) {
         block<2>(out, fields<>{}, quadratic_spline{}, fmpm<2>{}, usf{}, boundary_method::unlumped2{}, swaying<2>());
     }},
    {"2d_linear_fmpm2_usavg_minus_partial",
     [](account& out) {
         block<2>(out, fields<>{}, linear{}, fmpm<2>{}, usavg_minus{}, boundary_method::partial{}, swaying<2>());
     }},
    {"2d_quadratic_fmpm_dynamic_usl_minus_collected_held",
     [](account& out) {
         block<2>(out, fields<>{}, quadratic_spline{}, fmpm<dynamic>{2}, boundary_method::collected{}, swaying<2>(),
                  held{});
     }},
    {"2d_cubic_fmpm2_usl_minus_lumped",
     [](account& out) {
         block<2>(out, fields<>{}, cubic_spline{}, fmpm<2>{}, boundary_method::lumped{}, swaying<2>());
     }},
    {"2d_linear_exact_fmpm_usl_minus_held",
     [](account& out) { block<2>(out, fields<>{}, linear{}, exact_fmpm<>{}, swaying<2>(), held{}); }},
};

}  // namespace
