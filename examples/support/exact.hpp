#pragma once
#include <cmath>
#include <numbers>

/// Exact answers of an elastic bar, 0 <= x <= 1, in one dimension: rho v_t = (E e)_x, e_t = v_x, c^2 = E/rho = 1.
namespace exact {

/// State of the bar at a place and a time: velocity (m/s), strain.
struct state {
    double velocity, strain;
};

/// The bar rings in its n-th mode, its ends fixed: v = v0 sin(n pi x) cos(n pi t), e = v0 cos(n pi x) sin(n pi t).
struct standing_wave {
    double v0;
    int n = 1;
    state operator()(double x, double t) const {
        const double k = n * std::numbers::pi;
        return {v0 * std::sin(k * x) * std::cos(k * t), v0 * std::cos(k * x) * std::sin(k * t)};
    }
    /// Kinetic and elastic energy (J): v0^2/4.
    double energy(double) const { return v0 * v0 / 4; }
};

/// The right end is driven with v0 sin(omega t), the left one is fixed. The wave g(s) = sin(omega s), s > 0, runs to
/// and fro between the two, each time as from another image of the driven end.
struct reflection {
    double v0, omega = 10;
    state operator()(double x, double t) const {
        state total{0, 0};
        for (double sent = 0; sent < t; sent += 2) {
            const double coming = g(t - sent - (1 - x)), going = g(t - sent - (1 + x));
            total.velocity += v0 * (coming - going);
            total.strain += v0 * (coming + going);
        }
        return total;
    }
    /// Energy (J): the work of the driven end, v0 g(t) times the stress there, v0 (g(t) + 2 g(t - 2) + 2 g(t - 4) +
    /// ...), integrated. Up to t = 2 that is v0^2 (t/2 - sin(2 omega t)/(4 omega)).
    double energy(double t) const {
        double sum = t / 2 - std::sin(2 * omega * t) / (4 * omega);
        for (double late = 2; late < t; late += 2)
            sum += (t - late) * std::cos(omega * late) -
                   (std::sin(omega * (2 * t - late)) - std::sin(omega * late)) / (2 * omega);
        return v0 * v0 * sum;
    }

  private:
    double g(double s) const { return s > 0 ? std::sin(omega * s) : 0; }
};

/// The left half starts with strain e0, all at rest. Between the fronts at 1/2 -+ t strain and velocity are e0/2 and
/// -e0/2; up to t = 1/2, when the fronts reach the ends.
struct shock {
    double e0;
    state operator()(double x, double t) const {
        if (x < 0.5 - t) return {0, e0};
        if (x >= 0.5 + t) return {0, 0};
        return {-e0 / 2, e0 / 2};
    }
    /// Energy (J): e0^2/4.
    double energy(double) const { return e0 * e0 / 4; }
};

}  // namespace exact
