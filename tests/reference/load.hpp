#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Dense>

#include "basis.hpp"
#include "scene.hpp"

namespace reference {

/// Which particles a point_force acts on: n numbers, 1 or 0, from the places they start at.
inline Eigen::VectorXd chosen_particles(const state& start,
                                        const std::function<bool(const Eigen::VectorXd& at)>& region) {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(start.size());
    for (Eigen::Index p = 0; p < start.size(); ++p)
        if (region(start.x.row(p).transpose())) share[p] = 1;
    return share;
}

/// Areas of particles' faces (n x 2D, lower and upper side of each axis) where a body made of cubes ends: there is no
/// particle beyond. `region` is asked for the face's centre and its outward normal.
inline Eigen::MatrixXd surface_areas(
    const state& start, const std::function<bool(const Eigen::VectorXd& at, const Eigen::VectorXd& normal)>& region) {
    const Eigen::Index dimension = start.x.cols();
    Eigen::MatrixXd areas = Eigen::MatrixXd::Zero(start.size(), 2 * dimension);
    for (Eigen::Index p = 0; p < start.size(); ++p) {
        const Eigen::VectorXd x = start.x.row(p).transpose();
        const double side = std::pow(start.volume[p], 1 / static_cast<double>(dimension));
        for (Eigen::Index face = 0; face < 2 * dimension; ++face) {
            const Eigen::VectorXd normal = (face % 2 == 0 ? -1 : 1) * Eigen::VectorXd::Unit(dimension, face / 2);
            bool inner = false;
            for (Eigen::Index q = 0; q < start.size(); ++q)
                inner = inner || (start.x.row(q).transpose() - x - side * normal).norm() < side / 4;
            if (!inner && region(x + side / 2 * normal, normal))
                areas(p, face) = std::pow(side, static_cast<double>(dimension - 1));
        }
    }
    return areas;
}

/// Forces on particles and on their faces, given to nodes x D (N).
///
/// A force F at a particle is S^T F. A traction's F acts at the face's centre X + d, where the functions are taken as
/// S(X) + d . grad S(X): their sum is one and they give the place X + d, so force and moment are F's.
inline Eigen::MatrixXd applied_forces(const scene& set, const state& body, const basis& shapes, double t) {
    const Eigen::Index dimension = set.dimension();
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(set.node_count(), dimension);
    for (const point_force& load : set.point_forces)
        for (Eigen::Index p = 0; p < body.size(); ++p) {
            if (load.share[p] == 0) continue;
            const Eigen::VectorXd F = load.share[p] * load.force(body.x.row(p).transpose(), t);
            f += shapes.S.row(p).transpose() * F.transpose();
        }
    for (const face_load& load : set.face_loads)
        for (Eigen::Index p = 0; p < body.size(); ++p) {
            const Eigen::VectorXd x = body.x.row(p).transpose();
            const double half = std::pow(body.volume[p], 1 / static_cast<double>(dimension)) / 2;
            for (Eigen::Index face = 0; face < 2 * dimension; ++face) {
                if (load.areas(p, face) == 0) continue;
                const Eigen::Index axis = face / 2;
                const Eigen::VectorXd normal = (face % 2 == 0 ? -1 : 1) * Eigen::VectorXd::Unit(dimension, axis);
                const Eigen::VectorXd F = load.areas(p, face) * load.per_area(x + half * normal, normal, t);
                const Eigen::VectorXd weights =
                    shapes.S.row(p).transpose() +
                    half * normal[axis] * shapes.G[static_cast<std::size_t>(axis)].row(p).transpose();
                f += weights * F.transpose();
            }
        }
    return f;
}

/// The force -alpha m v on nodes, v their velocity at the step's start, and the feedback's next alpha: its rate of
/// change is gain 2 (T - target)/M, T the nodes' kinetic energy, M their mass, kept from 0 to a maximum.
inline Eigen::MatrixXd damping_forces(const scene& set, state& body, const basis& shapes,
                                      const Eigen::MatrixXd& v_start, double t, double dt) {
    double alpha = set.damping ? set.damping(t) : 0;
    if (set.feedback.gain > 0) {
        alpha += body.feedback_rate;
        const double kinetic = shapes.mass.dot(v_start.rowwise().squaredNorm()) / 2;
        body.feedback_rate = std::clamp(
            body.feedback_rate + dt * set.feedback.gain * 2 * (kinetic - set.feedback.target) / shapes.mass.sum(), 0.,
            set.feedback.maximum);
    }
    return -alpha * (shapes.mass.asDiagonal() * v_start);
}

}  // namespace reference
