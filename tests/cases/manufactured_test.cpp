// Manufactured solutions in 2D and 3D: the body force is what the law leaves to do, and the errors fall as they should.
#include "manufactured_run.hpp"

#include "catch.hpp"

#include <cmath>

namespace {

using std::numbers::pi;

/// What a particle shows to the body force.
template <int D> struct undeformed_place {
    Eigen::Matrix<double, D, 1> X;
    auto operator[](manufactured::sine) const { return (pi * X).array().sin().matrix().eval(); }
    auto operator[](manufactured::cosine) const { return (pi * X).array().cos().matrix().eval(); }
};

/// Momentum rho0 u_tt - Div P - rho0 b, by differences of the law's own stress and of the displacement.
template <int D> double left_over(const Eigen::Matrix<double, D, 1>& X, double t) {
    manufactured_options o;
    o.dim = D;
    const auto axes = manufactured::axes_of<D>(o);
    const tamis::neo_hookean law{.young = manufactured::young, .poisson = o.poisson, .density = manufactured::density};
    const manufactured::body_force<D> force{axes, tamis::detail::lame_mu(law.young, law.poisson),
                                            tamis::detail::lame_lambda(law.young, law.poisson)};
    const auto b = force.acceleration_of(undeformed_place<D>{X}, t);
    const auto nominal = [&](const Eigen::Matrix<double, D, 1>& at, int d) {
        tamis::matrix<D, double> F = tamis::matrix<D, double>::Identity();
        for (int e = 0; e < D; ++e) F(e, e) = axes[std::size_t(e)].stretch(at[e], t);
        return law.at_deformation(F)(d, d) / F(d, d);
    };
    double worst = 0;
    for (int d = 0; d < D; ++d) {
        const double step = 1e-4;
        Eigen::Matrix<double, D, 1> up = X, down = X;
        up[d] += step;
        down[d] -= step;
        const double divergence = (nominal(up, d) - nominal(down, d)) / (2 * step);
        const auto& u = axes[std::size_t(d)];
        const double acceleration =
            (u.displacement(X[d], t + step) - 2 * u.displacement(X[d], t) + u.displacement(X[d], t - step)) /
            (step * step);
        CHECK(std::abs((u.displacement(X[d], t + step) - u.displacement(X[d], t - step)) / (2 * step) -
                       u.velocity(X[d], t)) < 1e-7);
        CHECK(std::abs(u.start_of(X[d] + u.displacement(X[d], t), t) - X[d]) < 1e-14);
        worst = std::max(worst, std::abs(manufactured::density * (acceleration - b[d]) - divergence));
    }
    return worst;
}

manufactured_result with(int dim, int cells, const std::string& shape, const std::string& update,
                         double courant = 0.2) {
    manufactured_options o;
    o.dim = dim;
    o.cells = cells;
    o.shape = shape;
    o.update = update;
    o.courant = courant;
    return run_manufactured(o);
}
double order(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace

TEST_CASE("manufactured solution: the body force is what acceleration and stress ask for") {
    for (const double t : {0., 0.3, 1.1, 1.75}) {
        CHECK(left_over<2>({0.2, 0.65}, t) < 1e-6);
        CHECK(left_over<2>({0.97, 0.5}, t) < 1e-6);
        CHECK(left_over<3>({0.2, 0.65, 0.4}, t) < 1e-6);
    }
}

TEST_CASE("manufactured solution: displacements fall with the second order, and particles cross cells") {
    for (const std::string shape : {"cpgimp", "quadratic"}) {
        CAPTURE(shape);
        const manufactured_result coarse = with(2, 12, shape, "flip"), fine = with(2, 24, shape, "flip");
        CAPTURE(coarse.place_l2, fine.place_l2, coarse.velocity_l2, fine.velocity_l2);
        CHECK(order(coarse.place_l2, fine.place_l2) > 1.8);
        CHECK(fine.crossings > 4 * fine.particles);
        CHECK(std::abs(fine.energy_error) < 0.02);
    }
    // FMPM's error at the usual steps is that of time, of first order.
    const manufactured_result some = with(2, 8, "cpgimp", "fmpm", 0.05), more = with(2, 16, "cpgimp", "fmpm", 0.05);
    CAPTURE(some.place_l2, more.place_l2, some.velocity_l2, more.velocity_l2);
    CHECK(order(some.place_l2, more.place_l2) > 1.8);
    CHECK(order(some.velocity_l2, more.velocity_l2) > 1.8);

    const manufactured_result coarse = with(3, 6, "cpgimp", "flip"), fine = with(3, 12, "cpgimp", "flip");
    CAPTURE(coarse.place_l2, fine.place_l2, coarse.velocity_l2, fine.velocity_l2);
    CHECK(order(coarse.place_l2, fine.place_l2) > 1.8);
    CHECK(order(coarse.velocity_l2, fine.velocity_l2) > 1.8);
}

TEST_CASE("manufactured solution: what is not compiled is told") {
    try {
        with(2, 8, "cubic", "xpic");
        FAIL("it ran");
    } catch (const std::invalid_argument& e) {
        CAPTURE(e.what());
        CHECK(std::string(e.what()).find("quadratic flip usl-") != std::string::npos);
    }
    CHECK_THROWS_AS(with(4, 8, "quadratic", "flip"), std::invalid_argument);
    CHECK_THROWS_AS(with(2, 2, "quadratic", "flip"), std::invalid_argument);
}
