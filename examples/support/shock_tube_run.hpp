#pragma once
#include "choose.hpp"
#include "shock_tube.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

// Named types, not lambdas inside `run`: what is compiled for them is shared by all compositions.
namespace shock_tube {

struct both_ends {
    bool operator()(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
};
struct half {
    bool on_the_left;
    bool operator()(const auto& at) const { return (at[0] < 0.5) == on_the_left; }
};

/// What the bodies tell; it does not depend on the update and the stress order, so it is compiled for few types.
template <class Body> double energy_of(const Body& left, const Body& right) {
    return kinetic_energy(left) + kinetic_energy(right) + elastic_energy(left) + elastic_energy(right);
}
template <class Body> void collect(const tube& set, const Body& left, const Body& right, tube_result& result) {
    using namespace tamis::symbols;
    const auto add = [&](const Body& gas) {
        for (const auto p : gas) {
            const double e = p[tamis::field::internal_energy{}];
            result.particles.push_back({p[x][0], p[rho], p[v][0], (set.gamma - 1) * p[rho] * e, e});
        }
    };
    add(left);
    result.left_count = result.particles.size();
    add(right);
    const auto by_place = [](const tube_particle& a, const tube_particle& b) { return a.x < b.x; };
    const auto middle = result.particles.begin() + static_cast<std::ptrdiff_t>(result.left_count);
    result.contact = (std::max_element(result.particles.begin(), middle, by_place)->x +
                      std::min_element(middle, result.particles.end(), by_place)->x) /
                     2;
    std::sort(result.particles.begin(), result.particles.end(), by_place);
    result.momentum = total_momentum(left)[0] + total_momentum(right)[0];
}

template <class Shape, class Scheme, class Order>
tube_result run(const tube& set, const Scheme& scheme, const Order& order) {
    using namespace tamis;
    const double h = 1. / set.cells;
    const fixed ends{both_ends{}};
    solver mpm{uniform_grid{{0.}, {1.}, h}, Shape{}, scheme, order, ends};
    const artificial_viscosity q{.length = h, .linear = set.linear, .quadratic = set.quadratic};
    const auto gas = [&](const riemann::state& of, bool on_the_left) {
        return mpm.make_body(shocked_gas{set.gamma, of.density, of.pressure, q}, half{on_the_left},
                             per_cell{set.per_cell}, fields<field::density>{});
    };
    auto left = gas(set.left, true), right = gas(set.right, false);
    tube_result result;
    result.energy_start = energy_of(std::as_const(left), std::as_const(right));
    const auto clock = std::chrono::steady_clock::now();
    result.steps = integrate(mpm, bodies(left, right), interval{0, set.time}, courant{set.courant});
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    result.energy_end = energy_of(std::as_const(left), std::as_const(right));
    result.boundary_work = mpm.boundary_work();
    collect(set, std::as_const(left), std::as_const(right), result);
    return result;
}

/// What can be chosen for one shape: each of the three is compiled by itself. Quadratic splines come with all updates
/// and stress orders, the others with those that are of use (docs/gas.md).
template <class Shape> tube_result run_with(const shock_tube_options& o) {
    const auto with = [&](const auto& update) {
        const auto run_order = [&](const auto& order) { return run<Shape>(o.set, update, order); };
        if constexpr (std::same_as<Shape, tamis::quadratic_spline>) {
            return choose::stress_order(o.stress, run_order);
        } else {
            if constexpr (!std::same_as<Shape, tamis::linear>) {
                if (o.stress == "usavg+") return run_order(tamis::usavg_plus{});
            } else if constexpr (std::same_as<std::remove_cvref_t<decltype(update)>, tamis::blend>) {
                if (o.stress == "euler") return run_order(tamis::euler{});
            }
            return o.stress == "usl-" ? run_order(tamis::usl_minus{}) : run_order(tamis::usavg_minus{});
        }
    };
    if constexpr (!std::same_as<Shape, tamis::linear>)
        if (o.update == "xpic") return with(tamis::xpic<tamis::dynamic>{o.order});
    if (o.update == "fmpm") return with(tamis::fmpm<tamis::dynamic>{o.order});
    return with(choose::blend_of(o.update, o.alpha));
}

}  // namespace shock_tube
