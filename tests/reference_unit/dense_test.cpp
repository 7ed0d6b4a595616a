#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr shape_kind all_shapes[] = {shape_kind::linear, shape_kind::quadratic_spline, shape_kind::cubic_spline};
constexpr stress_order all_orders[] = {stress_order::usf,         stress_order::usl_minus,  stress_order::usl_plus,
                                       stress_order::usavg_minus, stress_order::usavg_plus, stress_order::euler};

std::vector<reference::update> all_updates() {
    return {pic(),   flip(),  flip(1), blend(0.7), graphics_blend(0.9), xpic(1), xpic(2),
            xpic(5), fmpm(1), fmpm(2), fmpm(4)};
}

/// Root mean square errors of a standing wave after one period, by the amplitudes of velocity and strain.
struct wave_errors {
    double velocity;
    double strain;
};

wave_errors standing_wave(const reference::update& by) {
    const double v0 = 0.01;
    scene set;
    set.lower = VectorXd::Zero(1);
    set.upper = VectorXd::Ones(1);
    set.spacing = 1. / 50;
    set.update = by;
    set.order = stress_order::usl_minus;
    set.motion = motion::held;
    set.conditions = {hold_velocity(
        1, [](const VectorXd& at) { return at[0] < 1e-9 || at[0] > 1 - 1e-9; },
        [](const VectorXd&, double) -> VectorXd { return VectorXd::Zero(1); })};
    state bar = make_particles(set, 2, 1., everywhere);
    for (Index p = 0; p < bar.size(); ++p) bar.v(p, 0) = v0 * std::sin(std::numbers::pi * bar.x(p, 0));

    const double dt = 0.1 * set.spacing;
    const int steps = 1000;
    for (int n = 0; n < steps; ++n) step(set, bar, n * dt, dt);

    const double t = steps * dt;
    double velocity = 0;
    double strain = 0;
    for (Index p = 0; p < bar.size(); ++p) {
        const double at = std::numbers::pi * bar.x(p, 0);
        const double exact_v = v0 * std::sin(at) * std::cos(std::numbers::pi * t);
        const double exact_strain = v0 * std::cos(at) * std::sin(std::numbers::pi * t);
        velocity += std::pow((bar.v(p, 0) - exact_v) / v0, 2);
        strain += std::pow((bar.stress[static_cast<std::size_t>(p)](0, 0) - exact_strain) / v0, 2);
    }
    const auto count = static_cast<double>(bar.size());
    return {std::sqrt(velocity / count), std::sqrt(strain / count)};
}

}  // namespace

TEST_CASE("weights of an axis add to one and give back a straight line up to the walls", "[reference]") {
    for (const shape_kind kind : all_shapes)
        for (const Index count : {2, 3, 4, 9}) {
            const double lower = -0.3;
            const double spacing = 0.25;
            const double length = spacing * static_cast<double>(count - 1);
            for (int n = 0; n <= 400; ++n) {
                const double x = lower + length * n / 400;
                const axis_values at = evaluate_axis(kind, x, lower, spacing, count);
                double place = 0;
                double slope = 0;
                for (Index i = 0; i < count; ++i) {
                    place += at.weight[i] * (lower + static_cast<double>(i) * spacing);
                    slope += at.slope[i] * (lower + static_cast<double>(i) * spacing);
                }
                REQUIRE(std::abs(at.weight.sum() - 1) < 1e-14);
                REQUIRE(std::abs(at.slope.sum()) < 1e-13);
                REQUIRE(std::abs(place - x) < 1e-14);
                REQUIRE(std::abs(slope - 1) < 1e-13);
                REQUIRE(at.weight.minCoeff() > -1e-15);
            }
        }
}

TEST_CASE("slopes are the derivatives of the weights", "[reference]") {
    const double spacing = 0.25;
    const double e = 1e-6;
    for (const shape_kind kind : all_shapes)
        for (int n = 0; n < 300; ++n) {
            const double x = -0.3 + 5 * spacing * (n + 0.37) / 300;
            const axis_values here = evaluate_axis(kind, x, -0.3, spacing, 6);
            const axis_values right = evaluate_axis(kind, x + e, -0.3, spacing, 6);
            const axis_values left = evaluate_axis(kind, x - e, -0.3, spacing, 6);
            REQUIRE(((right.weight - left.weight) / (2 * e) - here.slope).cwiseAbs().maxCoeff() < 1e-8);
        }
}

TEST_CASE("a particle on a node belongs to the cell that starts there, on the last node to the last cell",
          "[reference]") {
    const axis_values inside = evaluate_axis(shape_kind::linear, 1., 0., 1., 4);
    CHECK(inside.slope == Eigen::Vector4d(0, -1, 1, 0));
    CHECK(inside.weight == Eigen::Vector4d(0, 1, 0, 0));
    const axis_values wall = evaluate_axis(shape_kind::linear, 3., 0., 1., 4);
    CHECK(wall.slope == Eigen::Vector4d(0, 0, -1, 1));
    CHECK(wall.weight == Eigen::Vector4d(0, 0, 0, 1));
    CHECK_THROWS_AS(evaluate_axis(shape_kind::linear, 3.001, 0., 1., 4), std::domain_error);
}

TEST_CASE("the full matrices give back linear fields and their gradients in every dimension", "[reference]") {
    for (const Index dimension : {1, 2, 3})
        for (const shape_kind kind : all_shapes) {
            scene set = box(dimension, 1., 0.25);
            set.shape = kind;
            const state body = rough_body(set, dimension == 3 ? 1 : 2);
            const basis shapes = evaluate_basis(set, body.x, body.mass);
            MatrixXd nodes(set.node_count(), dimension);
            for (Index i = 0; i < set.node_count(); ++i) nodes.row(i) = set.node_position(i).transpose();
            CHECK((shapes.S.rowwise().sum().array() - 1).abs().maxCoeff() < 1e-14);
            CHECK((shapes.S * nodes - body.x).cwiseAbs().maxCoeff() < 1e-14);
            for (Index b = 0; b < dimension; ++b) {
                const MatrixXd gradient = shapes.G[static_cast<std::size_t>(b)] * nodes;
                MatrixXd expected = MatrixXd::Zero(body.size(), dimension);
                expected.col(b).setOnes();
                CHECK((gradient - expected).cwiseAbs().maxCoeff() < 1e-13);
            }
        }
}

TEST_CASE("particles sit at (s + 1/2)/n of each cell and fill the region", "[reference]") {
    const scene set = box(2, 1., 0.25);
    const state body = make_particles(set, 3, 2., [](const VectorXd& at) { return at[1] < 0.2; });
    REQUIRE(body.size() == 12 * 6);
    CHECK(std::abs(body.x(0, 0) - (-0.3 + 0.25 / 6)) < 1e-15);
    CHECK(std::abs(body.x(1, 0) - (-0.3 + 0.25 / 2)) < 1e-15);
    CHECK(std::abs(body.x(12, 1) - (-0.3 + 0.25 / 2)) < 1e-15);
    CHECK(std::abs(body.volume.sum() - 0.5) < 1e-14);
    CHECK(std::abs(body.mass.sum() - 1.) < 1e-14);
}

TEST_CASE("one particle in one cell does what hand calculation says, in every stress order", "[reference]") {
    // Held at 3 and then 4; `euler` is one step late, at 2 and then 3.
    const auto [order, stress, velocity, reaction] =
        GENERATE(table<stress_order, double, double, double>({{stress_order::usf, 2.8, 5.22, 2.2},
                                                              {stress_order::usl_minus, 2.24, 5.3, 3.},
                                                              {stress_order::usl_plus, 2.52, 5.3, 3.},
                                                              {stress_order::usavg_minus, 2.504, 5.26, 2.6},
                                                              {stress_order::usavg_plus, 2.652, 5.26, 2.6},
                                                              {stress_order::euler, 3.2, 5.3, 3.}}));
    auto [set, body] = one_particle();
    set.order = order;
    const MatrixXd reactions = step(set, body, 0.2, 0.1);
    CHECK(std::abs(body.stress[0](0, 0) - stress) < 1e-13);
    CHECK(std::abs(body.v(0, 0) - velocity) < 1e-13);
    CHECK(std::abs(reactions(0, 0) - reaction) < 1e-12);
    CHECK(reactions(1, 0) == 0);
}

TEST_CASE("one particle in one cell does what hand calculation says, under every update", "[reference]") {
    // Nodal velocities (3, 5) and then (4, 4.6); A = [[1, -1], [-1, 1]] / 2.
    const auto [by, velocity, moved, stress, reaction] =
        GENERATE(table<reference::update, double, double, double, double>({{pic(), 4.3, 0.43, 2.24, -7.},
                                                                           {flip(), 5.3, 0.43, 2.24, 3.},
                                                                           {flip(1), 5.3, 0.415, 2.24, 3.},
                                                                           {blend(0.7), 5., 0.43, 2.24, 0.},
                                                                           {graphics_blend(0.7), 5., 0.5, 2.24, 0.},
                                                                           {xpic(2), 4.8, 0.39, 2.24, -2.},
                                                                           {fmpm(2), 4.45, 0.4725, 2.36, -5.5}}));
    auto [set, body] = one_particle();
    set.update = by;
    const MatrixXd reactions = step(set, body, 0.2, 0.1);
    CHECK(std::abs(body.v(0, 0) - velocity) < 1e-13);
    CHECK(std::abs(body.x(0, 0) - 0.5 - moved) < 1e-13);
    CHECK(std::abs(body.stress[0](0, 0) - stress) < 1e-13);
    CHECK(std::abs(reactions(0, 0) - reaction) < 1e-12);
}

TEST_CASE("euler takes no boundary value from before the start", "[reference]") {
    scene set;
    set.lower = VectorXd::Zero(1);
    set.upper = VectorXd::Ones(1);
    set.order = stress_order::euler;
    set.start_time = 0.2;
    double earliest = 1e9;
    set.conditions = {hold_velocity(
        1, [](const VectorXd& at) { return at[0] < 0.5; },
        [&](const VectorXd&, double t) -> VectorXd {
            earliest = std::min(earliest, t);
            return VectorXd::Zero(1);
        })};
    state body = make_particles(set, 1, 1., everywhere);
    step(set, body, 0.2, 0.1);
    CHECK(earliest == 0.2);
}

TEST_CASE("momentum changes by loads and reactions alone, for every update, order and shape", "[reference]") {
    for (const Index dimension : {1, 2, 3})
        for (const shape_kind kind : all_shapes)
            for (const stress_order order : all_orders)
                for (const reference::update& by : all_updates()) {
                    if (dimension == 3 && order != stress_order::usavg_plus) continue;
                    scene set = box(dimension, 1., 0.25);
                    set.shape = kind;
                    set.order = order;
                    set.update = by;
                    set.poisson = 0.3;
                    set.acceleration = [](const VectorXd& x, const VectorXd& v, double t) -> VectorXd {
                        return (3 + t) * x - 2 * v;
                    };
                    add_conditions(set);
                    state body = rough_body(set, dimension == 3 ? 1 : 2);
                    const double dt = 0.01;
                    for (int n = 0; n < 2; ++n) {
                        const VectorXd before = body.v.transpose() * body.mass;
                        VectorXd loads = VectorXd::Zero(dimension);
                        for (Index p = 0; p < body.size(); ++p)
                            loads += body.mass[p] *
                                     set.acceleration(body.x.row(p).transpose(), body.v.row(p).transpose(), n * dt);
                        const MatrixXd reactions = step(set, body, n * dt, dt);
                        const VectorXd after = body.v.transpose() * body.mass;
                        const VectorXd given = dt * (loads + reactions.colwise().sum().transpose());
                        const double size = before.norm() + dt * reactions.norm();
                        REQUIRE((after - before - given).norm() < 1e-13 * size);
                    }
                }
}

TEST_CASE("a force on a node without mass is accounted for", "[reference]") {
    // The particle on the wall has weight 1 there and a gradient at the next node, which gets no mass.
    scene set = box(1, 1., 0.25);
    state body = make_particles(set, 1, 1., [](const VectorXd& at) { return at[0] < -0.1; });
    REQUIRE(body.size() == 1);
    body.x(0, 0) = set.lower[0];
    body.stress[0](0, 0) = 3;
    const MatrixXd reactions = step(set, body, 0., 0.01);
    CHECK(std::abs(body.mass[0] * body.v(0, 0) - 0.01 * reactions.sum()) < 1e-15);
    CHECK(std::abs(reactions(1, 0) - 3 * body.volume[0] / set.spacing) < 1e-13);
}

TEST_CASE("a body in uniform motion keeps it under every update", "[reference]") {
    for (const shape_kind kind : all_shapes)
        for (const stress_order order : all_orders)
            for (const reference::update& by : all_updates()) {
                scene set = box(2, 1., 0.125);
                set.shape = kind;
                set.order = order;
                set.update = by;
                state body = make_particles(set, 2, 1., [](const VectorXd& at) { return at.norm() < 0.2; });
                body.v.col(0).setConstant(0.5);
                body.v.col(1).setConstant(0.25);
                const MatrixXd start = body.x;
                for (int n = 0; n < 5; ++n) step(set, body, 0.02 * n, 0.02);
                double stress = 0;
                for (const MatrixXd& s : body.stress) stress = std::max(stress, s.cwiseAbs().maxCoeff());
                REQUIRE((body.v.col(0).array() - 0.5).abs().maxCoeff() < 1e-12);
                REQUIRE((body.v.col(1).array() - 0.25).abs().maxCoeff() < 1e-12);
                REQUIRE(((body.x - start).col(0).array() - 0.05).abs().maxCoeff() < 1e-12);
                REQUIRE(stress < 1e-12);
            }
}

TEST_CASE("FMPM(1) and XPIC(1) have the velocities of PIC", "[reference]") {
    for (const Index dimension : {1, 2})
        for (const stress_order order : all_orders) {
            scene set = box(dimension, 1., 0.25);
            set.shape = shape_kind::quadratic_spline;
            set.order = order;
            set.motion = motion::held;
            add_conditions(set);
            std::vector<MatrixXd> v;
            for (const reference::update& by : {pic(), fmpm(1), xpic(1)}) {
                set.update = by;
                state body = rough_body(set, 2);
                for (int n = 0; n < 10; ++n) step(set, body, 0.01 * n, 0.01);
                v.push_back(body.v);
            }
            CHECK((v[1] - v[0]).norm() < 1e-13);
            CHECK((v[2] - v[0]).norm() < 1e-13);
        }
}

TEST_CASE("with many increments FMPM solves the constrained least-squares problem", "[reference]") {
    scene set = box(1, 1., 0.25);
    add_conditions(set);
    const state body = rough_body(set, 4);
    const basis shapes = evaluate_basis(set, body.x, body.mass);
    const held_nodes held(set, shapes);
    const VectorXd P = shapes.S.transpose() * (body.mass.asDiagonal() * body.v);
    const MatrixXd lumped = held.imposed(shapes.inverse_mass.asDiagonal() * P, 0.1);
    const full_mass_velocity full(lumped, 4000, shapes, held);
    CHECK((held.imposed(full.v, 0.1) - full.v).norm() < 1e-14);

    // Minimise sum_p M (V - S v)^2 over the free nodes 1 .. 3, with the ends at their values.
    const MatrixXd mass = shapes.S.transpose() * body.mass.asDiagonal() * shapes.S;
    const VectorXd right =
        P.segment(1, 3) - mass.block(1, 0, 3, 1) * lumped(0, 0) - mass.block(1, 4, 3, 1) * lumped(4, 0);
    const VectorXd best = mass.block(1, 1, 3, 3).ldlt().solve(right);
    CHECK((full.v.block(1, 0, 3, 1) - best).norm() < 1e-12);
}

TEST_CASE("plane strain and three dimensions agree with Hooke's law", "[reference]") {
    scene set = box(3, 1., 0.5);
    set.young = VectorXd::Constant(1, 10.);
    set.poisson = 0.25;
    state body = make_particles(set, 1, 1., everywhere);
    const basis shapes = evaluate_basis(set, body.x, body.mass);
    MatrixXd v(set.node_count(), 3);
    for (Index i = 0; i < set.node_count(); ++i) {
        const VectorXd at = set.node_position(i);
        v.row(i) << 2 * at[0] + 3 * at[1], -at[1], 0.5 * at[2] - at[0];
    }
    strain_particles(set, body, shapes, v, 0.1);
    // Strain: exx = 0.2, eyy = -0.1, ezz = 0.05, exy = 0.15, exz = -0.05. With E = 10, nu = 1/4: lambda = mu = 4.
    MatrixXd expected(3, 3);
    expected << 2.2, 1.2, -0.4, 1.2, -0.2, 0, -0.4, 0, 1.0;
    for (const MatrixXd& stress : body.stress) CHECK((stress - expected).norm() < 1e-13);
}

TEST_CASE("standing wave: errors after one period", "[reference]") {
    const auto [by, velocity, strain] = GENERATE(table<reference::update, double, double>(
        {{fmpm(2), 3e-4, 1.2e-3}, {flip(), 1e-4, 3e-3}, {xpic(2), 4e-4, 3e-3}}));
    const wave_errors errors = standing_wave(by);
    INFO("velocity_l2 " << errors.velocity << ", strain_l2 " << errors.strain);
    CHECK(errors.velocity < velocity);
    CHECK(errors.strain < strain);
}
