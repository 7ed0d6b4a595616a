#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "basis.hpp"

namespace reference {

/// The boundary conditions of a scene, listed node by node for the nodes that take part in a step.
/// Throws std::invalid_argument if the directions held at a node are not orthonormal.
class held_nodes {
  public:
    held_nodes(const scene& set, const basis& shapes) {
        for (Eigen::Index i = 0; i < set.node_count(); ++i) {
            if (!shapes.takes_part(i)) continue;
            const Eigen::VectorXd at = set.node_position(i);
            const std::size_t first = entries_.size();
            for (const condition& rule : set.conditions) {
                if (!rule.holds(at)) continue;
                for (const held_direction& direction : rule.directions) {
                    bool orthonormal = std::abs(direction.normal.norm() - 1) < 1e-12;
                    for (std::size_t e = first; e < entries_.size(); ++e)
                        if (std::abs(entries_[e].direction.normal.dot(direction.normal)) > 1e-12) orthonormal = false;
                    if (!orthonormal)
                        throw std::invalid_argument(
                            "reference: give directions of length one, orthogonal to every "
                            "other direction held at the same node.");
                    entries_.push_back({i, at, direction});
                }
            }
        }
        const Eigen::Index nodes = set.node_count();
        rows_.setZero(static_cast<Eigen::Index>(entries_.size()), nodes * set.dimension());
        mass_.resize(rows_.rows());
        for (Eigen::Index e = 0; e < rows_.rows(); ++e) {
            const entry& held = entries_[static_cast<std::size_t>(e)];
            mass_[e] = shapes.mass[held.node];
            for (Eigen::Index d = 0; d < set.dimension(); ++d)
                rows_(e, d * nodes + held.node) = held.direction.normal[d];
        }
    }

    /// N: one row for each held direction of a node, so that N u are the held components of a nodal field u whose
    /// components follow one another, each with all nodes. N N^T = I.
    const Eigen::MatrixXd& rows() const { return rows_; }
    /// Lumped mass of each row's node.
    const Eigen::VectorXd& mass() const { return mass_; }
    /// b: the held values at t.
    Eigen::VectorXd values(double t) const {
        Eigen::VectorXd b(rows_.rows());
        for (Eigen::Index e = 0; e < b.size(); ++e) {
            const entry& held = entries_[static_cast<std::size_t>(e)];
            b[e] = held.direction.value(held.at, t);
        }
        return b;
    }
    /// N u of a field (nodes x D).
    Eigen::VectorXd along(const Eigen::MatrixXd& field) const { return rows_ * field.reshaped(); }
    /// N^T j: the field (nodes x D) with the held components j and nothing else.
    Eigen::MatrixXd spread(const Eigen::VectorXd& components, Eigen::Index dimension) const {
        const Eigen::VectorXd field = rows_.transpose() * components;
        return field.reshaped(field.size() / dimension, dimension);
    }

    /// Nodal velocities (nodes x D) with the held components set to their values at t.
    Eigen::MatrixXd imposed(Eigen::MatrixXd velocity, double t) const {
        for (const entry& e : entries_) {
            const Eigen::VectorXd& n = e.direction.normal;
            const double now = velocity.row(e.node).dot(n.transpose());
            velocity.row(e.node) += (e.direction.value(e.at, t) - now) * n.transpose();
        }
        return velocity;
    }

    /// Nodal increments (nodes x D) with the held components taken out.
    Eigen::MatrixXd zeroed(Eigen::MatrixXd increment) const {
        for (const entry& e : entries_) {
            const Eigen::VectorXd& n = e.direction.normal;
            increment.row(e.node) -= increment.row(e.node).dot(n.transpose()) * n.transpose();
        }
        return increment;
    }

  private:
    struct entry {
        Eigen::Index node;
        Eigen::VectorXd at;
        held_direction direction;
    };
    std::vector<entry> entries_;
    Eigen::MatrixXd rows_;
    Eigen::VectorXd mass_;
};

}  // namespace reference
