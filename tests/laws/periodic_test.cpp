// Grids that wrap: nothing tells where the wall is. A run from a state that is moved by whole cells is the same run,
// moved; a body that flies on comes back as it was.
#include <tamis/material/linear_elastic.hpp>
#include <tamis/observe/measure.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/run/integrate.hpp>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace tamis;
using std::numbers::pi;

namespace {

constexpr int cells = 12;

uniform_grid<1> ring() { return uniform_grid{{0.}, {1.}, 1. / cells}.wrapped(0); }
uniform_grid<2> torus() { return uniform_grid{{0., 0.}, {1., 1.}, 1. / cells}.wrapped(0).wrapped(1); }

/// Place from the lower corner, in the box: particles may be found up to half a cell beyond a periodic wall.
double in_box(double x) { return x - std::floor(x + 1e-9); }

struct beginning : vector_field {
    static constexpr std::string_view name = "beginning";
};

/// Particles' places and velocities after some steps, moved back by `shift` cells along each axis, in the order of
/// where they began.
template <int Dim, class... Policy> std::vector<std::array<double, 6>> run(const uniform_grid<Dim>& grid,
                                                                           const int (&shift)[Dim], double drift,
                                                                           const Policy&... policies) {
    solver mpm{grid, policies...};
    auto body = mpm.make_body(linear_elastic{.young = 1, .poisson = 0.2, .density = 1}, everywhere, per_cell{2},
                              fields<beginning>{});
    const auto original = [&](double x, int d) { return in_box(x - static_cast<double>(shift[d]) / cells); };
    set_velocity_of(body, [&](const auto& at) {
        point<Dim, double> v;
        for (int d = 0; d < Dim; ++d) {
            v[d] = drift;
            // Three modes, none symmetric about a node.
            for (int e = 0; e < Dim; ++e)
                for (int n = 1; n <= 3; ++n) v[d] += 0.02 / n * std::sin(2 * pi * n * original(at[e], e) + d + n);
        }
        return v;
    });
    for (auto p : body)
        for (int d = 0; d < Dim; ++d) p[beginning{}][d] = std::round(4 * cells * original(p[symbols::x][d], d));
    const auto momentum = total_momentum(body);
    integrate(mpm, bodies(body), {0, 2}, courant{0.2});
    CHECK((total_momentum(body) - momentum).norm() < 1e-13);
    CHECK(body.size() == static_cast<std::size_t>(std::pow(2 * cells, Dim)));
    std::vector<std::array<double, 6>> all;
    for (const auto p : std::as_const(body)) {
        std::array<double, 6> one{};
        for (int d = 0; d < Dim; ++d) {
            one[static_cast<std::size_t>(d)] = p[beginning{}][d];
            one[static_cast<std::size_t>(2 + d)] = original(p[symbols::x][d], d);
            one[static_cast<std::size_t>(4 + d)] = p[symbols::v][d];
        }
        all.push_back(one);
    }
    std::sort(all.begin(), all.end());
    return all;
}
template <int Dim, class... Policy>
void wall_is_nowhere(const uniform_grid<Dim>& grid, const int (&shift)[Dim], double drift, const Policy&... policies) {
    const int none[Dim] = {};
    const auto here = run(grid, none, drift, policies...), there = run(grid, shift, drift, policies...);
    REQUIRE(here.size() == there.size());
    double off = 0, speed = 0;
    for (std::size_t k = 0; k < here.size(); ++k)
        for (std::size_t c = 0; c < 6; ++c) {
            off = std::max(off, std::abs(here[k][c] - there[k][c]));
            speed = std::max(speed, std::abs(here[k][4]));
        }
    CHECK(off < 1e-10);
    CHECK(speed > 0.01);
}

}  // namespace

TEST_CASE("periodic grid: the wall is nowhere") {
    wall_is_nowhere(ring(), {5}, 0, linear{}, fmpm<dynamic>{3}, usl_minus{}, held{});
    wall_is_nowhere(ring(), {5}, 0.7, quadratic_spline{}, fmpm<dynamic>{3}, usavg_plus{});
    wall_is_nowhere(torus(), {5, 2}, 0, cubic_spline{}, flip{}, usf{}, held{});
    wall_is_nowhere(torus(), {5, 2}, 0, linear{}, fmpm<3>{}, usl_minus{}, held{});
    wall_is_nowhere(torus(), {5, 2}, 0.7, linear{}, fmpm<3>{}, usl_minus{});
}

TEST_CASE("periodic grid: a body that flies on is where it should be") {
    solver mpm{torus(), quadratic_spline{}, flip{}};
    auto body = mpm.make_body(
        linear_elastic{.young = 1, .density = 1},
        [](const auto& at) { return (at.array() - 0.5).matrix().norm() < 0.3; }, per_cell{2});
    set_velocity_of(body, [](const auto&) { return point<2, double>(1.3, -0.8); });
    std::vector<double> before, after;
    const auto look = [&](std::vector<double>& to, double t) {
        for (const auto p : std::as_const(body)) {
            to.push_back(in_box(p[symbols::x][0] - 1.3 * t) +
                         10 * std::floor(100 * in_box(p[symbols::x][1] + 0.8 * t)));
            CHECK(std::abs(p[symbols::v][0] - 1.3) < 1e-11);
            CHECK(std::abs(p[symbols::v][1] + 0.8) < 1e-11);
        }
        std::sort(to.begin(), to.end());
    };
    look(before, 0);
    integrate(mpm, bodies(body), {0, 3.1}, courant{0.4});
    look(after, 3.1);
    REQUIRE(before.size() == after.size());
    for (std::size_t k = 0; k < before.size(); ++k) CHECK(std::abs(before[k] - after[k]) < 1e-9);
}

TEST_CASE("periodic grid: what does not go with it is told") {
    const fixed ends{[](const auto& at) { return at[0] <= 0; }};
    CHECK_THROWS_AS((solver{ring(), ends}), error);
}
