#pragma once
#include <tamis/tamis.hpp>

#include "riemann.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

/// A shock tube, 0 <= x <= 1 m: two ideal gases at rest meet at 1/2. By default Sod's.
struct tube {
    double gamma = 1.4;
    riemann::state left{1, 0, 1}, right{0.125, 0, 0.1};
    int cells = 200, per_cell = 4;
    double time = 0.2, courant = 0.2;
    double linear = 0.5, quadratic = 2;  // artificial viscosity
};

struct tube_particle {
    double x, density, velocity, pressure, energy;
};
struct tube_result {
    std::vector<tube_particle> particles;  // in the order of x
    std::size_t left_count = 0;            // of the left gas
    long steps = 0;
    double wall_seconds = 0;
    double energy_start = 0, energy_end = 0, boundary_work = 0, momentum = 0;
    double density_l1 = 0, velocity_l1 = 0, pressure_l1 = 0;  // integrals of |error| over the tube
    double contact = 0, shock = 0;                            // places
    riemann::state behind_shock{}, behind_contact{};          // means over the middle of both plateaus
};

/// Runs the tube with a scheme and a stress order. Throws `tamis::error` if it fails.
template <class Shape, class Scheme, class Order>
tube_result run_tube(const tube& set, const Shape& shape, const Scheme& scheme, const Order& order) {
    using namespace tamis;
    using namespace tamis::symbols;
    const double h = 1. / set.cells;
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, h}, shape, scheme, order, ends};
    const artificial_viscosity q{.length = h, .linear = set.linear, .quadratic = set.quadratic};
    const shocked_gas heavy{set.gamma, set.left.density, set.left.pressure, q};
    const shocked_gas light{set.gamma, set.right.density, set.right.pressure, q};
    auto left = mpm.make_body(
        heavy, [](const auto& at) { return at[0] < 0.5; }, per_cell{set.per_cell}, fields<field::density>{});
    auto right = mpm.make_body(
        light, [](const auto& at) { return at[0] > 0.5; }, per_cell{set.per_cell}, fields<field::density>{});

    tube_result result;
    const auto energy = [&] {
        return kinetic_energy(left) + kinetic_energy(right) + elastic_energy(left) + elastic_energy(right);
    };
    result.energy_start = energy();
    const auto clock = std::chrono::steady_clock::now();
    result.steps = integrate(mpm, bodies(left, right), interval{0, set.time}, courant{set.courant});
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
    result.energy_end = energy();
    result.boundary_work = mpm.boundary_work();
    result.momentum = total_momentum(left)[0] + total_momentum(right)[0];

    const auto collect = [&](const auto& gas) {
        for (const auto p : gas)
            result.particles.push_back({p[x][0], p[rho], p[v][0],
                                        (set.gamma - 1) * p[rho] * p[field::internal_energy{}],
                                        p[field::internal_energy{}]});
    };
    collect(std::as_const(left));
    result.left_count = result.particles.size();
    collect(std::as_const(right));
    const auto by_place = [](const tube_particle& a, const tube_particle& b) { return a.x < b.x; };
    const auto middle = result.particles.begin() + static_cast<std::ptrdiff_t>(result.left_count);
    result.contact = (std::max_element(result.particles.begin(), middle, by_place)->x +
                      std::min_element(middle, result.particles.end(), by_place)->x) /
                     2;
    std::sort(result.particles.begin(), result.particles.end(), by_place);
    return result;
}

/// Errors, plateaus and fronts against the exact answer.
inline void measure(const tube& set, tube_result& result) {
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
}
