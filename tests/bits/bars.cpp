// 1D: transfers by stress orders, moving and held; free and driven.
#include "bits.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"1d_linear_flip_usl_minus",
     [](account& out) { block<1>(out, fields<>{}, linear{}, flip{}, usl_minus{}, swaying<1>()); }},
    {"1d_linear_flip_usl_minus_slow",
     [](account& out) {
         // Nobody leaves its cell in most steps: then the sums of the next step are made while particles are updated.
         solver mpm{box<1>(), linear{}, flip{}, usl_minus{}, swaying<1>()};
         auto bar = rough_body(mpm, rubber(), middle<1>);
         roughen(bar, 0.02, 0.02, 0.05);
         steps(mpm, 14, step_size, bar);
         put_all(out, mpm, bar);
         if (mpm.steps_in_one_pass() < 3) out.complain("few steps are made in one pass");
     }},
    {"1d_linear_flip_usl_minus_held_kept",
     [](account& out) { block<1>(out, kept{}, linear{}, flip{}, usl_minus{}, swaying<1>(), held{}); }},
    {"1d_quadratic_pic_euler", [](account& out) { block<1>(out, kept{}, quadratic_spline{}, pic{}, euler{}); }},
    {"1d_cubic_blend_usl_minus",
     [](account& out) { block<1>(out, kept{}, cubic_spline{}, blend{0.9}, usl_minus{}, swaying<1>()); }},
    {"1d_linear_fmpm4_usavg_plus",
     [](account& out) { block<1>(out, fields<>{}, linear{}, fmpm<4>{}, usavg_plus{}, swaying<1>()); }},
    {"1d_quadratic_xpic2_usf_held",
     [](account& out) { block<1>(out, fields<>{}, quadratic_spline{}, xpic<2>{}, usf{}, swaying<1>(), held{}); }},
    {"1d_linear_modified_flip_euler_held",
     [](account& out) { block<1>(out, fields<>{}, linear{}, modified_flip{0.7}, euler{}, swaying<1>(), held{}); }},
    {"1d_quadratic_periodic_fmpm3_usl_plus",
     [](account& out) { block<1>(out, kept{}, quadratic_spline{}, periodic_fmpm<3>{3}, usl_plus{}, swaying<1>()); }},
    {"1d_cpgimp_graphics_blend_neo_hookean",
     [](account& out) {
         const neo_hookean law{.young = 9.7, .poisson = 0.3, .density = 1.9};
         one_body(out, box<1>(), middle<1>, law, fields<>{}, cpgimp{2}, graphics_blend{0.8});
     }},
};

}  // namespace
