#include <tamis/tamis.hpp>

#include <cmath>
#include <set>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 1};

}  // namespace

TEST_CASE("load: gravity is the same everywhere, in lanes too") {
    const gravity<point<2, double>> load{{0.5, -9.81}};
    const point<2, double> at(3, 4);
    CHECK(load.acceleration(at, at, 1.) == point<2, double>(0.5, -9.81));
    STATIC_REQUIRE(BodyLoad<gravity<point<2, double>>, point<2, double>>);
    using T = native_lanes::type<double>;
    const space<2, T>::vector lanes_at(T(1.), T(2.));
    const auto b = load.acceleration(lanes_at, lanes_at, 0.);
    CHECK_FALSE(lane<T>::any(b[1] != T(-9.81)));
}

TEST_CASE("load: a function of place, velocity and time is asked once a step for every particle") {
    std::multiset<double> asked;
    double when = -1;
    solver mpm{uniform_grid{{0.}, {3.}, 0.25}, quadratic_spline{}, pic{}, held{},
               body_acceleration{[&](const auto& at, const auto& speed, double t) {
                   asked.insert(at[0]);
                   CHECK(speed[0] == 0.25);
                   when = t;
                   return (at * 0 + speed * 2).eval();
               }}};
    mpm.start_at(4);
    auto bar = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1.1; }, per_cell{2});
    for (auto p : bar) p[v][0] = 0.25;
    mpm.step(bodies(bar), 0.5);
    CHECK(when == 4);
    CHECK(asked.size() == bar.size());
    auto place = asked.begin();
    std::set<double> there;
    for (const auto p : std::as_const(bar)) {
        there.insert(p[x][0]);
        CHECK(std::abs(p[v][0] - 0.5) < 1e-15);
    }
    for (const double at : there) CHECK(std::abs(at - *place++) < 1e-15);
}

TEST_CASE("load: the acceleration of a place pulls there") {
    // b = -x gives dV = -x dt; places change by 1e-6 of themselves.
    solver mpm{uniform_grid{{-1., -1.}, {1., 1.}, 0.125}, quadratic_spline{}, flip{},
               body_acceleration{[](const auto& at, const auto&, double) { return (-at).eval(); }}};
    auto disc = mpm.make_body(
        law, [](const auto& at) { return at.norm() < 0.7; }, per_cell{2});
    mpm.step(bodies(disc), 1e-3);
    point<2, double> momentum(0, 0);
    for (const auto p : std::as_const(disc)) {
        momentum += p[m] * p[v];
        if (p[x].norm() < 0.3) CHECK((p[v] + 1e-3 * p[x]).norm() < 1e-9);
    }
    CHECK(momentum.norm() < 1e-17);
}

TEMPLATE_TEST_CASE("load: it is asked where particles are, not where they were", "", one_lane, native_lanes) {
    // 1/x is not a number at 0, where the first particle's cell begins, which it leaves.
    solver mpm{uniform_grid{{-4.}, {4.}, 1.}, linear{}, flip{}, TestType{},
               body_acceleration{[](const auto& at, const auto&, double) { return at.cwiseInverse().eval(); }}};
    auto two = mpm.make_body_at(law, {point<1, double>(0.95), point<1, double>(1.5)}, 0.5);
    for (auto p : two) p[v][0] = 1;
    for (int k = 0; k < 4; ++k) mpm.step(bodies(two), 0.1);
    for (const auto p : std::as_const(two)) CHECK(std::isfinite(p[v][0]));
}
