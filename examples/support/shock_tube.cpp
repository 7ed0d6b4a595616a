#include "shock_tube.hpp"

#include "require.hpp"
#include "summary.hpp"

#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <cmath>

namespace shock_tube {

template <class Shape> tube_result run_with(const shock_tube_options& o);

}  // namespace shock_tube

void measure(const tube& set, tube_result& result) {
    const riemann::solution exact(set.gamma, set.left, set.right);
    const double t = set.time;
    const auto& all = result.particles;
    for (std::size_t k = 0; k < all.size(); ++k) {
        // A particle stands for the length between the middles to its neighbours.
        const double from = k == 0 ? 0 : (all[k - 1].x + all[k].x) / 2;
        const double to = k + 1 == all.size() ? 1 : (all[k].x + all[k + 1].x) / 2;
        const riemann::state w = exact.at((all[k].x - 0.5) / t);
        result.density_l1 += std::abs(all[k].density - w.density) * (to - from);
        result.velocity_l1 += std::abs(all[k].velocity - w.velocity) * (to - from);
        result.pressure_l1 += std::abs(all[k].pressure - w.pressure) * (to - from);
    }
    // Where the density comes through the mean of both sides of the shock, from the right.
    const double half = (exact.density_right() + set.right.density) / 2;
    for (std::size_t k = all.size() - 1; k > 0; --k)
        if (all[k - 1].density >= half) {
            const double share = (all[k - 1].density - half) / (all[k - 1].density - all[k].density);
            result.shock = all[k - 1].x + share * (all[k].x - all[k - 1].x);
            break;
        }
    const auto mean = [&](double from, double to) {
        riemann::state sum{0, 0, 0};
        double n = 0;
        for (const tube_particle& p : all)
            if (p.x > from + 0.25 * (to - from) && p.x < to - 0.25 * (to - from)) {
                sum = {sum.density + p.density, sum.velocity + p.velocity, sum.pressure + p.pressure};
                n += 1;
            }
        return riemann::state{sum.density / n, sum.velocity / n, sum.pressure / n};
    };
    const double contact = 0.5 + exact.velocity() * t, shock = 0.5 + exact.right_front() * t;
    const double c = std::sqrt(set.gamma * exact.pressure() / exact.density_left());
    result.behind_shock = mean(contact, shock);
    result.behind_contact = mean(0.5 + (exact.velocity() - c) * t, contact);
    result.contact_off = (result.contact - contact) * set.cells;
    result.shock_off = (result.shock - shock) * set.cells;
}

void shock_tube_options::pressure_ratio(double ratio) {
    set.left = {1, 0, ratio};
    set.right = {1, 0, 1};
    set.time = 0.3 / riemann::solution(set.gamma, set.left, set.right).right_front();
}

shock_tube_result run_shock_tube(const shock_tube_options& o) {
    require_name("shape", o.shape, {"linear", "quadratic", "cubic"});
    if (o.shape == "linear") {
        require_name("update (linear)", o.update, {"pic", "flip", "blend", "fmpm"});
        if (o.update == "fmpm")
            require_name("stress (linear, fmpm)", o.stress, {"usl-", "usavg-"});
        else
            require_name("stress (linear)", o.stress, {"usl-", "usavg-", "euler"});
    } else {
        require_name("update", o.update, {"pic", "flip", "blend", "xpic", "fmpm"});
        if (o.shape == "cubic")
            require_name("stress (cubic)", o.stress, {"usl-", "usavg-", "usavg+"});
        else
            require_name("stress", o.stress, {"usf", "usl-", "usl+", "usavg-", "usavg+"});
    }
    const auto run = o.shape == "linear"      ? &shock_tube::run_with<tamis::linear>
                     : o.shape == "quadratic" ? &shock_tube::run_with<tamis::quadratic_spline>
                                              : &shock_tube::run_with<tamis::cubic_spline>;
    tube_result result = run(o);
    measure(o.set, result);
    return result;
}

std::string summary_of(const shock_tube_options& o, const shock_tube_result& r) {
    const tube& set = o.set;
    auto all = composition_of("shock_tube", set.cells, set.per_cell, o);
    all["pressure_ratio"] = set.left.pressure / set.right.pressure;
    all["viscosity_linear"] = set.linear;
    all["viscosity_quadratic"] = set.quadratic;
    put_cost(all, r.particles.size(), r.steps, r.wall_seconds);
    all["time"] = set.time;
    all["courant"] = set.courant;
    all["density_l1"] = r.density_l1;
    all["velocity_l1"] = r.velocity_l1;
    all["pressure_l1"] = r.pressure_l1;
    all["contact_off_in_cells"] = r.contact_off;
    all["shock_off_in_cells"] = r.shock_off;
    all["density_behind_shock"] = r.behind_shock.density;
    all["velocity_behind_shock"] = r.behind_shock.velocity;
    all["pressure_behind_shock"] = r.behind_shock.pressure;
    all["density_behind_contact"] = r.behind_contact.density;
    all["energy_initial"] = r.energy_start;
    all["energy_final"] = r.energy_end;
    all["boundary_work"] = r.boundary_work;
    all["momentum"] = r.momentum;
    return all.dump(2) + "\n";
}
