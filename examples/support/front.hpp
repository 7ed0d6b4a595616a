#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

/// A particle of the bar: place (m), velocity (m/s), strain.
struct bar_particle {
    double x, velocity, strain;
};

/// Where the two fronts are at a time.
struct front_places {
    double t, left, right;
};

/// Place where |strain| first crosses a level between two particles, in the order given, interpolated linearly; NaN if
/// nowhere.
template <class Iterator> double first_crossing(Iterator begin, Iterator end, double level) {
    for (auto a = begin, b = a; a != end && ++b != end; ++a) {
        const double at_a = std::abs(a->strain) - level, at_b = std::abs(b->strain) - level;
        if (at_a == 0) return a->x;
        if (at_a * at_b < 0) return a->x + (b->x - a->x) * at_a / (at_a - at_b);
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Fronts of the shock, particles in the order of x: where |strain| is half way from its plateau A/2 to A, coming from
/// the left, and to 0, coming from the right. Ahead of a front all is quiet; the scheme's ripples follow it.
inline front_places find_fronts(double t, const std::vector<bar_particle>& sorted, double amplitude) {
    return {t, first_crossing(sorted.begin(), sorted.end(), 0.75 * amplitude),
            first_crossing(sorted.rbegin(), sorted.rend(), 0.25 * amplitude)};
}

/// Speed of the fronts (m/s): slopes of x(t), each fitted by least squares to the places from a quarter of the last
/// time on, when both fronts have taken their form; mean of the two.
inline double front_speed(const std::vector<front_places>& places) {
    if (places.empty()) return std::numeric_limits<double>::quiet_NaN();
    double n = 0, t = 0, tt = 0, x = 0, tx = 0;
    for (const auto& p : places) {
        if (p.t < places.back().t / 4) continue;
        const double half_distance = (p.right - p.left) / 2;
        n += 1;
        t += p.t;
        tt += p.t * p.t;
        x += half_distance;
        tx += p.t * half_distance;
    }
    return (n * tx - t * x) / (n * tt - t * t);
}

/// How far |strain| goes beyond the plateau A/2 behind the fronts at time t, over A/2: above it on the right, below it
/// on the left, in the outer half of each front's way. (In the inner half a trace of the first jump may stay.)
inline double overshoot(double t, const std::vector<bar_particle>& particles, double amplitude) {
    const double plateau = amplitude / 2;
    double most = 0;
    for (const auto& p : particles) {
        if (std::abs(p.x - 0.5) < t / 2) continue;
        const double beyond = p.x > 0.5 ? std::abs(p.strain) - plateau : plateau - std::abs(p.strain);
        most = std::max(most, beyond / plateau);
    }
    return most;
}
