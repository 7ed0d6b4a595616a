#pragma once

#include <cmath>

#include <Eigen/Dense>

#include "basis.hpp"
#include "scene.hpp"

namespace reference {

/// Kirchhoff stress of a neo-Hookean solid, mu (B - I) + lambda ln J I with B = F F^T and J = det F. Axes beyond the
/// dimension are not stretched: plane strain in 2D, uniaxial strain in 1D.
inline Eigen::MatrixXd neo_hookean_stress(const Eigen::MatrixXd& F, double young, double poisson) {
    const double mu = young / (2 * (1 + poisson));
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(F.rows(), F.cols());
    return mu * (F * F.transpose() - one) + lambda * std::log(F.determinant()) * one;
}

/// F' = (I + dt L) F, and the stress by the law: linear elasticity in small increments, stress += C : sym(L) dt, bar in
/// 1D and plane strain in 2D; or neo-Hookean, from F'. `v`: nodal velocities (nodes x D).
inline void strain_particles(const scene& set, state& body, const basis& shapes, const Eigen::MatrixXd& v, double dt) {
    const Eigen::Index dimension = set.dimension();
    for (Eigen::Index p = 0; p < body.size(); ++p) {
        Eigen::MatrixXd gradient(dimension, dimension);
        for (Eigen::Index b = 0; b < dimension; ++b)
            gradient.col(b) = (shapes.G[static_cast<std::size_t>(b)].row(p) * v).transpose();
        Eigen::MatrixXd& F = body.deformation[static_cast<std::size_t>(p)];
        F = (Eigen::MatrixXd::Identity(dimension, dimension) + dt * gradient) * F;

        const double young = set.young.size() == 1 ? set.young[0] : set.young[p];
        Eigen::MatrixXd& stress = body.stress[static_cast<std::size_t>(p)];
        if (set.law == law_kind::neo_hookean) {
            stress = neo_hookean_stress(F, young, set.poisson);
            continue;
        }
        const Eigen::MatrixXd strain = dt * (gradient + gradient.transpose()) / 2;
        if (dimension == 1) {
            stress += young * strain;
        } else {
            const double shear = young / (2 * (1 + set.poisson));
            const double lame = young * set.poisson / ((1 + set.poisson) * (1 - 2 * set.poisson));
            stress += 2 * shear * strain + lame * strain.trace() * Eigen::MatrixXd::Identity(dimension, dimension);
        }
    }
}

}  // namespace reference
