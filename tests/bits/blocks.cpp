// 3D.
#include "bits.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"3d_quadratic_flip_usl_minus",
     [](account& out) { block<3>(out, fields<>{}, quadratic_spline{}, flip{}, usl_minus{}, swaying<3>()); }},
    {"3d_linear_fmpm2_usf_held",
     [](account& out) { block<3>(out, kept{}, linear{}, fmpm<2>{}, usf{}, swaying<3>(), held{}); }},
    {"3d_cubic_flip_usavg_plus_leaving_clamps",
     [](account& out) {
         const extent low[3] = {{2.5, 11.5}, {0, 3.5}, {1.5, 5.5}};
         one_body(out, box<3>(), low, rubber(), kept{}, cubic_spline{}, flip{}, usavg_plus{}, leaving_clamps{},
                  two_threads());
     }},
    {"3d_ugimp_pic_usl_plus_float",
     [](account& out) {
         one_body(out, box<3, float>(), middle<3>, rubber(), fields<>{}, ugimp{2}, pic{}, usl_plus{});
     }},
};

}  // namespace
