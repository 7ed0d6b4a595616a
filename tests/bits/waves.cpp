// Bodies above four megabytes, whose passes are run together.
#include "bits.hpp"

using namespace bits;

namespace {

uniform_grid<2, double> hall() { return box_of<double>({120, 140}); }
constexpr extent plate[3] = {{3.5, 85.5}, {2, 134}, {}};

const composition all[] = {
    {"2d_quadratic_flip_usl_minus_waves_threads",
     [](account& out) { large(out, hall(), plate, kept{}, quadratic_spline{}, flip{}, swaying<2>(), two_threads()); }},
    {"2d_linear_fmpm4_usl_plus_waves",
     [](account& out) {
         large(out, hall(), plate, kept{}, linear{}, fmpm<4>{}, usl_plus{}, gravity{point<2, double>(0.3, -1)});
     }},
    {"2d_quadratic_xpic3_usf_waves_held",
     [](account& out) {
         large(out, hall(), plate, fields<>{}, quadratic_spline{}, xpic<3>{}, usf{}, swaying<2>(), held{});
     }},
    {"3d_linear_fmpm2_usl_minus_waves_threads",
     [](account& out) {
         const extent cube[3] = {{2.5, 18.5}, {2, 27}, {2, 26}};
         large(out, box_of<double>({24, 30, 30}), cube, kept{}, linear{}, fmpm<2>{}, swaying<3>(), two_threads());
     }},
};

}  // namespace
