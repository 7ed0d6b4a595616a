#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

namespace reference {

enum class shape_kind { linear, quadratic_spline, cubic_spline };

/// The B-spline of the given kind at signed distance d from its node, in spacings. Source: the textbook pieces.
inline double bump(shape_kind kind, double d) {
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
    }
    throw std::logic_error("reference::bump: choose one of the kinds in shape_kind.");
}

/// Derivative of `bump` by d. At a kink of the linear shape it is the one to the right, so that a particle on a
/// node belongs to the cell that starts there.
inline double bump_slope(shape_kind kind, double d) {
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
    }
    throw std::logic_error("reference::bump_slope: choose one of the kinds in shape_kind.");
}

/// What every node of one axis is worth at one place: weights (no unit) and their derivatives (1/length).
struct axis_values {
    Eigen::VectorXd weight;
    Eigen::VectorXd slope;
};

/// Evaluates all nodes lower + i spacing, i = 0 .. count - 1, at x. The one ghost node beyond each wall continues the
/// field in a straight line, u_ghost = 2 u_wall - u_next, so its weight goes twice to the wall and once, with a minus
/// sign, to the next node. For the linear shape this only matters at the upper wall itself, where it turns the slope
/// to the right (in the cell that does not exist) into the slope of the last cell.
/// Throws std::domain_error if x lies outside the box, std::invalid_argument if there are fewer than two nodes.
inline axis_values evaluate_axis(shape_kind kind, double x, double lower, double spacing, Eigen::Index count) {
    if (count < 2) throw std::invalid_argument("reference: give every axis at least one cell.");
    const double last = static_cast<double>(count - 1);
    const double place = (x - lower) / spacing;
    const double slack = 1e-12 * last;  // rounding in `place` only
    if (!(place >= -slack && place <= last + slack))
        throw std::domain_error("reference: a particle has left the box; enlarge the box or shorten the run.");
    const double s = std::clamp(place, 0., last);

    axis_values values{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        values.weight[i] = bump(kind, s - static_cast<double>(i));
        values.slope[i] = bump_slope(kind, s - static_cast<double>(i)) / spacing;
    }
    const auto fold = [&](double ghost, Eigen::Index wall, Eigen::Index next) {
        const double weight = bump(kind, s - ghost);
        const double slope = bump_slope(kind, s - ghost) / spacing;
        values.weight[wall] += 2 * weight;
        values.weight[next] -= weight;
        values.slope[wall] += 2 * slope;
        values.slope[next] -= slope;
    };
    fold(-1, 0, 1);
    fold(last + 1, count - 1, count - 2);
    return values;
}

}  // namespace reference
