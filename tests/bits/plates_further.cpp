// 2D: further transfers, two bodies in one velocity field.
#include "bits.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"2d_quadratic_adaptive_fmpm_usl_plus",
     [](account& out) {
         block<2>(out, fields<>{}, quadratic_spline{}, adaptive_fmpm{1e-2, 5}, usl_plus{});
     }},
    {"2d_linear_xpic3_usavg_plus_threads",
     [](account& out) { block<2>(out, fields<>{}, linear{}, xpic<3>{}, usavg_plus{}, two_threads(), swaying<2>()); }},
    {"2d_cubic_fmpm2_euler", [](account& out) { block<2>(out, kept{}, cubic_spline{}, fmpm<2>{}, euler{}); }},
    {"2d_quadratic_fmpm2_usl_minus_float",
     [](account& out) {
         one_body(out, box<2, float>(), middle<2>, rubber(), fields<>{}, quadratic_spline{}, fmpm<2>{}, usl_minus{},
                  swaying<2, float>());
     }},
    {"2d_linear_periodic_fmpm_dynamic_usf_two_laws_leaving_removes",
     [](account& out) {
         solver mpm{box<2>(), linear{}, periodic_fmpm<dynamic>{4, 2}, usf{}, leaving_removes{}};
         auto soft = rough_body(mpm, rubber(), {{1.5, 9}, {0.5, 6}, {}});
         auto other = rough_body(mpm, varying_elastic{.young = 5.3, .poisson = 0.2, .density = 1.1},
                                 {{10, 19.5}, {1, 6}, {}}, kept{}, 8);
         roughen(soft, 2, 0.4, 0.5);
         roughen(other, -0.5, 0.4, 0.5);
         const auto before = soft.size();
         steps(mpm, 18, step_size, soft, other);
         if (soft.size() == before) out.complain("no particle leaves");
         put_all(out, mpm, soft, other);
     }},
};

}  // namespace
