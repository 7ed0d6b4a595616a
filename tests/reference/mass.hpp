#pragma once

#include <cmath>
#include <stdexcept>

#include <Eigen/Dense>

#include "basis.hpp"
#include "held.hpp"
#include "scene.hpp"

namespace reference {

/// v(k) = sum of k increments, dv_1 = `lumped`, dv_l = A dv_(l-1) with held components taken out, and the sum of what
/// was taken out. k = 1 gives `lumped` back.
struct full_mass_velocity {
    Eigen::MatrixXd v;
    Eigen::MatrixXd removed;
    Eigen::MatrixXd last;  ///< dv_k

    full_mass_velocity(const Eigen::MatrixXd& lumped, int k, const basis& shapes, const held_nodes& held)
        : v(lumped), removed(Eigen::MatrixXd::Zero(lumped.rows(), lumped.cols())), last(lumped) {
        if (k < 1) throw std::invalid_argument("reference: give k of at least 1.");
        for (int l = 2; l <= k; ++l) {
            const Eigen::MatrixXd unconstrained = shapes.A * last;
            last = held.zeroed(unconstrained);
            removed += unconstrained - last;
            v += last;
        }
    }
};

/// sqrt(sum m |u|^2 / sum m) of a nodal field (nodes x D).
inline double mass_norm(const Eigen::MatrixXd& u, const basis& shapes) {
    return std::sqrt(shapes.mass.dot(u.rowwise().squaredNorm()) / shapes.mass.sum());
}

/// m^(-1/2); 0 at a node that takes no part.
inline Eigen::VectorXd inverse_root_mass(const basis& shapes) { return shapes.inverse_mass.cwiseSqrt(); }

/// m^(-1/2) Mt m^(-1/2), whose eigenvalues are in [0, 1]; nodes that take no part have 1 on the diagonal.
inline Eigen::MatrixXd scaled_full_mass(const basis& shapes) {
    const Eigen::VectorXd root = inverse_root_mass(shapes);
    Eigen::MatrixXd scaled = root.asDiagonal() * shapes.full_mass * root.asDiagonal();
    for (Eigen::Index i = 0; i < root.size(); ++i)
        if (!shapes.takes_part(i)) scaled(i, i) = 1;
    return scaled;
}

/// Solves with a symmetric matrix whose eigenvalues are in [0, 1]; throws std::domain_error if it is singular.
inline Eigen::MatrixXd solve_scaled(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
    const Eigen::LDLT<Eigen::MatrixXd> factors(matrix);
    if (!(factors.vectorD().minCoeff() > 1e-12))
        throw std::domain_error(
            "reference: the full mass matrix is singular: some motion of the nodes moves no particle. Use more "
            "particles per cell, or a finite k.");
    return factors.solve(right);
}

/// Minv_k = sum_(l<k) A^l m^-1, or Mt^-1 for exact_solve. Symmetric; not less than m^-1 where the shape functions are
/// not negative, for its eigenvalues, scaled by m, are sum_(l<k) (1 - s)^l with s in [0, 1].
inline Eigen::MatrixXd inverse_mass_matrix(const basis& shapes, int k) {
    if (k < 1) throw std::invalid_argument("reference: give k of at least 1.");
    const Eigen::Index nodes = shapes.mass.size();
    if (k == exact_solve) {
        const Eigen::VectorXd root = inverse_root_mass(shapes);
        const Eigen::MatrixXd scaled = solve_scaled(scaled_full_mass(shapes), Eigen::MatrixXd::Identity(nodes, nodes));
        return root.asDiagonal() * scaled * root.asDiagonal();
    }
    Eigen::MatrixXd term = shapes.inverse_mass.asDiagonal();
    Eigen::MatrixXd sum = term;
    for (int l = 1; l < k; ++l) {
        term = shapes.A * term;
        sum += term;
    }
    return sum;
}

/// The v that minimises (v - Mt^-1 p)^T Mt (v - Mt^-1 p) among those with N v = b: (Mt v)_free = p_free. Where Mt is
/// singular but the conditions rule its null vectors out, there still is one. Throws std::domain_error if not.
///
/// With y = m^(1/2) v, B = m^(-1/2) Mt m^(-1/2), F = I - N^T N and c = m_h^(1/2) b, as N m^(1/2) = m_h^(1/2) N:
/// y = F y + N^T c and F (B y - m^(-1/2) p) = 0, that is (F B F + N^T N) F y = F (m^(-1/2) p - B N^T c).
inline Eigen::MatrixXd constrained_least_squares(const Eigen::MatrixXd& p, const Eigen::VectorXd& b,
                                                 const basis& shapes, const held_nodes& held) {
    const Eigen::Index nodes = p.rows();
    const Eigen::Index size = p.size();
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index d = 0; d < p.cols(); ++d) B.block(d * nodes, d * nodes, nodes, nodes) = scaled_full_mass(shapes);
    const Eigen::VectorXd root = inverse_root_mass(shapes).replicate(p.cols(), 1);
    const Eigen::MatrixXd& N = held.rows();
    const Eigen::MatrixXd F = Eigen::MatrixXd::Identity(size, size) - N.transpose() * N;

    const Eigen::VectorXd fixed = N.transpose() * Eigen::VectorXd(held.mass().cwiseSqrt().cwiseProduct(b));
    const Eigen::VectorXd right = F * (root.cwiseProduct(Eigen::VectorXd(p.reshaped())) - B * fixed);
    const Eigen::VectorXd free = solve_scaled(F * B * F + N.transpose() * N, right);
    const Eigen::VectorXd v = root.cwiseProduct(free + fixed);
    return v.reshaped(nodes, p.cols());
}

}  // namespace reference
