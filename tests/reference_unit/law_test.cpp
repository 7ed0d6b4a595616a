#include <cmath>

#include "catch.hpp"
#include "rough.hpp"

using namespace reference;
using namespace rough;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Stored energy: mu/2 (tr B - D - 2 ln J) + lambda/2 (ln J)^2.
double energy(const MatrixXd& F, double young, double poisson) {
    const double mu = young / (2 * (1 + poisson));
    const double lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
    const double log_J = std::log(F.determinant());
    return mu / 2 * (F.squaredNorm() - static_cast<double>(F.rows()) - 2 * log_J) + lambda / 2 * log_J * log_J;
}

}  // namespace

TEST_CASE("neo-Hookean stress is the derivative of its energy", "[reference]") {
    for (const Index dimension : {1, 2, 3}) {
        MatrixXd F = MatrixXd::Identity(dimension, dimension);
        for (Index a = 0; a < dimension; ++a)
            for (Index b = 0; b < dimension; ++b) F(a, b) += 0.3 * std::sin(1. + static_cast<double>(3 * a + 5 * b));
        const double e = 1e-6;
        MatrixXd nominal(dimension, dimension);
        for (Index a = 0; a < dimension; ++a)
            for (Index b = 0; b < dimension; ++b) {
                MatrixXd more = F, less = F;
                more(a, b) += e;
                less(a, b) -= e;
                nominal(a, b) = (energy(more, 10, 0.3) - energy(less, 10, 0.3)) / (2 * e);
            }
        CHECK((nominal * F.transpose() - neo_hookean_stress(F, 10, 0.3)).norm() < 1e-7);
    }
}

TEST_CASE("deformation gradients follow the velocity gradient", "[reference]") {
    scene set = box(2, 1., 0.25);
    set.law = law_kind::neo_hookean;
    set.young = VectorXd::Constant(1, 10.);
    set.poisson = 0.25;  // lambda = mu = 4
    state body = rough_body(set, 2);
    const basis shapes = evaluate_basis(set, body);
    MatrixXd L(2, 2), F(2, 2);
    L << 2, 3, -1, 0.5;
    F << 1.1, 0.2, 0, 0.9;
    for (MatrixXd& its : body.deformation) its = F;
    MatrixXd v(set.node_count(), 2);
    for (Index i = 0; i < v.rows(); ++i) v.row(i) = (L * set.node_position(i)).transpose();
    strain_particles(set, body, shapes, v, 0.1);
    // I + 0.1 L = [[1.2, 0.3], [-0.1, 1.05]]
    MatrixXd expected(2, 2), stress(2, 2);
    expected << 1.32, 0.51, -0.11, 0.925;
    stress << 4 * (1.32 * 1.32 + 0.51 * 0.51 - 1), 4 * (-1.32 * 0.11 + 0.51 * 0.925), 0,
        4 * (0.11 * 0.11 + 0.925 * 0.925 - 1);
    stress(1, 0) = stress(0, 1);
    stress.diagonal().array() += 4 * std::log(1.32 * 0.925 + 0.51 * 0.11);
    for (std::size_t p = 0; p < body.deformation.size(); ++p) {
        CHECK((body.deformation[p] - expected).norm() < 1e-13);
        CHECK((body.stress[p] - stress).norm() < 1e-12);
    }
}

TEST_CASE("at small strain a neo-Hookean solid is linear elastic", "[reference]") {
    // In 1D it is held sideways, the bar is not: they are the same for Poisson's ratio 0.
    for (const Index dimension : {1, 2, 3}) {
        scene set = box(dimension, 1., 0.25);
        set.poisson = dimension == 1 ? 0 : 0.3;
        state linear = make_particles(set, 2, 1., everywhere);
        state other = linear;
        const basis shapes = evaluate_basis(set, linear);
        MatrixXd v(set.node_count(), dimension);
        for (Index i = 0; i < v.rows(); ++i) v.row(i) = 1e-6 * (3 * set.node_position(i).array().sin()).matrix();
        strain_particles(set, linear, shapes, v, 1.);
        set.law = law_kind::neo_hookean;
        strain_particles(set, other, shapes, v, 1.);
        for (std::size_t p = 0; p < linear.stress.size(); ++p)
            CHECK((linear.stress[p] - other.stress[p]).norm() < 1e-5 * linear.stress[p].norm());
    }
}
