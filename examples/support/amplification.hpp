#pragma once
#include <tamis/conservation/taylor_galerkin.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numbers>

/// What a step of a Taylor-Galerkin scheme of a linear law multiplies states by, and what theory says.
namespace amplification {

/// The matrix of one step of dt in one dimension, by steps from unit states. Ends must hold zero.
template <class Scheme> Eigen::MatrixXd step_matrix(Scheme& scheme, double dt) {
    constexpr int count = Scheme::count;
    const int cells = scheme.grid().cells(0), nodes = cells + (scheme.grid().wraps(0) ? 0 : 1);
    Eigen::MatrixXd matrix(nodes * count, nodes * count);
    for (int j = 0; j < nodes; ++j)
        for (int c = 0; c < count; ++c) {
            const double place = scheme.grid().node({j, 0, 0})[0];
            scheme.set([&](const auto& at) {
                typename Scheme::state_type u = Scheme::state_type::Zero();
                if (std::abs(at[0] - place) < scheme.grid().spacing() / 2) u[c] = 1;
                return u;
            });
            scheme.step(dt);
            for (int i = 0; i < nodes; ++i)
                matrix.template block<count, 1>(i * count, j * count + c) = scheme.on_node({i, 0, 0});
        }
    return matrix;
}

/// Largest factor of a step at a Courant number c dt/h.
template <class Scheme> double growth(Scheme& scheme, double courant) {
    const double dt = courant * scheme.grid().spacing() / scheme.wave_speed();
    return step_matrix(scheme, dt).eigenvalues().cwiseAbs().maxCoeff();
}

/// Courant number up to which no state grows by more than `tolerance` a step, at most 2; by bisection.
template <class Scheme> double critical_courant(Scheme& scheme, double tolerance = 1e-11) {
    double stable = 0, unstable = 2;
    if (growth(scheme, unstable) <= 1 + tolerance) return unstable;
    while (unstable - stable > 1e-5) {
        const double middle = (stable + unstable) / 2;
        (growth(scheme, middle) <= 1 + tolerance ? stable : unstable) = middle;
    }
    return stable;
}

/// The same by von Neumann's analysis: linear functions, `per_cell` evenly spaced particles, k terms of the mass
/// matrix, waves that fit into so many periodic cells (docs/taylor-galerkin.md).
inline double critical_courant_of_theory(int per_cell, int k, int cells) {
    const double r = 1. / 6 + 1. / (12. * per_cell * per_cell);
    double least = 4;
    for (int wave = 1; wave <= cells / 2; ++wave) {
        const double s = 1 - std::cos(2 * std::numbers::pi * wave / cells), a = 2 * r * s;
        double inverse = 0;
        for (int l = 0; l < k; ++l) inverse += std::pow(a, l);
        least = std::min(least, 2 / (inverse * s) - (2 - s) / s);
    }
    return std::sqrt(least);
}

}  // namespace amplification
