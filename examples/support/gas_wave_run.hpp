#pragma once
#include "choose.hpp"
#include "gas_wave.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace gas_wave {

/// Both ends are held, the right one at its speed.
struct ends {
    double amplitude, omega = 10;
    bool smooth = false;
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    auto velocity(const auto& at, double t) const {
        auto u = (at * 0).eval();
        const double s = std::sin(omega * t);
        if (at[0] >= 1) u[0] = amplitude * (smooth ? s * s * s : s);
        return u;
    }
};

/// What is measured of a body: it knows its type, but not the update and the stress order.
template <class Body> gas_wave_record measure(const Body& gas, const gas_wave_exact& exact, double t) {
    using namespace tamis::symbols;
    gas_wave_record r;
    const double c = exact.wave_speed(), p_scale = exact.gamma * exact.amplitude / c;
    for (const auto p : gas) {
        const double dv = std::abs(p[v][0] - exact.velocity(p[x][0], t)) / exact.amplitude;
        const double dp = std::abs(p[tamis::field::pressure{}] - exact.pressure(p[x][0], t)) / p_scale;
        const double df = std::abs(p[v][0] - exact.finite_velocity(p[x][0], t)) / exact.amplitude;
        r.velocity_l2 += dv * dv;
        r.pressure_l2 += dp * dp;
        r.velocity_l2_finite += df * df;
        r.velocity_max = std::max(r.velocity_max, dv);
        r.pressure_max = std::max(r.pressure_max, dp);
    }
    const auto mean = [&](double sum) { return std::sqrt(sum / static_cast<double>(gas.size())); };
    r.time = t;
    r.velocity_l2 = mean(r.velocity_l2);
    r.pressure_l2 = mean(r.pressure_l2);
    r.velocity_l2_finite = c * t < 1 ? mean(r.velocity_l2_finite) : std::numeric_limits<double>::quiet_NaN();
    r.kinetic = kinetic_energy(gas);
    r.internal = elastic_energy(gas);
    return r;
}

template <class Shape, class Motion, class Gas, class Update, class Order>
gas_wave_result run(const gas_wave_options& o, const Update& update, const Order& order) {
    using namespace tamis;
    using namespace tamis::symbols;
    const gas_wave_exact exact{o.gamma, o.amplitude, o.drive == "smooth"};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / o.cells}, Shape{}, update, order, Motion{},
               ends{o.amplitude, 10, exact.smooth}};
    auto gas = mpm.make_body(Gas{o.gamma, 1, 1, 1}, everywhere, per_cell{o.per_cell});
    gas_wave_result result;
    double from = 0;
    for (const double t : o.times) {
        const double needed = (t - from) * exact.wave_speed() * o.cells / o.courant;
        const long steps = std::max(1L, static_cast<long>(std::ceil(needed * (1 - 1e-12))));
        const auto begun = std::chrono::steady_clock::now();
        result.steps += integrate(mpm, bodies(gas), interval{from, t}, fixed_steps{steps});
        result.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        result.dt = (t - from) / static_cast<double>(steps);
        from = t;
        result.records.push_back(measure(std::as_const(gas), exact, t));
        result.records.back().boundary_work = mpm.boundary_work();
    }
    for (const auto p : std::as_const(gas)) result.particles.push_back({p[x][0], p[v][0], p[field::pressure{}]});
    std::sort(result.particles.begin(), result.particles.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
    result.mass = total_mass(std::as_const(gas));
    result.momentum = total_momentum(std::as_const(gas))[0];
    return result;
}

/// All that can be chosen for one shape and motion: each of the four is compiled by itself. Linear functions, which
/// ADMPM has, come with all updates, PIC and FLIP with all stress orders too; quadratic splines with those that are of
/// use.
template <class Shape, class Motion> gas_wave_result run_with(const gas_wave_options& o) {
    constexpr bool linear = std::same_as<Shape, tamis::linear>;
    const auto with_order = [&](const auto& update) {
        const auto by_motion = [&](const auto& order) {
            return run<Shape, Motion, tamis::pressure_gas>(o, update, order);
        };
        if constexpr (linear && std::same_as<std::remove_cvref_t<decltype(update)>, tamis::blend>) {
            if (o.stress == "usf") return by_motion(tamis::usf{});
            if (o.stress == "usl+") return by_motion(tamis::usl_plus{});
            if (o.stress == "euler") return by_motion(tamis::euler{});
        }
        return o.stress == "usavg-" ? by_motion(tamis::usavg_minus{}) : by_motion(tamis::usl_minus{});
    };
    if (o.update == "fmpm") return with_order(tamis::fmpm<tamis::dynamic>{o.order});
    if constexpr (linear)
        if (o.update == "xpic") return with_order(tamis::xpic<tamis::dynamic>{o.order});
    const tamis::blend mix = choose::blend_of(o.update, o.alpha);
    if constexpr (Motion::moves)
        if (o.rate == "admpm") {
            if constexpr (linear)
                if (o.stress == "euler") return run<Shape, Motion, tamis::admpm_gas>(o, mix, tamis::euler{});
            return run<Shape, Motion, tamis::admpm_gas>(o, mix, tamis::usl_minus{});
        }
    return with_order(mix);
}

}  // namespace gas_wave
