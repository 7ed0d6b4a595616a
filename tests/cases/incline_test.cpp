// An elastic block on an elastic slope, tan(theta) = 0.5, with Coulomb friction between the two, each in a velocity
// field of its own. Gravity grows slowly to its full value under strong damping; at t = 0 the damping ends, and a block
// that slides has the speed u. From then on, as a rigid block:
//
//     mu < tan(theta)    s(t) = u t + g (sin(theta) - mu cos(theta)) t^2/2,  friction heat mu m g cos(theta) s
//     else               it stays
//
// On a slope along the x axis, gravity being turned; and on one that is inclined in the grid. (Let go suddenly instead,
// the block rocks and hops, undamped: it then slides 3 % too far, and at mu > tan(theta) by a part of a cell.)
//
// Measured: way off by at most 0.1 %, speed 0.6 %, heat 1.4 %. A block that stays moves by less than 2e-8.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;

constexpr double g = 10, side = 0.1, length = 1, height = 0.5, settling = 1, run_time = 0.8;
const double theta = std::atan(0.5);

/// Where the slope runs: its unit vectors down along it and up from it, and a place on its surface where the block
/// starts.
struct slope {
    place along, up, start;
    place at(double s, double n) const { return start + s * along + n * up; }
    /// Particles of a box, at the middles of squares a particle's side wide, along the slope.
    std::vector<place> fill(double from, double to, double bottom, double top) const {
        std::vector<place> all;
        for (double s = from + side / 4; s < to; s += side / 2)
            for (double n = bottom + side / 4; n < top; n += side / 2) all.push_back(at(s, n));
        return all;
    }
};
const slope level{place(1, 0), place(0, 1), place(0.5, 0.4)};
const slope inclined{place(std::cos(theta), -std::sin(theta)), place(std::sin(theta), std::cos(theta)),
                     place(0.6, 1.53)};

struct slide {
    double start_speed, way, speed, heat;  // way and heat from t = 0 on
};

template <class Scheme> slide run(const slope& on, double mu, const Scheme& scheme) {
    const loads all{body_acceleration{[&](const auto&, const auto&, double t) {
                        const double share = std::min(1., 2 * (t / settling + 1));
                        return (share * g * (std::sin(theta) * on.along - std::cos(theta) * on.up)).eval();
                    }},
                    grid_damping{[](double t) { return t < 0 ? 40. : 0.; }}};
    const fixed bed{[&](const auto& at) { return (at - on.start).dot(on.up) < -0.25; }};
    solver mpm{uniform_grid{{0., 0.}, {2.6, 2.2}, side}, scheme, all, bed,
               contact{coulomb{mu}, given_normal{(-on.up).eval()}, by_approach{}}};
    const linear_elastic law{.young = 1e4, .poisson = 0.3, .density = 1};
    const double volume = side * side / 4;
    auto block = mpm.make_body_at(law, on.fill(0, length, 0, height), volume);
    auto ground = mpm.make_body_at(law, on.fill(-0.3, 1.9, -0.4, 0), volume);

    integrate(mpm, bodies(block, ground), {-settling, 0}, courant{0.4});
    const place from = mean(block, x);
    const double start_speed = mean(block, v).dot(on.along), before = mpm.friction_heat();
    integrate(mpm, bodies(block, ground), {0, run_time}, courant{0.4});
    return {start_speed, (mean(block, x) - from).dot(on.along), mean(block, v).dot(on.along),
            mpm.friction_heat() - before};
}

template <class Scheme> void slides(const slope& on, const Scheme& scheme) {
    const double mu = 0.3, acceleration = g * (std::sin(theta) - mu * std::cos(theta));
    const slide found = run(on, mu, scheme);
    const double way = (found.way - found.start_speed * run_time) / (acceleration * run_time * run_time / 2);
    const double speed = (found.speed - found.start_speed) / (acceleration * run_time);
    const double heat = found.heat / (mu * length * height * g * std::cos(theta) * found.way);
    CAPTURE(way, speed, heat);
    CHECK(std::abs(way - 1) < 0.003);
    CHECK(std::abs(speed - 1) < 0.01);
    CHECK(std::abs(heat - 1) < 0.02);
}
template <class Scheme> void stays(const slope& on, const Scheme& scheme) {
    const slide found = run(on, 0.6, scheme);
    CAPTURE(found.way, found.speed, found.heat);
    CHECK(std::abs(found.way) < 1e-4 * side);
}

}  // namespace

TEST_CASE("incline: a block slides as a rigid one where friction is too small, and friction takes its work") {
    slides(level, flip{});
    slides(level, fmpm<2>{});
    slides(level, fmpm<4>{});
}
TEST_CASE("incline: so it does on a slope inclined in the grid") {
    slides(inclined, flip{});
    slides(inclined, fmpm<2>{});
    slides(inclined, fmpm<4>{});
}
TEST_CASE("incline: a block stays where friction is enough") {
    for (const slope& on : {level, inclined}) {
        stays(on, flip{});
        stays(on, fmpm<2>{});
        stays(on, fmpm<4>{});
    }
}
