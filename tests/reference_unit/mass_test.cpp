#include <cmath>
#include <vector>

#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST_CASE("the sum of increments is the inverse mass matrix of k terms", "[reference]") {
    for (const shape_kind kind : {shape_kind::linear, shape_kind::quadratic_spline}) {
        scene set = box(2, 0.75, 0.25);
        set.shape = kind;
        const state body = rough_body(set, 3);
        const basis shapes = evaluate_basis(set, body);
        const held_nodes none(set, shapes);
        const MatrixXd P = shapes.S.transpose() * (body.mass.asDiagonal() * body.v);
        const MatrixXd lumped = shapes.inverse_mass.asDiagonal() * P;
        for (const int k : {1, 2, 3, 10}) {
            const MatrixXd inverse = inverse_mass_matrix(shapes, k);
            CHECK((inverse - inverse.transpose()).norm() < 1e-12 * inverse.norm());
            CHECK((inverse * P - full_mass_velocity(lumped, k, shapes, none).v).norm() < 1e-12);
        }
        const MatrixXd identity = MatrixXd::Identity(set.node_count(), set.node_count());
        CHECK((shapes.full_mass * inverse_mass_matrix(shapes, exact_solve) - identity).norm() < 1e-9);
    }
}

TEST_CASE("a singular full mass matrix is refused, unless conditions rule its null vector out", "[reference]") {
    scene set = box(1, 1., 0.25);
    state body = make_particles(set, 1, 1., everywhere);
    body.v.setOnes();
    set.update = fmpm(exact_solve);
    CHECK_THROWS_AS(step(set, body, 0., 0.01), std::domain_error);
    set.conditions = {hold_velocity(
        1, [&](const VectorXd& at) { return at[0] < set.lower[0] + 1e-9; },
        [](const VectorXd&, double) -> VectorXd { return VectorXd::Constant(1, 2.); })};
    const step_result done = advance(set, body, 0., 0.01);
    // All particles keep their velocity 1, by nodes at 2 and 0 in turn.
    CHECK((body.v.array() - 1).abs().maxCoeff() < 1e-12);
    CHECK((done.velocity.col(0) - VectorXd(VectorXd::Map(std::vector<double>{2, 0, 2, 0, 2}.data(), 5))).norm() <
          1e-12);
    CHECK(done.reactions.norm() < 1e-10);
    set.boundary_method = boundary_method::collected;
    CHECK_THROWS_AS(step(set, body, 0., 0.01), std::domain_error);
}

TEST_CASE("an exact solve lets a node without mass be", "[reference]") {
    scene set = box(1, 1., 0.25);
    add_conditions(set);
    set.update = fmpm(exact_solve);
    state body = make_particles(set, 3, 1., [](const VectorXd& at) { return at[0] < 0; });
    body.v.setConstant(0.1);
    const step_result done = advance(set, body, 0., 0.01);
    CHECK(done.mass[4] == 0);
    CHECK(done.velocity(4, 0) == 0);
    CHECK(std::abs(done.velocity(0, 0) - 0.01) < 1e-12);  // 0.3 + t + x
    CHECK(body.v.allFinite());
}

TEST_CASE("the last increment's norm", "[reference]") {
    // dv_1 = (4, 4.6); dv_2 = A dv_1 = (-0.3, 0.3), of which the first node's is cut.
    const auto [by, norm] = GENERATE(table<reference::update, double>({{fmpm(1), std::sqrt((16 + 21.16) / 2)},
                                                                       {fmpm(2), 0.3 / std::sqrt(2)},
                                                                       {fmpm(3), 0.15 / std::sqrt(2)},
                                                                       {xpic(2), 1 / std::sqrt(2)},
                                                                       {flip(), 0.},
                                                                       {periodic_fmpm(2, 2), 0.}}));
    auto [set, body] = one_particle();
    set.update = by;
    CHECK(std::abs(advance(set, body, 0.2, 0.1).last_increment - norm) < 1e-13);

    // Before b is imposed dv_1 = (5.4, 4.6), dv_2 = (0.4, -0.4).
    auto [other, its] = one_particle();
    other.update = fmpm(2);
    other.boundary_method = boundary_method::velocity;
    CHECK(std::abs(advance(other, its, 0.2, 0.1).last_increment - 0.4) < 1e-13);
}

TEST_CASE("periodic FMPM is FMPM in every m-th step and FLIP between", "[reference]") {
    for (const stress_order order : {stress_order::usavg_minus, stress_order::usl_plus}) {
        scene set = box(2, 1., 0.25);
        set.shape = shape_kind::quadratic_spline;
        set.order = order;
        set.poisson = 0.3;
        add_conditions(set);
        scene turns = set;
        set.update = periodic_fmpm(3, 3, 0.5);
        state body = rough_body(set, 2);
        state other = body;
        for (int n = 1; n <= 7; ++n) {
            turns.update = n % 3 == 0 ? fmpm(3) : flip(0.5);
            const MatrixXd reactions = step(set, body, 0.01 * n, 0.01);
            CHECK(reactions == step(turns, other, 0.01 * n, 0.01));
            CHECK(body.v == other.v);
            CHECK(body.x == other.x);
            CHECK(body.stress == other.stress);
        }
    }
    auto [set, body] = one_particle();
    set.update = periodic_fmpm(2, 0);
    CHECK_THROWS_AS(step(set, body, 0., 0.1), std::invalid_argument);
}

TEST_CASE("the series without a term moves by the mean of p/m and p+/m", "[reference]") {
    for (const reference::update& by : {fmpm(0), xpic(0)}) {
        scene set = box(1, 1., 0.25);
        set.update = by;
        state body = rough_body(set, 3);
        const state start = body;
        const basis shapes = evaluate_basis(set, body);
        const VectorXd before =
            shapes.inverse_mass.asDiagonal() * (shapes.S.transpose() * (body.mass.asDiagonal() * body.v));
        const step_result done = advance(set, body, 0., 0.01);
        CHECK((body.v - start.v - shapes.S * (done.velocity - before)).norm() < 1e-13);
        CHECK((body.x - start.x - shapes.S * (done.velocity + before) / 2 * 0.01).norm() < 1e-14);
    }
}
