// Loads, damping, node fields to read.
#include "bits.hpp"

using namespace bits;

namespace {

/// An acceleration by what particles carry.
struct pull_home {
    static constexpr bool by_fields = true;
    using on_particles = fields<const origin>;
    auto acceleration_of(auto p, double t) const {
        auto b = p[origin{}];
        using T = typename decltype(b)::Scalar;
        for (int d = 0; d < static_cast<int>(b.size()); ++d) b[d] = b[d] * constant<T>(t - 1);
        return b;
    }
};

const composition all[] = {
    {"1d_linear_flip_usl_minus_loads",
     [](account& out) {
         const auto swirl = [](const auto& x, const auto& v, double t) { return (x * -0.3 + v * (0.1 + t)).eval(); };
         block<1>(out, kept{}, linear{}, flip{},
                  loads{body_acceleration{swirl}, particle_damping{0.7}, grid_damping{[](double t) { return 1 + t; }}});
     }},
    {"2d_quadratic_flip_usl_minus_loads",
     [](account& out) {
         using vec = point<2, double>;
         const loads load{
             gravity{vec(0.3, -9)},
             particle_force{[](const auto& x) { return x[0] < 1; },
                            [](const auto& x, double t) { return vec(0.05 * x[1], t); }},
             traction{everywhere, [](const auto& x, const auto& n, double t) { return (n * (x[0] - 1 + t)).eval(); }},
             grid_damping{1.9}};
         auto mpm = solver_of(box<2>(), quadratic_spline{}, flip{}, load, swaying<2>());
         const auto disk = [](const auto& at) { return (at - vec(0.8, 0.5)).norm() < 0.65; };
         auto body = mpm.make_body(rubber(), disk, per_cell{2});
         roughen(body, 1.2, 0.4, 0.5);
         steps(mpm, 14, step_size, body);
         put_all(out, mpm, body);
     }},
    {"2d_linear_fmpm2_usl_minus_full_acceleration_held",
     [](account& out) {
         block<2>(out, kept{}, linear{}, fmpm<2>{}, read_out<field::full_acceleration>{}, swaying<2>(), held{},
                  pull_home{});
     }},
    {"2d_quadratic_fmpm_dynamic_full_acceleration_kinetic_feedback",
     [](account& out) {
         auto mpm = solver_of(box<2>(), quadratic_spline{}, fmpm<dynamic>{3}, swaying<2>(),
                              read_out<field::full_acceleration>{}, kinetic_feedback{0.2, 1.1, 9.7});
         auto body = rough_body(mpm, rubber(), middle<2>);
         roughen(body, 1.2, 0.4, 0.5);
         long k = 0;
         for (const double entry : mpm.inverse_column(bodies(body), {7, 4, 0})) put(out, "", "inverse", k++, entry);
         out.tell("lightest_free_node", mpm.lightest_free_node(bodies(body)));
         steps(mpm, 14, step_size, body);
         put_all(out, mpm, body);
     }},
    {"3d_linear_xpic2_usl_minus_traction",
     [](account& out) {
         const auto push = [](const auto& x, const auto& n, double t) { return (n * (x[1] - 1 - t)).eval(); };
         const auto ends = [](const auto&, const auto& n) { return n[0] != 0; };
         auto mpm = solver_of(box<3>(), linear{}, xpic<2>{}, traction{ends, push});
         const auto block_of = [](const auto& at) { return at[0] > 0.2 && at[0] < 1.8 && at[1] > 0 && at[1] < 0.7; };
         auto body = mpm.make_body(rubber(), block_of, per_cell{2});
         roughen(body, 0.6, 0.3, 0.5);
         steps(mpm, 10, step_size, body);
         put_all(out, mpm, body);
     }},
};

}  // namespace
