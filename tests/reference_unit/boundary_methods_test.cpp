#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr boundary_method all_methods[] = {
    boundary_method::incremental, boundary_method::lumped,    boundary_method::velocity, boundary_method::combined,
    boundary_method::unlumped1,   boundary_method::unlumped2, boundary_method::partial,  boundary_method::collected};

bool is_unlumped(boundary_method method) {
    return method == boundary_method::unlumped1 || method == boundary_method::unlumped2;
}
bool always_holds(boundary_method method) {
    return method == boundary_method::incremental || method == boundary_method::velocity ||
           method == boundary_method::combined || method == boundary_method::collected;
}

/// Particles per axis in a cell at random, so that the full mass matrix is not singular: three in 1D, two in 2D.
struct random_scene {
    scene set;
    state body;
    basis shapes;
    held_nodes held;
    MatrixXd momentum;  ///< of all sorts, not only what the particles make

    random_scene(Index dimension, shape_kind kind)
        : set(made(dimension, kind)),
          body(scattered(set)),
          shapes(evaluate_basis(set, body)),
          held(set, shapes),
          momentum(MatrixXd::Zero(set.node_count(), dimension)) {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> any(-1, 1);
        for (double& p : momentum.reshaped()) p = any(random);
        momentum = shapes.mass.asDiagonal() * momentum;
    }

    static scene made(Index dimension, shape_kind kind) {
        scene set = box(dimension, dimension == 1 ? 1. : 0.75, 0.25);
        set.shape = kind;
        add_conditions(set);
        return set;
    }
    static state scattered(const scene& set) {
        state body = rough_body(set, 3);
        std::mt19937 random(11);
        std::uniform_real_distribution<double> any(-0.5, 0.5);
        for (double& x : body.x.reshaped()) {
            const double cell = std::floor((x - set.lower[0]) / set.spacing) + 0.5;
            x = set.lower[0] + set.spacing * (cell + 0.98 * any(random));
        }
        return body;
    }

    nodal_velocity by(boundary_method method, int k) const {
        return velocity_under_conditions(method, momentum, 0.1, k, shapes, held);
    }
    double missing(const MatrixXd& v) const { return (held.along(v) - held.values(0.1)).cwiseAbs().maxCoeff(); }
    /// The impulses' part that is not in a held component.
    double elsewhere(const MatrixXd& impulse) const { return held.zeroed(impulse).cwiseAbs().maxCoeff(); }
};

/// By Lagrange multipliers: Mt v - N^T j = p, N v = b.
MatrixXd least_squares(const random_scene& at) {
    const Index size = at.momentum.size(), nodes = at.set.node_count();
    const MatrixXd& N = at.held.rows();
    MatrixXd system = MatrixXd::Zero(size + N.rows(), size + N.rows());
    for (Index d = 0; d < at.set.dimension(); ++d)
        system.block(d * nodes, d * nodes, nodes, nodes) = at.shapes.full_mass;
    system.topRightCorner(size, N.rows()) = -N.transpose();
    system.bottomLeftCorner(N.rows(), size) = N;
    VectorXd right(size + N.rows());
    right << VectorXd(at.momentum.reshaped()), at.held.values(0.1);
    const VectorXd v = system.fullPivLu().solve(right).head(size);
    return v.reshaped(nodes, at.set.dimension());
}

}  // namespace

TEST_CASE("one particle in one cell does what hand calculation says, by every boundary method", "[reference]") {
    // p* = (2.7, 2.3), b = 4 at the first node. M~ = [[1, 1], [1, 1]]/4, M~_2^-1 = [[3, -1], [-1, 3]].
    const auto [method, velocity, stress, reaction] = GENERATE(
        table<boundary_method, double, double, double>({{boundary_method::incremental, 4.45, 2.36, -5.5},
                                                        {boundary_method::lumped, 4.3, 2.48, -7.},
                                                        {boundary_method::velocity, 4.1, 2.08, -9.},
                                                        {boundary_method::combined, 4.45, 2.36, -5.5},
                                                        {boundary_method::unlumped1, 4.3, 1.36, -7.},
                                                        {boundary_method::unlumped2, 4.1, 1.36, -9.},
                                                        {boundary_method::partial, 68. / 15, 2 + 1.6 / 15, -14. / 3},
                                                        {boundary_method::collected, 4.4, 2.32, -6.}}));
    auto [set, body] = one_particle();
    set.update = fmpm(2);
    set.boundary_method = method;
    const MatrixXd reactions = step(set, body, 0.2, 0.1);
    CHECK(std::abs(body.v(0, 0) - velocity) < 1e-13);
    CHECK(std::abs(body.x(0, 0) - 0.5 - (5 + velocity) / 20) < 1e-13);
    CHECK(std::abs(body.stress[0](0, 0) - stress) < 1e-13);
    CHECK(std::abs(reactions(0, 0) - reaction) < 1e-12);
    CHECK(reactions(1, 0) == 0);
}

TEST_CASE("before the forces a boundary method takes the raw momentum and the values of t", "[reference]") {
    // p = (2.5, 2.5), b = 3 at the first node: (3, 5) with it imposed on p/m. Stress 2 + 0.4 (v_2 - v_1).
    const auto [method, stress] =
        GENERATE(table<boundary_method, double>({{boundary_method::incremental, 2 + 0.4 * 3},
                                                 {boundary_method::lumped, 2 + 0.4 * 4},
                                                 {boundary_method::velocity, 2 + 0.4 * 2},
                                                 {boundary_method::combined, 2 + 0.4 * 3},
                                                 {boundary_method::unlumped1, 2.},
                                                 {boundary_method::unlumped2, 2.},
                                                 {boundary_method::partial, 2 + 0.4 * 8 / 3},
                                                 {boundary_method::collected, 2 + 0.4 * 8 / 3}}));
    auto [set, body] = one_particle();
    set.update = fmpm(2);
    set.order = stress_order::usf;
    set.boundary_method = method;
    step(set, body, 0.2, 0.1);
    CHECK(std::abs(body.stress[0](0, 0) - stress) < 1e-13);
}

TEST_CASE("momentum changes by loads and reactions alone, by every boundary method", "[reference]") {
    for (const Index dimension : {1, 2})
        for (const shape_kind kind : {shape_kind::linear, shape_kind::quadratic_spline})
            for (const boundary_method method : all_methods)
                for (const stress_order order : {stress_order::usf, stress_order::usavg_plus, stress_order::euler})
                    for (int k = 1; k <= 6; ++k) {
                        scene set = box(dimension, 1., 0.25);
                        set.shape = kind;
                        set.order = order;
                        set.update = fmpm(k);
                        set.boundary_method = method;
                        set.poisson = 0.3;
                        set.acceleration = [](const VectorXd& x, const VectorXd& v, double t) -> VectorXd {
                            return (3 + t) * x - 2 * v;
                        };
                        add_conditions(set);
                        state body = rough_body(set, 2);
                        const double dt = 0.01;
                        for (int n = 0; n < 2; ++n) {
                            const VectorXd before = body.v.transpose() * body.mass;
                            VectorXd loads = VectorXd::Zero(dimension);
                            for (Index p = 0; p < body.size(); ++p)
                                loads += body.mass[p] *
                                         set.acceleration(body.x.row(p).transpose(), body.v.row(p).transpose(), n * dt);
                            const step_result done = advance(set, body, n * dt, dt);
                            const VectorXd after = body.v.transpose() * body.mass;
                            const VectorXd nodal = done.velocity.transpose() * done.mass;
                            const VectorXd given = dt * (loads + done.reactions.colwise().sum().transpose());
                            const double size = before.norm() + dt * done.reactions.norm();
                            REQUIRE((nodal - after).norm() < 1e-13 * size);
                            REQUIRE((after - before - given).norm() < 1e-13 * size);
                        }
                    }
}

TEST_CASE("which boundary methods hold their values, and what they are alike in", "[reference]") {
    for (const Index dimension : {1, 2})
        for (const shape_kind kind : {shape_kind::linear, shape_kind::quadratic_spline}) {
            const random_scene at(dimension, kind);
            const MatrixXd lumped = at.held.imposed(at.shapes.inverse_mass.asDiagonal() * at.momentum, 0.1);
            for (const boundary_method method : all_methods) {
                const nodal_velocity one = at.by(method, 1);
                if (is_unlumped(method))
                    CHECK(at.missing(one.v) > 1e-2);
                else
                    CHECK((one.v - lumped).cwiseAbs().maxCoeff() < 1e-13);
                for (int k = 2; k <= 6; ++k) {
                    const nodal_velocity made = at.by(method, k);
                    if (always_holds(method))
                        CHECK(at.missing(made.v) < 1e-12);
                    else
                        CHECK(at.missing(made.v) > 1e-4);
                    CHECK(at.elsewhere(made.impulse) < 1e-14);
                }
            }
            const nodal_velocity incremental = at.by(boundary_method::incremental, 2);
            const nodal_velocity combined = at.by(boundary_method::combined, 2);
            CHECK((incremental.v - combined.v).norm() < 1e-13);
            CHECK((incremental.impulse - combined.impulse).norm() < 1e-14);
        }
}

TEST_CASE("with many terms incremental and collected are the constrained least squares solution", "[reference]") {
    for (const Index dimension : {1, 2})
        for (const shape_kind kind : {shape_kind::linear, shape_kind::quadratic_spline}) {
            const random_scene at(dimension, kind);
            const MatrixXd best = least_squares(at);
            const MatrixXd force = at.shapes.full_mass * best - at.momentum;  // zero but in held components
            for (const boundary_method method : {boundary_method::incremental, boundary_method::collected}) {
                const nodal_velocity exact = at.by(method, exact_solve);
                CHECK((exact.v - best).norm() < 1e-9 * best.norm());
                CHECK((exact.impulse - force).norm() < 1e-9 * force.norm());
                CHECK(exact.last_increment == 0);
            }
            double error = 1e9;
            for (const int k : {1, 2, 4, 8, 16, 64, 256, 1024, 4096, 16384}) {
                const nodal_velocity made = at.by(boundary_method::incremental, k);
                const double now = mass_norm(made.v - best, at.shapes);
                CHECK(now <= error * (1 + 1e-9) + 1e-9);
                error = now;
            }
            INFO("dimension " << dimension << ", shape " << static_cast<int>(kind) << ": " << error);
            CHECK(error < 1e-6);

            const nodal_velocity later = at.by(boundary_method::velocity, exact_solve);
            const nodal_velocity unlumped = at.by(boundary_method::unlumped2, exact_solve);
            CHECK((later.v - unlumped.v).norm() < 1e-9 * later.v.norm());
            CHECK((later.impulse - unlumped.impulse).norm() < 1e-9 * later.impulse.norm());
        }
}

TEST_CASE("only FMPM in every step has other boundary methods", "[reference]") {
    auto [set, body] = one_particle();
    set.boundary_method = boundary_method::lumped;
    for (const reference::update& by : {pic(), flip(), blend(0.5), xpic(2), periodic_fmpm(2, 2)}) {
        set.update = by;
        CHECK_THROWS_AS(step(set, body, 0., 0.1), std::invalid_argument);
    }
}
