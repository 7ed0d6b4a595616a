// Bodies of several shapes that touch, by the contact's default: a disk and a sphere on a plane, and three blocks of
// which one lies across the joint of the others, so that nodes there belong to all three, on a floor that is a fourth
// body.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double h = 0.1, g = 10, settling = 0.4;

/// Gravity that grows slowly, under damping that ends at t = 0; from then on the grid is inclined.
template <class Point> auto gravity_of(double incline) {
    Point down = Point::Zero(), along = Point::Zero();
    down[Point::SizeAtCompileTime - 1] = -g * std::cos(incline);
    along[0] = g * std::sin(incline);
    return loads{body_acceleration{[=](const auto&, const auto&, double t) {
                     return t < 0 ? Point(down * std::min(1., 2 * (t / settling + 1))) : Point(down + along);
                 }},
                 grid_damping{[](double t) { return t < 0 ? 40. : 0.; }}};
}

/// A ball of 3.1 cells radius, somewhere between the nodes, slides down a plane that is inclined by 15 degrees.
template <int D, class Grid> void slides(const Grid& grid, double mu, double time) {
    using place = point<D, double>;
    const double incline = 0.2618, radius = 0.31;
    place centre = place::Constant(0.52);
    centre[D - 1] = 0.2 + radius;
    const fixed bed{[](const auto& at) { return at[D - 1] < 0.05; }};
    solver mpm{grid, fmpm<2>{}, gravity_of<place>(incline), bed, contact{coulomb{mu}}};
    const neo_hookean law{.young = 500, .poisson = 0.3, .density = 1};
    auto ball = mpm.make_body(
        law, [&](const auto& at) { return (at - centre).norm() < radius; }, per_cell{2});
    auto floor = mpm.make_body(
        law, [](const auto& at) { return at[D - 1] < 0.2; }, per_cell{2});
    integrate(mpm, bodies(floor, ball), {-settling, 0}, courant{0.3});
    const double weight = total_mass(ball) * g * std::cos(incline);
    place force = place::Zero();
    for (const auto& node : mpm.touching()) {
        force -= node.force;
        CHECK(node.normal[D - 1] > 0.95);
    }
    CHECK(std::abs(force[D - 1] / weight - 1) < 0.01);
    const place from = mean(ball, x), before = total_momentum(ball);
    double lift = 0;
    integrate(mpm, bodies(floor, ball), {0, time}, courant{0.3},
              [&](double) { lift = std::max(lift, (mean(ball, x) - from)[D - 1]); });
    const place gained = (total_momentum(ball) - before) / total_mass(ball);
    const double right = g * (std::sin(incline) - mu * std::cos(incline)) * time;
    CAPTURE(D, mu, gained[0] / right, lift / h);
    CHECK(std::abs(gained[0] / right - 1) < 0.03);
    CHECK(lift < 0.05 * h);
    if constexpr (D == 3) CHECK(std::abs(gained[1]) < 0.01 * right);
}

}  // namespace

TEST_CASE("contact bodies: a disk slides down a plane, and stands on it with its weight") {
    const uniform_grid grid{{0., 0.}, {1.6, 1.}, h};
    slides<2>(grid, 0, 0.3);
    slides<2>(grid, 0.05, 0.3);
}
TEST_CASE("contact bodies: so does a sphere, which is not led astray across") {
    slides<3>(uniform_grid{{0., 0., 0.}, {1.2, 1., 0.9}, h}, 0, 0.08);
}

TEST_CASE("contact bodies: a block lies across the joint of two others") {
    using place = point<2, double>;
    for (const double shift : {0., 0.03}) {
        solver mpm{uniform_grid{{0., 0.}, {2., 1.}, h}, fmpm<2>{}, gravity_of<place>(0),
                   fixed{[](const auto& at) { return at[1] < 0.05; }}, contact{coulomb{0.5}}};
        const linear_elastic law{.young = 1000, .poisson = 0.3, .density = 1};
        const auto block = [&](double from, double to, double bottom, double top) {
            std::vector<place> all;
            for (double X = from + h / 4; X < to; X += h / 2)
                for (double Y = bottom + h / 4; Y < top; Y += h / 2) all.push_back({X, Y});
            return mpm.make_body_at(law, all, h * h / 4);
        };
        auto floor = block(0, 2, 0, 0.2), left = block(0.6 + shift, 1 + shift, 0.2, 0.5);
        auto right = block(1 + shift, 1.4 + shift, 0.2, 0.5), top = block(0.8 + shift, 1.2 + shift, 0.5, 0.8);
        integrate(mpm, bodies(floor, left, right, top), {-settling, 0}, courant{0.3});
        std::map<std::array<double, 2>, std::set<int>> bodies_at;
        for (const auto& node : mpm.touching()) bodies_at[{node.at[0], node.at[1]}].insert({node.first, node.second});
        CHECK(
            std::any_of(bodies_at.begin(), bodies_at.end(), [](const auto& node) { return node.second.size() == 3; }));
        const std::array<place, 3> start{mean(left, x), mean(right, x), mean(top, x)};
        // What the floor and what the lower blocks push up with, in the mean over time.
        const double time = 0.2;
        double on_all = 0, on_top = 0, now = 0;
        integrate(mpm, bodies(floor, left, right, top), {0, time}, courant{0.3}, [&](double t) {
            for (const auto& node : mpm.touching()) {
                if (node.first == 0) on_all -= node.force[1] * (t - now);
                if (node.second == 3) on_top -= node.force[1] * (t - now);
            }
            now = t;
        });
        const double weight = total_mass(top) * g, all = weight + (total_mass(left) + total_mass(right)) * g;
        CHECK(std::abs(on_top / (time * weight) - 1) < 0.03);
        CHECK(std::abs(on_all / (time * all) - 1) < 0.03);
        CHECK((mean(left, x) - start[0]).norm() < 0.01 * h);
        CHECK((mean(right, x) - start[1]).norm() < 0.01 * h);
        CHECK((mean(top, x) - start[2]).norm() < 0.01 * h);
    }
}
