#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr shape_kind both[] = {shape_kind::uniform_gimp, shape_kind::contiguous_gimp};

/// Mean of the linear weights, continued beyond the walls in a straight line, over [x - half, x + half]: midpoint rule.
VectorXd averaged(double x, double half, double lower, double spacing, Index count) {
    const int points = 4000;
    VectorXd sum = VectorXd::Zero(count);
    for (int n = 0; n < points; ++n) {
        const double s = (x - lower + half * (2 * (n + 0.5) / points - 1)) / spacing;
        const double cell = std::min(std::max(std::floor(s), 0.), static_cast<double>(count - 2));
        const auto i = static_cast<Index>(cell);
        sum[i] += 1 - (s - cell);
        sum[i + 1] += s - cell;
    }
    return sum / points;
}

}  // namespace

TEST_CASE("GIMP's weights are averages of the linear ones, and keep straight lines up to the walls", "[reference]") {
    const double lower = -0.3, spacing = 0.25, e = 1e-6;
    for (const Index count : {2, 3, 6})
        for (const double half : {spacing / 12, spacing / 4, spacing / 2, 0.9 * spacing, 1.3 * spacing})
            for (int n = 0; n <= 60; ++n) {
                const double length = spacing * static_cast<double>(count - 1);
                const double x = lower + length * n / 60;
                const auto at = [&](double place) {
                    return evaluate_axis(shape_kind::uniform_gimp, place, lower, spacing, count, half);
                };
                const axis_values here = at(x);
                const VectorXd nodes = VectorXd::LinSpaced(count, lower, lower + length);
                REQUIRE(std::abs(here.weight.sum() - 1) < 1e-13);
                REQUIRE(std::abs(here.slope.sum()) < 1e-12);
                REQUIRE(std::abs(here.weight.dot(nodes) - x) < 1e-13);
                REQUIRE(std::abs(here.slope.dot(nodes) - 1) < 1e-12);
                REQUIRE((here.weight - averaged(x, half, lower, spacing, count)).cwiseAbs().maxCoeff() < 1e-3);
                // Only tried for domains no wider than a cell.
                if (half <= spacing / 2) REQUIRE(here.weight.minCoeff() > -1e-14);
                if (n == 0 || n == 60) continue;
                const VectorXd slope = (at(x + e).weight - at(x - e).weight) / (2 * e);
                REQUIRE((slope - here.slope).cwiseAbs().maxCoeff() < 1e-4);
            }
}

TEST_CASE("GIMP's textbook pieces", "[reference]") {
    // Half width l = 1/4 of a spacing: 1 - (d^2 + l^2)/(2 l), 1 - |d|, (1 + l - |d|)^2/(4 l).
    for (double d = -1.4; d < 1.4; d += 0.01) {
        const double r = std::abs(d), l = 0.25;
        const double expected = r < l       ? 1 - (r * r + l * l) / (2 * l)
                                : r < 1 - l ? 1 - r
                                : r < 1 + l ? (1 + l - r) * (1 + l - r) / (4 * l)
                                            : 0;
        CHECK(std::abs(bump(shape_kind::uniform_gimp, d, l) - expected) < 1e-14);
    }
}

TEST_CASE("domains have the particles' own width, and contiguous ones stretch along each axis", "[reference]") {
    scene set = box(2, 1., 0.25);
    state body = make_particles(set, 2, 1., everywhere);
    CHECK(std::abs(body.half_width[3] - 0.25 / 4) < 1e-16);
    body.deformation[3] << 1.5, 0.7, -0.2, 0.5;
    set.shape = shape_kind::uniform_gimp;
    CHECK((half_widths(set, body).row(3) - Eigen::RowVector2d(1, 1) / 16).norm() < 1e-15);
    set.shape = shape_kind::contiguous_gimp;
    CHECK((half_widths(set, body).row(3) - Eigen::RowVector2d(1.5, 0.5) / 16).norm() < 1e-15);
    body.deformation[3](0, 0) = -1;
    CHECK_THROWS_AS(evaluate_basis(set, body), std::domain_error);
    CHECK_THROWS_AS(evaluate_basis(set, body.x, body.mass), std::invalid_argument);
}

TEST_CASE("the two kinds of GIMP are one until particles are stretched", "[reference]") {
    std::vector<state> bodies;
    for (const shape_kind kind : both) {
        scene set = box(2, 1., 0.25);
        set.shape = kind;
        set.update = fmpm(2);
        bodies.push_back(rough_body(set, 2));
        step(set, bodies.back(), 0., 0.01);
    }
    CHECK(bodies[0].v == bodies[1].v);
    scene set = box(2, 1., 0.25);
    for (std::size_t n = 0; n < 2; ++n) {
        set.shape = both[n];
        step(set, bodies[n], 0.01, 0.01);
    }
    CHECK((bodies[0].v - bodies[1].v).norm() > 1e-6);
}

TEST_CASE("momentum changes by reactions alone with GIMP, for both laws", "[reference]") {
    for (const shape_kind kind : both)
        for (const law_kind law : {law_kind::linear_elastic, law_kind::neo_hookean})
            for (const boundary_method method : {boundary_method::incremental, boundary_method::collected}) {
                scene set = box(2, 1., 0.25);
                set.shape = kind;
                set.law = law;
                set.update = fmpm(3);
                set.boundary_method = method;
                set.order = stress_order::usavg_plus;
                set.poisson = 0.3;
                add_conditions(set);
                state body = rough_body(set, 2);
                for (int n = 0; n < 5; ++n) {
                    const VectorXd before = body.v.transpose() * body.mass;
                    const MatrixXd reactions = step(set, body, 0.01 * n, 0.01);
                    const VectorXd given = 0.01 * reactions.colwise().sum().transpose();
                    const VectorXd after = body.v.transpose() * body.mass;
                    CHECK((after - before - given).norm() < 1e-13 * (before.norm() + 0.01 * reactions.norm()));
                }
            }
}
