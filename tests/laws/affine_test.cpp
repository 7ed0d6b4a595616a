// What affine transfers keep of a free body without round-off's help: linear momentum, and the angular momentum that
// includes the particles' own,
//
//     L = sum_p M [X x V + D axial(C)],   axial(C) = (C_zy - C_yz, ...), D = h^2/4 for quadratic splines, h^2/3 for
//     cubic ones,
//
// the second part being sum_i w_ip (x_i - X) x M C (x_i - X). To nodes: sum_i x_i x p_i = L, as sum_i w = 1 and
// sum_i w (x_i - X) = 0. Back: B = sum_i w v_i (x) (x_i - X) = C' D gives the particles what the nodes have about X,
// and X' = X + V' dt changes nothing, V' x V' being 0. Forces: sum_i x_i x f_i = 0 for symmetric stresses. Neither TPIC
// nor FLIP with affine spreading has all of these.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double h = 0.1;
template <int D> using place = point<D, double>;

template <int D> uniform_grid<D, double> box() {
    if constexpr (D == 2)
        return {{0., 0.}, {3., 3.}, h};
    else
        return {{0., 0., 0.}, {2., 2., 2.}, h};
}
/// The axial vectors of X x V, of which 2D has the last.
template <int D> point<3, double> cross(const place<D>& a, const place<D>& b) {
    point<3, double> full_a = point<3, double>::Zero(), full_b = full_a, c;
    full_a.template head<D>() = a;
    full_b.template head<D>() = b;
    c << full_a[1] * full_b[2] - full_a[2] * full_b[1], full_a[2] * full_b[0] - full_a[0] * full_b[2],
        full_a[0] * full_b[1] - full_a[1] * full_b[0];
    return c;
}
template <int D> point<3, double> axial(const matrix<D, double>& c) {
    matrix<3, double> full = matrix<3, double>::Zero();
    full.template topLeftCorner<D, D>() = c;
    return {full(2, 1) - full(1, 2), full(0, 2) - full(2, 0), full(1, 0) - full(0, 1)};
}

struct momenta {
    point<3, double> linear = point<3, double>::Zero(), angular = linear, of_places = linear;
};
template <class Body> momenta momenta_of(const Body& body, double moment) {
    constexpr int D = Body::dim;
    momenta all;
    for (const auto p : body) {
        const place<D> at = p[x], speed = p[v];
        all.linear.template head<D>() += p[m] * speed;
        all.of_places += p[m] * cross<D>(at, speed);
        all.angular += p[m] * (cross<D>(at, speed) + moment * axial<D>(matrix<D, double>(p[C])));
    }
    return all;
}

/// A block that turns, shears and rings, far from walls: relative changes of momenta over so many steps.
template <int D, class Shape, class Update, class Order> momenta lost(double moment, int steps) {
    solver mpm{box<D>(), Shape{}, Update{}, Order{}};
    const double middle = mpm.grid().upper()[0] / 2;
    auto block = mpm.make_body(
        neo_hookean{.young = 20, .poisson = 0.3, .density = 1.3},
        [&](const auto& at) { return (at.array() - middle).abs().maxCoeff() < 0.36; }, per_cell{2});
    for (auto p : block) {
        const place<D> r = place<D>(p[x]) - place<D>::Constant(middle);
        place<D> speed = place<D>::Constant(0.05);
        speed[0] += -0.9 * r[1] + 0.3 * std::sin(7 * r[1]);
        speed[1] += 0.9 * r[0] + 0.2 * r[0] * r[1];
        p[v] = speed;
        p[m] *= 1 + 0.4 * std::sin(13 * r[0]);
    }
    const momenta before = momenta_of(std::as_const(block), moment);
    const double dt = 0.2 * h / 6;
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), dt);
    const momenta after = momenta_of(std::as_const(block), moment);
    CHECK(mpm.crossings() > 0);
    momenta off;
    off.linear = (after.linear - before.linear) / before.linear.norm();
    off.angular = (after.angular - before.angular) / before.angular.norm();
    off.of_places = (after.of_places - before.of_places) / before.of_places.norm();
    CAPTURE(D, Shape::name, Update::name, Order::name, off.angular.norm(), off.of_places.norm());
    CHECK(off.linear.norm() < 1e-12);
    return off;
}

}  // namespace

TEST_CASE("affine: APIC keeps linear momentum, and angular momentum with the particles' own, over 1000 steps") {
    CHECK(lost<2, quadratic_spline, apic, usl_minus>(h * h / 4, 1000).angular.norm() < 1e-12);
    CHECK(lost<2, quadratic_spline, apic, usl_plus>(h * h / 4, 1000).angular.norm() < 1e-12);
    CHECK(lost<2, cubic_spline, apic, usl_minus>(h * h / 3, 1000).angular.norm() < 1e-12);
    CHECK(lost<3, quadratic_spline, apic, usf>(h * h / 4, 1000).angular.norm() < 1e-12);
}
TEST_CASE("affine: what particles' places and velocities have alone is not kept") {
    CHECK(lost<2, quadratic_spline, apic, usl_minus>(h * h / 4, 300).of_places.norm() > 1e-6);
}
TEST_CASE("affine: TPIC, FLIP with affine spreading and linear functions keep linear momentum") {
    CHECK(lost<2, quadratic_spline, tpic, usl_minus>(h * h / 4, 300).angular.norm() > 1e-12);
    CHECK(lost<2, quadratic_spline, affine_flip, usl_minus>(h * h / 4, 300).angular.norm() > 1e-12);
    CHECK(lost<2, linear, apic, usl_plus>(0, 300).angular.norm() > 1e-12);
}
