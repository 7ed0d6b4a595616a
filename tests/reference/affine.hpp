#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Dense>

#include "basis.hpp"
#include "scene.hpp"

namespace reference {

inline bool is_affine(const update& by) {
    return by.kind == update_kind::apic || by.kind == update_kind::tpic || by.kind == update_kind::affine_flip;
}

/// sum_p w_pi M_p (V_p + C_p (x_i - X_p)), nodes x D; C counts for affine updates only.
inline Eigen::MatrixXd nodal_momentum(const scene& set, const state& body, const basis& shapes,
                                      const Eigen::MatrixXd& V) {
    Eigen::MatrixXd P = shapes.S.transpose() * (body.mass.asDiagonal() * V);
    if (!is_affine(set.update) || body.affine.empty()) return P;
    for (Eigen::Index i = 0; i < set.node_count(); ++i)
        for (Eigen::Index p = 0; p < body.size(); ++p)
            P.row(i) += (shapes.S(p, i) * body.mass[p] * body.affine[static_cast<std::size_t>(p)] *
                         (set.node_position(i) - body.x.row(p).transpose()))
                            .transpose();
    return P;
}

/// The particles' new slopes C' from the nodes' velocities v: the gradient for TPIC and for linear functions, else
/// B D^-1, B = sum_i w v_i (x) (x_i - X), D = sum_i w (x_i - X)^2 along each axis, at least a hundredth of h^2.
inline std::vector<Eigen::MatrixXd> affine_slopes(const scene& set, const state& body, const basis& shapes,
                                                  const Eigen::MatrixXd& v) {
    const Eigen::Index dimension = set.dimension();
    const bool gradient = set.update.kind == update_kind::tpic || set.shape == shape_kind::linear;
    std::vector<Eigen::MatrixXd> all;
    for (Eigen::Index p = 0; p < body.size(); ++p) {
        Eigen::MatrixXd C = Eigen::MatrixXd::Zero(dimension, dimension);
        Eigen::VectorXd D = Eigen::VectorXd::Zero(dimension);
        for (Eigen::Index i = 0; i < set.node_count(); ++i) {
            const Eigen::VectorXd r = set.node_position(i) - body.x.row(p).transpose();
            for (Eigen::Index d = 0; d < dimension; ++d) {
                const double factor = gradient ? shapes.G[static_cast<std::size_t>(d)](p, i) : shapes.S(p, i) * r[d];
                C.col(d) += factor * v.row(i).transpose();
                D[d] += shapes.S(p, i) * r[d] * r[d];
            }
        }
        if (!gradient)
            for (Eigen::Index d = 0; d < dimension; ++d) C.col(d) /= std::max(D[d], 0.01 * set.spacing * set.spacing);
        all.push_back(C);
    }
    return all;
}

}  // namespace reference
