// 1D: other numbers and lanes, the exact mass matrix, a run by `integrate`, all boundary methods by name.
#include "bits.hpp"
#include "optional.hpp"

using namespace bits;

namespace {

const composition all[] = {
    {"1d_linear_exact_fmpm_usl_minus",
     [](account& out) {
         // Nodes at the free end have little mass, and its inverse is exact: not for long, not far.
         solver mpm{box<1>(), linear{}, exact_fmpm<>{}, usl_minus{}, swaying<1>()};
         auto bar = rough_body(mpm, rubber(), middle<1>);
         roughen(bar, 0.9, 0.1, 0.1);
         steps(mpm, 6, step_size, bar);
         put_all(out, mpm, bar);
     }},
    {"1d_quadratic_flip_usl_minus_held_float",
     [](account& out) {
         one_body(out, box<1, float>(), middle<1>, rubber(), kept{}, quadratic_spline{}, flip{}, usl_minus{},
                  swaying<1, float>(), held{});
     }},
    {"1d_cubic_fmpm_dynamic_usavg_minus_one_lane",
     [](account& out) {
         block<1>(out, fields<>{}, cubic_spline{}, fmpm<dynamic>{3}, usavg_minus{}, one_lane{}, swaying<1>());
     }},
    {"1d_quadratic_flip_usl_minus_integrate",
     [](account& out) {
         const auto wall = fixed{[](const auto& at) { return at[0] < corner + 4.1 * side; }};
         solver mpm{box<1>(), quadratic_spline{}, flip{}, usl_minus{}, wall};
         auto bar = rough_body(mpm, rubber(), middle<1>);
         roughen(bar, 1, 0.3, 0.5);
         out.tell("lightest_free_node", mpm.lightest_free_node(bodies(bar)));
         out.tell("count", static_cast<double>(integrate(mpm, bodies(bar), {0, 0.25}, courant{0.3})));
         put_all(out, mpm, bar);
     }},
    {"1d_linear_fmpm_dynamic_usf_chosen_methods",
     [](account& out) {
         for (const char* name :
              {"incremental", "lumped", "velocity", "combined", "unlumped1", "unlumped2", "partial", "collected"}) {
             solver mpm{box<1>(), linear{}, fmpm<dynamic>{3}, usf{}, boundary_method::chosen{name}, swaying<1>()};
             auto bar = rough_body(mpm, rubber(), middle<1>);
             roughen(bar, 0.6, 0.3, 0.5);
             steps(mpm, 10, step_size, bar);
             out.tell(name, 0);
             put_all(out, mpm, bar);
         }
     }},
};

}  // namespace
