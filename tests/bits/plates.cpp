// 2D: transfers by stress orders, shapes that depend on particles, threads.
#include "bits.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"2d_quadratic_flip_usl_minus",
     [](account& out) { block<2>(out, fields<>{}, quadratic_spline{}, flip{}, usl_minus{}); }},
    {"2d_linear_flip_usl_plus_held_one_lane",
     [](account& out) { block<2>(out, kept{}, linear{}, flip{}, usl_plus{}, one_lane{}, swaying<2>(), held{}); }},
    {"2d_ugimp_flip_usavg_minus_neo_hookean_threads",
     [](account& out) {
         const neo_hookean_of<volumetric::split> law{.young = 9.7, .poisson = 0.3, .density = 1.9};
         one_body(out, box<2>(), middle<2>, law, kept{}, ugimp{2}, flip{}, usavg_minus{}, two_threads());
     }},
    {"2d_cpgimp_fmpm2_usl_minus",
     [](account& out) { block<2>(out, fields<>{}, cpgimp{2}, fmpm<2>{}, usl_minus{}, swaying<2>()); }},
};

}  // namespace
