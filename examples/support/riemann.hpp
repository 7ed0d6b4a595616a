#pragma once
#include <cmath>
#include <stdexcept>

/// Exact solution of the Riemann problem of an ideal gas (Toro, *Riemann Solvers and Numerical Methods for Fluid
/// Dynamics*, 3rd edition, chapter 4).
namespace riemann {

struct state {
    double density, velocity, pressure;
};

class solution {
  public:
    /// Two gases of the same gamma that meet at x = 0 at t = 0. Throws std::invalid_argument if vacuum would appear.
    solution(double gamma, const state& left, const state& right) : gamma_(gamma), left_(left), right_(right) {
        const double c_left = sound(left), c_right = sound(right);
        if (2 * (c_left + c_right) / (gamma - 1) <= right.velocity - left.velocity)
            throw std::invalid_argument("riemann: vacuum appears between the two gases");
        // f rises monotonically with p: bisection of the logarithm.
        double low = 1e-14 * std::fmin(left.pressure, right.pressure);
        double high = 1e3 * std::fmax(left.pressure, right.pressure);
        while (velocity_jump(high) < 0) high *= 1e3;
        for (int k = 0; k < 200; ++k) {
            const double middle = std::sqrt(low * high);
            (velocity_jump(middle) < 0 ? low : high) = middle;
        }
        pressure_ = std::sqrt(low * high);
        velocity_ = (left.velocity + right.velocity + wave(pressure_, right) - wave(pressure_, left)) / 2;
    }
    /// Between the outer waves.
    double pressure() const { return pressure_; }
    double velocity() const { return velocity_; }
    double density_left() const { return behind(left_); }
    double density_right() const { return behind(right_); }
    /// Speed of the right wave: of the shock, or of the rarefaction's head.
    double right_front() const {
        return pressure_ > right_.pressure ? right_.velocity + sound(right_) * mach(right_)
                                           : right_.velocity + sound(right_);
    }
    /// At x/t = s.
    state at(double s) const { return s < velocity_ ? side(s, left_, 1) : mirrored(side(-s, mirrored(right_), -1)); }

  private:
    double gamma_;
    state left_, right_;
    double pressure_ = 0, velocity_ = 0;

    double sound(const state& w) const { return std::sqrt(gamma_ * w.pressure / w.density); }
    double mach(const state& w) const {
        return std::sqrt((gamma_ + 1) / (2 * gamma_) * pressure_ / w.pressure + (gamma_ - 1) / (2 * gamma_));
    }
    static state mirrored(const state& w) { return {w.density, -w.velocity, w.pressure}; }
    /// Change of velocity across the wave into w (Toro 4.6, 4.7).
    double wave(double p, const state& w) const {
        if (p > w.pressure) {
            const double A = 2 / ((gamma_ + 1) * w.density), B = (gamma_ - 1) / (gamma_ + 1) * w.pressure;
            return (p - w.pressure) * std::sqrt(A / (p + B));
        }
        return 2 * sound(w) / (gamma_ - 1) * (std::pow(p / w.pressure, (gamma_ - 1) / (2 * gamma_)) - 1);
    }
    double velocity_jump(double p) const { return wave(p, left_) + wave(p, right_) + right_.velocity - left_.velocity; }
    /// Density behind the wave into w (Toro 4.50, 4.53).
    double behind(const state& w) const {
        const double ratio = pressure_ / w.pressure, g = (gamma_ - 1) / (gamma_ + 1);
        return pressure_ > w.pressure ? w.density * (ratio + g) / (g * ratio + 1)
                                      : w.density * std::pow(ratio, 1 / gamma_);
    }
    /// Left of the contact: w is the undisturbed gas there, `sign` -1 where the picture is a mirror image.
    state side(double s, const state& w, int sign) const {
        const double u = sign * velocity_;
        if (pressure_ > w.pressure) {
            const double front = w.velocity - sound(w) * mach(w);
            return s < front ? w : state{behind(w), u, pressure_};
        }
        const double c = sound(w), c_behind = c * std::pow(pressure_ / w.pressure, (gamma_ - 1) / (2 * gamma_));
        if (s < w.velocity - c) return w;
        if (s > u - c_behind) return {behind(w), u, pressure_};
        const double inside = 2 / (gamma_ + 1) + (gamma_ - 1) / ((gamma_ + 1) * c) * (w.velocity - s);
        return {w.density * std::pow(inside, 2 / (gamma_ - 1)),
                2 / (gamma_ + 1) * (c + (gamma_ - 1) / 2 * w.velocity + s),
                w.pressure * std::pow(inside, 2 * gamma_ / (gamma_ - 1))};
    }
};

}  // namespace riemann
