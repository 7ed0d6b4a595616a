#pragma once

/// Scenes without symmetry or favourable numbers for tests of the reference, and one small enough for a hand
/// calculation.

#include <cmath>
#include <random>
#include <utility>

#include "../reference/dense.hpp"

namespace rough {

using namespace reference;

inline bool everywhere(const Eigen::VectorXd&) { return true; }

inline scene box(Eigen::Index dimension, double length, double spacing) {
    scene set;
    set.lower = Eigen::VectorXd::Constant(dimension, -0.3);
    set.upper = Eigen::VectorXd::Constant(dimension, -0.3 + length);
    set.spacing = spacing;
    return set;
}

/// Particles off their regular places, each with its own mass, velocity and stress.
inline state rough_body(const scene& set, Eigen::Index per_cell) {
    state body = make_particles(set, per_cell, 2., everywhere);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (Eigen::Index p = 0; p < body.size(); ++p) {
        body.mass[p] *= 1 + 0.5 * any(random);
        for (Eigen::Index d = 0; d < set.dimension(); ++d) {
            body.x(p, d) += 0.2 * set.spacing / static_cast<double>(per_cell) * any(random);
            body.v(p, d) = any(random);
        }
        Eigen::MatrixXd& stress = body.stress[static_cast<std::size_t>(p)];
        for (Eigen::Index a = 0; a < set.dimension(); ++a)
            for (Eigen::Index b = 0; b <= a; ++b) stress(a, b) = stress(b, a) = any(random);
    }
    return body;
}

/// All components held at one wall, by values that change in space and time; one slanted direction at the other.
inline void add_conditions(scene& set) {
    const Eigen::Index dimension = set.dimension();
    const double lower = set.lower[0] + 1e-9;
    const double upper = set.upper[0] - 1e-9;
    set.conditions.push_back(hold_velocity(
        dimension, [=](const Eigen::VectorXd& at) { return at[0] < lower; },
        [=](const Eigen::VectorXd& at, double t) -> Eigen::VectorXd {
            return Eigen::VectorXd::Constant(dimension, 0.3 + t + at.sum());
        }));
    const Eigen::VectorXd slant = Eigen::VectorXd::Ones(dimension).normalized();
    set.conditions.push_back({[=](const Eigen::VectorXd& at) { return at[0] > upper; },
                              {{slant, [](const Eigen::VectorXd&, double t) { return std::cos(5 * t); }}}});
}

/// M = V0 = h = 1, E = 4, V = 5, stress 2, the particle in the middle of the only cell, whose left node is held at
/// 1 + 10 t.
inline std::pair<scene, state> one_particle() {
    scene set;
    set.lower = Eigen::VectorXd::Zero(1);
    set.upper = Eigen::VectorXd::Ones(1);
    set.young = Eigen::VectorXd::Constant(1, 4.);
    set.conditions = {hold_velocity(
        1, [](const Eigen::VectorXd& at) { return at[0] < 0.5; },
        [](const Eigen::VectorXd&, double t) -> Eigen::VectorXd { return Eigen::VectorXd::Constant(1, 1 + 10 * t); })};
    state body = make_particles(set, 1, 1., everywhere);
    body.v(0, 0) = 5;
    body.stress[0](0, 0) = 2;
    return {set, body};
}

}  // namespace rough
