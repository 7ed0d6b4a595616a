// Bodies with velocities of their own.
#include "bits.hpp"

using namespace bits;

namespace {

/// Two bodies of different laws that fly into each other, the second above and to the right of the first.
template <int D, class... Policies> void collide(account& out, const Policies&... policies) {
    auto mpm = solver_of(box<D>(), policies...);
    constexpr extent along = D == 2 ? extent{10, 18} : extent{7, 12.5};
    auto one = rough_body(mpm, rubber(), {{1.5, along.from}, {1.5, 5.}, {1.5, 4}});
    auto two = rough_body(mpm, varying_elastic{.young = 5.3, .poisson = 0.2, .density = 1.1},
                          {along, {2.5, 6.5}, {1.5, 4}}, fields<>{}, 8);
    roughen(one, 1, 0.4, 0.5);
    roughen(two, -0.6, 0.4, 0.5);
    steps(mpm, 14, step_size, one, two);
    put_all(out, mpm, one, two);
}
const given_normal across{point<2, double>(0.8, 0.6)};

const composition all[] = {
    {"2d_quadratic_fmpm2_coulomb_by_mass_incremental",
     [](account& out) {
         collide<2>(out, quadratic_spline{}, fmpm<2>{}, contact{coulomb{0.3}, normal_by_mass{}, by_approach{}},
                    swaying<2>());
     }},
    {"2d_linear_flip_usf_frictionless_given_by_separation",
     [](account& out) {
         collide<2>(out, linear{}, flip{}, usf{}, contact{frictionless{}, across, by_separation{1.1}});
     }},
    {"2d_quadratic_xpic2_bonded_filtered",
     [](account& out) {
         collide<2>(out, quadratic_spline{}, xpic<2>{},
                    contact{bonded{}, normal_by_mass{}, by_approach{}, contact_method::filtered{}});
     }},
    {"2d_linear_fmpm4_coulomb_by_mass_net",
     [](account& out) {
         collide<2>(out, linear{}, fmpm<4>{},
                    contact{coulomb{0.2}, normal_by_mass{}, by_separation{1.3}, contact_method::net{}});
     }},
    {"2d_quadratic_fmpm2_usavg_plus_coulomb_given_velocity",
     [](account& out) {
         collide<2>(out, quadratic_spline{}, fmpm<2>{}, usavg_plus{},
                    contact{coulomb{0.4}, across, by_approach{}, contact_method::velocity{}});
     }},
    {"2d_linear_fmpm_dynamic_frictionless_lumped_held",
     [](account& out) {
         collide<2>(out, linear{}, fmpm<dynamic>{3}, held{},
                    contact{frictionless{}, normal_by_mass{}, by_approach{}, contact_method::lumped{}});
     }},
    {"3d_linear_flip_coulomb_by_mass",
     [](account& out) {
         collide<3>(out, linear{}, flip{}, contact{coulomb{0.3}, normal_by_mass{}, by_approach{}});
     }},
};

}  // namespace
