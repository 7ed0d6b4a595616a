#include "gas_wave.hpp"

#include "exact.hpp"
#include "require.hpp"
#include "summary.hpp"

#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/motion/motion.hpp>

#include <algorithm>
#include <cmath>

namespace gas_wave {

template <class Shape, class Motion> gas_wave_result run_with(const gas_wave_options& o);

}  // namespace gas_wave

namespace {

constexpr double omega = 10;

/// The elastic bar's answer, in which c = 1: v(x, t) of the gas is the bar's at the time c t, driven at omega/c.
exact::state acoustic(const gas_wave_exact& gas, double x, double t) {
    const double c = gas.wave_speed();
    const auto wave = [&](double share, double frequency) {
        return exact::reflection{share * gas.amplitude, frequency / c}(x, c * t);
    };
    if (!gas.smooth) return wave(1, omega);
    // sin^3 s = (3 sin s - sin 3s)/4
    const exact::state slow = wave(0.75, omega), fast = wave(-0.25, 3 * omega);
    return {slow.velocity + fast.velocity, slow.strain + fast.strain};
}

}  // namespace

double gas_wave_exact::wave_speed() const { return std::sqrt(gamma); }
double gas_wave_exact::drive(double t) const {
    const double s = t > 0 ? std::sin(omega * t) : 0;
    return amplitude * (smooth ? s * s * s : s);
}
double gas_wave_exact::velocity(double x, double t) const { return acoustic(*this, x, t).velocity; }
double gas_wave_exact::pressure(double x, double t) const {
    return 1 - gamma * acoustic(*this, x, t).strain / wave_speed();
}
double gas_wave_exact::finite_velocity(double x, double t) const {
    // Where the line that left the driven end at time s is now: it falls as s does, from x = 1 to the front.
    const auto place = [&](double s) { return 1 + ((gamma + 1) / 2 * drive(s) - wave_speed()) * (t - s); };
    if (x <= place(0)) return 0;
    double early = 0, late = t;
    for (int k = 0; k < 60; ++k) {
        const double middle = (early + late) / 2;
        (place(middle) < x ? early : late) = middle;
    }
    return drive((early + late) / 2);
}

gas_wave_result run_gas_wave(const gas_wave_options& o) {
    require_name("shape", o.shape, {"linear", "quadratic"});
    require_name("particles", o.particles, {"moving", "held"});
    require_name("rate", o.rate, {"motion", "admpm"});
    require_name("drive", o.drive, {"sine", "smooth"});
    const bool linear = o.shape == "linear";
    if (linear) {
        require_name("update", o.update, {"pic", "flip", "blend", "xpic", "fmpm"});
        if (o.has_order())
            require_name("stress (xpic, fmpm)", o.stress, {"usl-", "usavg-"});
        else
            require_name("stress", o.stress, {"usf", "usl-", "usl+", "usavg-", "euler"});
    } else {
        require_name("update (quadratic)", o.update, {"pic", "flip", "blend", "fmpm"});
        require_name("stress (quadratic)", o.stress, {"usl-", "usavg-"});
    }
    if (o.rate == "admpm" && o.particles == "moving") {
        require_name("update with the rate admpm", o.update, {"pic", "flip", "blend"});
        if (linear)
            require_name("stress with the rate admpm", o.stress, {"usl-", "euler"});
        else
            require_name("stress with the rate admpm (quadratic)", o.stress, {"usl-"});
    }
    if (o.times.empty() || !(o.times.front() > 0) ||
        std::adjacent_find(o.times.begin(), o.times.end(), std::greater_equal<>()) != o.times.end())
        throw unusable_option("times: give one or more, positive and ascending");
    const bool held = o.particles == "held";
    if (linear)
        return held ? gas_wave::run_with<tamis::linear, tamis::held>(o)
                    : gas_wave::run_with<tamis::linear, tamis::moving>(o);
    return held ? gas_wave::run_with<tamis::quadratic_spline, tamis::held>(o)
                : gas_wave::run_with<tamis::quadratic_spline, tamis::moving>(o);
}

std::string summary_of(const gas_wave_options& o, const gas_wave_result& r) {
    auto all = composition_of("gas_wave", o.cells, o.per_cell, o);
    all["particles"] = o.particles;
    all["rate"] = o.rate;
    all["drive"] = o.drive;
    all["gamma"] = o.gamma;
    all["amplitude"] = o.amplitude;
    put_cost(all, r.particles.size(), r.steps, r.wall_seconds);
    all["dt"] = r.dt;
    all["time"] = o.times.back();
    all["courant"] = std::sqrt(o.gamma) * r.dt * o.cells;
    auto records = nlohmann::ordered_json::array();
    for (const gas_wave_record& at : r.records) {
        nlohmann::ordered_json one;
        one["time"] = at.time;
        one["velocity_l2"] = at.velocity_l2;
        one["velocity_max"] = at.velocity_max;
        one["pressure_l2"] = at.pressure_l2;
        one["pressure_max"] = at.pressure_max;
        one["velocity_l2_finite"] =
            std::isfinite(at.velocity_l2_finite) ? nlohmann::ordered_json(at.velocity_l2_finite) : nullptr;
        one["kinetic"] = at.kinetic;
        one["internal"] = at.internal;
        one["boundary_work"] = at.boundary_work;
        records.push_back(one);
    }
    all["velocity_l2"] = r.records.back().velocity_l2;
    all["velocity_max"] = r.records.back().velocity_max;
    all["energy_initial"] = 0;
    all["energy_final"] = r.records.back().kinetic + r.records.back().internal;
    all["boundary_work"] = r.records.back().boundary_work;
    all["mass"] = r.mass;
    all["momentum"] = r.momentum;
    all["records"] = records;
    return all.dump(2) + "\n";
}
