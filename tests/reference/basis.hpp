#pragma once

#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "scene.hpp"

namespace reference {

/// Shape functions of all nodes at all particles, as full matrices (particles x nodes), and the masses they give.
struct basis {
    Eigen::MatrixXd S;
    std::vector<Eigen::MatrixXd> G;  ///< one matrix per axis, 1/length
    Eigen::VectorXd mass;            ///< m = S^T M
    Eigen::VectorXd inverse_mass;    ///< 1/m; 0 at a node that takes no part
    Eigen::MatrixXd full_mass;       ///< Mt = S^T M S
    Eigen::MatrixXd A;               ///< I - S+ S with S+ = m^-1 S^T M

    bool takes_part(Eigen::Index node) const { return mass[node] >= std::numeric_limits<double>::min(); }
};

/// Products over the axes: S_pi = prod_d w_d, G_pi = the same with the slope of one axis in place of its weight.
/// `half_widths`: of the particles' domains along the axes (particles x D), for GIMP; see `half_widths()`.
inline basis evaluate_basis(const scene& set, const Eigen::MatrixXd& x, const Eigen::VectorXd& particle_mass,
                            const Eigen::MatrixXd& half_widths = {}) {
    const Eigen::Index dimension = set.dimension();
    const Eigen::Index nodes = set.node_count();
    if (is_gimp(set.shape) && (half_widths.rows() != x.rows() || half_widths.cols() != dimension))
        throw std::invalid_argument("reference: give GIMP the half widths of the particles' domains.");
    basis made;
    made.S.resize(x.rows(), nodes);
    made.G.assign(static_cast<std::size_t>(dimension), Eigen::MatrixXd(x.rows(), nodes));

    for (Eigen::Index p = 0; p < x.rows(); ++p) {
        std::vector<axis_values> axes;
        for (Eigen::Index d = 0; d < dimension; ++d)
            axes.push_back(evaluate_axis(set.shape, x(p, d), set.lower[d], set.spacing, set.nodes_along(d),
                                         is_gimp(set.shape) ? half_widths(p, d) : 0));
        for (Eigen::Index i = 0; i < nodes; ++i) {
            const std::vector<Eigen::Index> index = set.node_index(i);
            double product = 1;
            for (std::size_t d = 0; d < axes.size(); ++d) product *= axes[d].weight[index[d]];
            made.S(p, i) = product;
            for (std::size_t b = 0; b < axes.size(); ++b) {
                double derivative = 1;
                for (std::size_t d = 0; d < axes.size(); ++d)
                    derivative *= d == b ? axes[d].slope[index[d]] : axes[d].weight[index[d]];
                made.G[b](p, i) = derivative;
            }
        }
    }

    made.mass = made.S.transpose() * particle_mass;
    made.inverse_mass = Eigen::VectorXd::Zero(nodes);
    for (Eigen::Index i = 0; i < nodes; ++i)
        if (made.takes_part(i)) made.inverse_mass[i] = 1 / made.mass[i];
    made.full_mass = made.S.transpose() * particle_mass.asDiagonal() * made.S;
    const Eigen::MatrixXd gather = made.inverse_mass.asDiagonal() * (made.S.transpose() * particle_mass.asDiagonal());
    made.A = Eigen::MatrixXd::Identity(nodes, nodes) - gather * made.S;
    return made;
}

/// Half widths of the particles' domains along the axes (particles x D): as made, and for contiguous GIMP stretched by
/// F_dd, the diagonal of the deformation gradient.
inline Eigen::MatrixXd half_widths(const scene& set, const state& body) {
    Eigen::MatrixXd half = body.half_width.replicate(1, set.dimension());
    if (set.shape == shape_kind::contiguous_gimp)
        for (Eigen::Index p = 0; p < body.size(); ++p)
            half.row(p).array() *= body.deformation[static_cast<std::size_t>(p)].diagonal().transpose().array();
    return half;
}

inline basis evaluate_basis(const scene& set, const state& body) {
    return evaluate_basis(set, body.x, body.mass, half_widths(set, body));
}

}  // namespace reference
