#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

namespace reference {

/// The two of GIMP are the linear shape averaged over the particle's domain, a box along the axes that stays as it was
/// made (uniform) or takes the stretches F_dd of the particle (contiguous).
enum class shape_kind { linear, quadratic_spline, cubic_spline, uniform_gimp, contiguous_gimp };

inline bool is_gimp(shape_kind kind) { return kind == shape_kind::uniform_gimp || kind == shape_kind::contiguous_gimp; }

/// Integral of the linear shape from far left of its node to signed distance d, in spacings.
inline double tent_integral(double d) {
    if (d <= -1) return 0;
    if (d >= 1) return 1;
    return d < 0 ? (1 + d) * (1 + d) / 2 : 1 - (1 - d) * (1 - d) / 2;
}

/// The B-spline of the given kind at signed distance d from its node, in spacings. Source: the textbook pieces. For
/// GIMP the mean of the linear one over [d - half, d + half].
inline double bump(shape_kind kind, double d, double half = 0) {
    const double r = std::abs(d);
    switch (kind) {
        case shape_kind::linear:
            return r < 1 ? 1 - r : 0;
        case shape_kind::quadratic_spline:
            if (r < 0.5) return 0.75 - r * r;
            return r < 1.5 ? (1.5 - r) * (1.5 - r) / 2 : 0;
        case shape_kind::cubic_spline:
            if (r < 1) return 2. / 3 - r * r + r * r * r / 2;
            return r < 2 ? (2 - r) * (2 - r) * (2 - r) / 6 : 0;
        case shape_kind::uniform_gimp:
        case shape_kind::contiguous_gimp:
            return (tent_integral(d + half) - tent_integral(d - half)) / (2 * half);
    }
    throw std::logic_error("reference::bump: choose one of the kinds in shape_kind.");
}

/// Derivative of `bump` by d. At a kink of the linear shape it is the one to the right, so that a particle on a
/// node belongs to the cell that starts there. GIMP has the mean of the slope, which has no kinks.
inline double bump_slope(shape_kind kind, double d, double half = 0) {
    const double r = std::abs(d);
    const double sign = d < 0 ? -1 : 1;
    switch (kind) {
        case shape_kind::linear:
            return d >= -1 && d < 1 ? -sign : 0;
        case shape_kind::quadratic_spline:
            if (r < 0.5) return -2 * d;
            return r < 1.5 ? -sign * (1.5 - r) : 0;
        case shape_kind::cubic_spline:
            if (r < 1) return sign * (-2 * r + 1.5 * r * r);
            return r < 2 ? -sign * (2 - r) * (2 - r) / 2 : 0;
        case shape_kind::uniform_gimp:
        case shape_kind::contiguous_gimp:
            return (bump(shape_kind::linear, d + half) - bump(shape_kind::linear, d - half)) / (2 * half);
    }
    throw std::logic_error("reference::bump_slope: choose one of the kinds in shape_kind.");
}

/// What every node of one axis is worth at one place: weights (no unit) and their derivatives (1/length).
struct axis_values {
    Eigen::VectorXd weight;
    Eigen::VectorXd slope;
};

/// Evaluates all nodes lower + i spacing, i = 0 .. count - 1, at x. The ghost nodes beyond a wall continue the field in
/// a straight line, u_ghost = 2 u_wall - u_next for the first one, so its weight goes twice to the wall and once, with
/// a minus sign, to the next node. Splines see one ghost; so does GIMP up to a half width of one spacing. For the
/// linear shape the ghost only matters at the upper wall itself, where it turns the slope to the right (in the cell
/// that does not exist) into the slope of the last cell. `half_width` (a length) is of the particle's domain, for GIMP.
/// Throws std::domain_error if x lies outside the box or GIMP's domain has no width, std::invalid_argument if there are
/// fewer than two nodes.
inline axis_values evaluate_axis(shape_kind kind, double x, double lower, double spacing, Eigen::Index count,
                                 double half_width = 0) {
    if (count < 2) throw std::invalid_argument("reference: give every axis at least one cell.");
    const double last = static_cast<double>(count - 1);
    const double place = (x - lower) / spacing;
    const double slack = 1e-12 * last;  // rounding in `place` only
    if (!(place >= -slack && place <= last + slack))
        throw std::domain_error("reference: a particle has left the box; enlarge the box or shorten the run.");
    const double s = std::clamp(place, 0., last);
    const double half = half_width / spacing;
    if (is_gimp(kind) && !(half > 0 && std::isfinite(half)))
        throw std::domain_error("reference: give every particle a domain of positive width for GIMP.");

    axis_values values{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        values.weight[i] = bump(kind, s - static_cast<double>(i), half);
        values.slope[i] = bump_slope(kind, s - static_cast<double>(i), half) / spacing;
    }
    // The g-th ghost: u_ghost = (1 + g) u_wall - g u_next.
    const auto fold = [&](double ghost, double g, Eigen::Index wall, Eigen::Index next) {
        const double weight = bump(kind, s - ghost, half);
        const double slope = bump_slope(kind, s - ghost, half) / spacing;
        values.weight[wall] += (1 + g) * weight;
        values.weight[next] -= g * weight;
        values.slope[wall] += (1 + g) * slope;
        values.slope[next] -= g * slope;
    };
    const double ghosts = is_gimp(kind) ? std::ceil(half) : 1;
    for (double g = 1; g <= ghosts; ++g) {
        fold(-g, g, 0, 1);
        fold(last + g, g, count - 1, count - 2);
    }
    return values;
}

}  // namespace reference
