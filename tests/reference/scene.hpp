#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "shape.hpp"

namespace reference {

enum class update_kind { pic, flip, blend, graphics_blend, xpic, fmpm, apic, tpic, affine_flip };
enum class stress_order { usf, usl_minus, usl_plus, usavg_minus, usavg_plus, euler };
enum class motion { moving, held };
enum class law_kind { linear_elastic, neo_hookean };

/// How held velocities enter a full mass matrix: boundary.hpp.
enum class boundary_method { incremental, lumped, velocity, combined, unlumped1, unlumped2, partial, collected };

/// k of the full mass matrix solved exactly, k -> infinity.
inline constexpr int exact_solve = std::numeric_limits<int>::max();

/// A particle update and its number: psi for FLIP, alpha for the blends, k for XPIC and FMPM. With a period of m, FMPM
/// is done in the steps m, 2m, ... from the start of the run (state::steps), and FLIP(psi) in the others.
struct update {
    update_kind kind = update_kind::flip;
    double psi = 0;
    double alpha = 1;
    int k = 1;
    int period = 1;
};

inline update pic() { return {.kind = update_kind::pic}; }
inline update flip(double psi = 0) { return {.kind = update_kind::flip, .psi = psi}; }
inline update apic() { return {.kind = update_kind::apic}; }
inline update tpic() { return {.kind = update_kind::tpic}; }
inline update affine_flip() { return {.kind = update_kind::affine_flip}; }
inline update blend(double alpha) { return {.kind = update_kind::blend, .alpha = alpha}; }
inline update graphics_blend(double alpha) { return {.kind = update_kind::graphics_blend, .alpha = alpha}; }
/// The series without a term, k = 0, is FLIP(1): V' = V + S a dt, X' = X + (S m^-1 p + S a dt/2) dt.
inline update xpic(int k) { return k == 0 ? flip(1) : update{.kind = update_kind::xpic, .k = k}; }
inline update fmpm(int k) { return k == 0 ? flip(1) : update{.kind = update_kind::fmpm, .k = k}; }
inline update periodic_fmpm(int k, int period, double psi = 0) {
    return {.kind = update_kind::fmpm, .psi = psi, .k = k, .period = period};
}

/// One held direction: v . normal = value(node position, time), with a normal of length one.
struct held_direction {
    Eigen::VectorXd normal;
    std::function<double(const Eigen::VectorXd& at, double t)> value;
};

/// Holds the directions at every node where `holds` is true. All directions held at one node, by this condition and
/// the others, must be orthogonal to one another.
struct condition {
    std::function<bool(const Eigen::VectorXd& at)> holds;
    std::vector<held_direction> directions;
};

/// A condition on all components of the velocity: v = velocity(node position, time).
inline condition hold_velocity(Eigen::Index dimension, std::function<bool(const Eigen::VectorXd&)> holds,
                               std::function<Eigen::VectorXd(const Eigen::VectorXd&, double)> velocity) {
    condition all{std::move(holds), {}};
    for (Eigen::Index d = 0; d < dimension; ++d)
        all.directions.push_back({Eigen::VectorXd::Unit(dimension, d),
                                  [=](const Eigen::VectorXd& at, double t) { return velocity(at, t)[d]; }});
    return all;
}

/// force(x, t) (N) on particles, by how much each takes of it.
struct point_force {
    Eigen::VectorXd share;
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, double t)> force;
};
/// per_area(x, normal, t) (Pa) on particles' faces, with the faces' areas: load.hpp.
struct face_load {
    Eigen::MatrixXd areas;
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& normal, double t)> per_area;
};
/// Damping that follows the kinetic energy: load.hpp. None if the gain is 0.
struct kinetic_feedback {
    double target = 0;
    double gain = 0;
    double maximum = 0;
};

/// Everything that does not change during a run. The length of `lower` is the dimension D: 1, 2 or 3.
struct scene {
    Eigen::VectorXd lower;
    Eigen::VectorXd upper;
    double spacing = 1;

    shape_kind shape = shape_kind::linear;
    reference::update update = {};
    stress_order order = stress_order::usl_minus;
    reference::motion motion = motion::moving;
    std::vector<condition> conditions = {};
    reference::boundary_method boundary_method = reference::boundary_method::incremental;  ///< others for FMPM only

    law_kind law = law_kind::linear_elastic;
    /// Young's modulus: one number for all particles, or one for each.
    Eigen::VectorXd young = Eigen::VectorXd::Ones(1);
    double poisson = 0;

    /// Acceleration by loads, b(position, velocity, time) at a particle; none if empty.
    std::function<Eigen::VectorXd(const Eigen::VectorXd& x, const Eigen::VectorXd& v, double t)> acceleration = {};

    std::vector<point_force> point_forces = {};
    std::vector<face_load> face_loads = {};
    std::function<double(double t)> damping = {};  ///< rate (1/s) of the nodes' velocities; none if empty
    kinetic_feedback feedback = {};

    /// When the run starts; only the `euler` order asks, whose boundary values may not be older than this.
    double start_time = 0;

    Eigen::Index dimension() const { return lower.size(); }

    /// Nodes along one axis, both ends included.
    Eigen::Index nodes_along(Eigen::Index axis) const {
        return static_cast<Eigen::Index>(std::lround((upper[axis] - lower[axis]) / spacing)) + 1;
    }

    Eigen::Index node_count() const {
        Eigen::Index count = 1;
        for (Eigen::Index d = 0; d < dimension(); ++d) count *= nodes_along(d);
        return count;
    }

    /// Places of a node along the axes; the first axis runs fastest.
    std::vector<Eigen::Index> node_index(Eigen::Index node) const {
        std::vector<Eigen::Index> index;
        for (Eigen::Index d = 0; d < dimension(); ++d) {
            index.push_back(node % nodes_along(d));
            node /= nodes_along(d);
        }
        return index;
    }

    Eigen::VectorXd node_position(Eigen::Index node) const {
        const std::vector<Eigen::Index> index = node_index(node);
        Eigen::VectorXd at = lower;
        for (Eigen::Index d = 0; d < dimension(); ++d)
            at[d] += static_cast<double>(index[static_cast<std::size_t>(d)]) * spacing;
        return at;
    }
};

/// The particles: positions and velocities n x D, masses and reference volumes n, stresses and deformation gradients n
/// matrices D x D, half widths of the domains they were made with n (lengths).
struct state {
    Eigen::MatrixXd x;
    Eigen::MatrixXd v;
    Eigen::VectorXd mass;
    Eigen::VectorXd volume;
    std::vector<Eigen::MatrixXd> stress;
    std::vector<Eigen::MatrixXd> deformation;
    Eigen::VectorXd half_width;
    int steps = 0;                             ///< done so far
    double feedback_rate = 0;                  ///< of the damping that follows the kinetic energy (1/s)
    std::vector<Eigen::MatrixXd> affine = {};  ///< slopes C of the velocities that particles carry (1/s); none is zero

    Eigen::Index size() const { return x.rows(); }
};

/// Particles at rest and without stress, n per axis at (s + 1/2)/n of each cell, kept where `inside` is true at the
/// particle. The first axis runs fastest, over all sub-cells of the box.
inline state make_particles(const scene& set, Eigen::Index n, double density,
                            const std::function<bool(const Eigen::VectorXd&)>& inside) {
    const Eigen::Index dimension = set.dimension();
    const double side = set.spacing / static_cast<double>(n);
    Eigen::Index slots = 1;
    for (Eigen::Index d = 0; d < dimension; ++d) slots *= (set.nodes_along(d) - 1) * n;

    std::vector<Eigen::VectorXd> places;
    for (Eigen::Index slot = 0; slot < slots; ++slot) {
        Eigen::VectorXd at = set.lower;
        Eigen::Index rest = slot;
        for (Eigen::Index d = 0; d < dimension; ++d) {
            const Eigen::Index along = (set.nodes_along(d) - 1) * n;
            const Eigen::Index cell = rest % along / n;
            const Eigen::Index sub = rest % along % n;
            rest /= along;
            const double r = (static_cast<double>(sub) + 0.5) / static_cast<double>(n);
            at[d] += (static_cast<double>(cell) + r) * set.spacing;
        }
        if (inside(at)) places.push_back(at);
    }

    const auto count = static_cast<Eigen::Index>(places.size());
    const double volume = std::pow(side, static_cast<double>(dimension));
    state body{Eigen::MatrixXd(count, dimension),
               Eigen::MatrixXd::Zero(count, dimension),
               Eigen::VectorXd::Constant(count, density * volume),
               Eigen::VectorXd::Constant(count, volume),
               std::vector<Eigen::MatrixXd>(places.size(), Eigen::MatrixXd::Zero(dimension, dimension)),
               std::vector<Eigen::MatrixXd>(places.size(), Eigen::MatrixXd::Identity(dimension, dimension)),
               Eigen::VectorXd::Constant(count, side / 2)};
    for (Eigen::Index p = 0; p < count; ++p) body.x.row(p) = places[static_cast<std::size_t>(p)].transpose();
    return body;
}

}  // namespace reference
