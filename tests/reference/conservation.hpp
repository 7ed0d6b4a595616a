#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "shape.hpp"

namespace reference {

/// u_t + F(u)_x = 0 on a line, by the two-step Taylor-Galerkin scheme with particles as quadrature points, every
/// operator a full matrix (docs/taylor-galerkin.md). States are places x unknowns.
struct line {
    shape_kind shape = shape_kind::linear;
    double lower = 0;
    double spacing = 1;
    Eigen::Index cells = 1;
    bool periodic = false;
    std::function<Eigen::MatrixXd(const Eigen::MatrixXd& u)> flux;
    Eigen::VectorXd x;
    Eigen::VectorXd volume;
    /// Terms of the mass matrix's inverse; 1 is the lumped one.
    int k = 1;
    /// Unknowns that the lower and the upper end hold, and their values.
    struct held_unknown {
        Eigen::Index unknown;
        std::function<double(double t)> value;
    };
    std::vector<held_unknown> low{}, high{};

    Eigen::Index nodes() const { return periodic ? cells : cells + 1; }
    double upper() const { return lower + spacing * static_cast<double>(cells); }
};

/// Weights and slopes of all nodes at a place; those of a periodic line are sums over its images.
inline axis_values evaluate_line(const line& set, double x) {
    if (!set.periodic) return evaluate_axis(set.shape, x, set.lower, set.spacing, set.nodes());
    axis_values values{Eigen::VectorXd::Zero(set.nodes()), Eigen::VectorXd::Zero(set.nodes())};
    for (Eigen::Index i = 0; i < set.nodes(); ++i)
        for (const int image : {-1, 0, 1}) {
            const double d = (x - set.lower) / set.spacing - static_cast<double>(i + image * set.cells);
            values.weight[i] += bump(set.shape, d);
            values.slope[i] += bump_slope(set.shape, d) / set.spacing;
        }
    return values;
}

/// One step from t to t + dt:
///     u_p = S u - dt/2 G F(u),   M (u' - u) = dt (G^T V F(u_p) - [F n]),   M^-1 = sum_(l<k) A^l m^-1,
/// where the held unknowns of the ends take their values with the first term, and none of the others.
inline Eigen::MatrixXd taylor_galerkin_step(const line& set, const Eigen::MatrixXd& u, double t, double dt) {
    const Eigen::Index n = set.nodes();
    Eigen::MatrixXd S(set.x.size(), n), G(set.x.size(), n);
    for (Eigen::Index p = 0; p < set.x.size(); ++p) {
        const axis_values at = evaluate_line(set, set.x[p]);
        S.row(p) = at.weight.transpose();
        G.row(p) = at.slope.transpose();
    }
    const Eigen::VectorXd m = S.transpose() * set.volume;
    const Eigen::MatrixXd full = S.transpose() * set.volume.asDiagonal() * S;
    const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) - m.cwiseInverse().asDiagonal() * full;

    const Eigen::MatrixXd F = set.flux(u);
    const Eigen::MatrixXd u_p = S * u - dt / 2 * G * F;
    Eigen::MatrixXd right = G.transpose() * set.volume.asDiagonal() * set.flux(u_p);
    if (!set.periodic) {
        const auto through = [&](double x, const std::vector<line::held_unknown>& held) {
            const axis_values at = evaluate_line(set, x);
            Eigen::MatrixXd here = at.weight.transpose() * u - dt / 2 * at.slope.transpose() * F;
            for (const auto& h : held) here(0, h.unknown) = h.value(t + dt / 2);
            return Eigen::MatrixXd(set.flux(here));
        };
        right.row(0) += through(set.lower, set.low);
        right.row(n - 1) -= through(set.upper(), set.high);
    }

    Eigen::MatrixXd term = dt * m.cwiseInverse().asDiagonal() * right;
    if (!set.periodic) {
        for (const auto& h : set.low) term(0, h.unknown) = h.value(t + dt) - u(0, h.unknown);
        for (const auto& h : set.high) term(n - 1, h.unknown) = h.value(t + dt) - u(n - 1, h.unknown);
    }
    Eigen::MatrixXd sum = term;
    for (int l = 1; l < set.k; ++l) {
        term = A * term;
        if (!set.periodic) {
            for (const auto& h : set.low) term(0, h.unknown) = 0;
            for (const auto& h : set.high) term(n - 1, h.unknown) = 0;
        }
        sum += term;
    }
    return u + sum;
}

}  // namespace reference
