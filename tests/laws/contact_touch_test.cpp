// When bodies touch, in which direction, and what a run says of a normal that is turned round.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;
constexpr double h = 0.1;
const neo_hookean rubber{.young = 1000, .poisson = 0.3, .density = 1};

/// A body of rows of particles, four a cell, turned by an angle about its middle.
std::vector<place> block(const place& middle, double half_width, double half_height, double turn) {
    const place along(std::cos(turn), std::sin(turn)), up(-along[1], along[0]);
    std::vector<place> all;
    for (double s = -half_width + h / 4; s < half_width; s += h / 2)
        for (double n = -half_height + h / 4; n < half_height; n += h / 2) all.push_back(middle + s * along + n * up);
    return all;
}

/// Two blocks fly at each other, turned: how far they are from each other, in cells, when either is first pushed.
template <class Shape, class... Policies>
double gap_at_first_push(double turn, const Shape& shape, const Policies&... policies) {
    const place along(std::cos(turn), std::sin(turn)), middle(1.03, 0.98);
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, h}, shape, flip{}, policies...};
    auto one = mpm.make_body_at(rubber, block(middle - 0.23 * along, 0.2, 0.3, turn), h * h / 4);
    auto two = mpm.make_body_at(rubber, block(middle + 0.23 * along, 0.2, 0.2, turn), h * h / 4);
    set_velocity_of(one, [&](const auto&) { return place(along); });
    set_velocity_of(two, [&](const auto&) { return place(-along); });
    for (int k = 0; k < 1000; ++k) {
        mpm.step(bodies(one, two), 2e-4);
        if (mpm.touching().empty()) continue;
        for (const auto& node : mpm.touching()) CHECK((node.normal - along).norm() < 0.05);
        return ((mean(two, x) - mean(one, x)).dot(along) - 0.4) / h;
    }
    return -1;
}

/// Two blocks that fly at each other along x, with a given normal; `turned`: named the other way round.
template <class... Detection> std::string meet(bool turned, const Detection&... detection) {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, h}, contact{frictionless{}, given_normal{place(1, 0)}, detection...}};
    auto one = mpm.make_body_at(rubber, block({0.6, 0.5}, 0.2, 0.2, 0), h * h / 4);
    auto two = mpm.make_body_at(rubber, block({1.25, 0.5}, 0.2, 0.2, 0), h * h / 4);
    set_velocity_of(one, [](const auto&) { return place(1, 0); });
    const auto run = [&](auto all) {
        for (int k = 0; k < 300; ++k) mpm.step(all, 1e-3);
    };
    return complaint([&] {
        if (turned)
            run(bodies(two, one));
        else
            run(bodies(one, two));
        CHECK(mean(one, v)[0] < 0.3);
        CHECK(mean(two, v)[0] > 0.7);
    });
}

}  // namespace

TEST_CASE("contact: bodies touch when they touch, by every shape, turned against the grid or not") {
    const contact touch{frictionless{}, normal_by_regression{}, by_extents{}};
    for (const double turn : {0., 0.26, 0.79}) {
        CAPTURE(turn);
        CHECK(std::abs(gap_at_first_push(turn, quadratic_spline{}, touch)) < 0.1);
        CHECK(std::abs(gap_at_first_push(turn, linear{}, touch)) < 0.1);
        CHECK(std::abs(gap_at_first_push(turn, cubic_spline{}, touch)) < 0.1);
    }
}

TEST_CASE("contact: a given normal that is turned round is refused when the bodies meet") {
    CHECK(meet(false) == "nothing");
    CHECK(meet(false, by_approach{}) == "nothing");
    for (const std::string& told : {meet(true), meet(true, by_approach{}), meet(true, by_extents{})}) {
        CAPTURE(told);
        CHECK(names(told, "contact: where body 0 and body 1", "from body 1 to body 0", "name body 1 before body 0"));
    }
}

TEST_CASE("contact: a pair that is refused is refused again, and so is one that met before, from the other side") {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, h}, contact{frictionless{}, given_normal{place(1, 0)}}};
    auto one = mpm.make_body_at(rubber, block({0.6, 0.5}, 0.2, 0.2, 0), h * h / 4);
    auto two = mpm.make_body_at(rubber, block({1.05, 0.5}, 0.2, 0.2, 0), h * h / 4);
    const auto refused = [&] { return complaint([&] { mpm.step(bodies(one, two), 1e-4); }) != "nothing"; };
    CHECK_FALSE(refused());
    auto far = mpm.make_body_at(rubber, block({1.65, 0.5}, 0.2, 0.2, 0), h * h / 4);
    mpm.step(bodies(far, two), 1e-4);  // apart
    auto other = mpm.make_body_at(rubber, block({0.6, 0.5}, 0.2, 0.2, 0), h * h / 4);
    for (int k = 0; k < 2; ++k) CHECK(complaint([&] { mpm.step(bodies(two, other), 1e-4); }) != "nothing");
}

TEST_CASE("contact: bodies beside each other are on no side of a given normal, and slide past") {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, h}, contact{frictionless{}, given_normal{place(1, 0)}}};
    auto one = mpm.make_body_at(rubber, block({0.8, 0.7}, 0.2, 0.2, 0), h * h / 4);
    auto two = mpm.make_body_at(rubber, block({0.82, 0.2}, 0.2, 0.2, 0), h * h / 4);
    mpm.step(bodies(one, two), 1e-4);
    mpm.step(bodies(two, one), 1e-4);
}

TEST_CASE("contact: threads change no bit of it") {
    const auto run = [](const auto& execution) {
        solver mpm{uniform_grid{{0., 0.}, {2., 2.}, h}, fmpm<2>{}, execution,
                   contact{coulomb{0.3}, normal_by_regression{}, by_extents{}}};
        auto one = mpm.make_body_at(rubber, block({0.7, 1}, 0.3, 0.3, 0.3), h * h / 4);
        auto two = mpm.make_body_at(rubber, block({1.3, 1.05}, 0.25, 0.3, 0.1), h * h / 4);
        set_velocity_of(one, [](const auto&) { return place(2, 0.5); });
        for (int k = 0; k < 60; ++k) mpm.step(bodies(one, two), 1e-3);
        CHECK(mpm.friction_heat() > 0);
        std::vector<double> all;
        for (const auto p : std::as_const(one)) all.insert(all.end(), {p[x][0], p[x][1], p[v][0], p[v][1]});
        all.push_back(mpm.friction_heat());
        return all;
    };
    const auto right = run(serial{});
#if defined(_OPENMP)
    for (const int count : {1, 2, 3}) CHECK(run(threads{count}) == right);
#endif
}
