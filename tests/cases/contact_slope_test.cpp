// An elastic block on an elastic slope, with the contact's default, which is told nothing of where the surface is:
// against a rigid block's way, where it slides s = g (sin(a) - mu cos(a)) t^2/2 from rest on, and against none, where
// it stays. On a slope along the x axis, gravity being turned, and on one turned against the grid, of rows of particles
// along it. Gravity grows slowly under damping, which ends at t = 0 (let go suddenly, an elastic block rocks).
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;
constexpr double g = 10, side = 0.1, length = 0.5, height = 0.3, settling = 0.4, run_time = 0.4;

/// Where the slope runs: its unit vectors down along it and up from it, and a place on its surface where the block
/// starts.
struct slope {
    place along, up, start;
    std::vector<place> fill(double from, double to, double bottom, double top) const {
        std::vector<place> all;
        for (double s = from + side / 4; s < to; s += side / 2)
            for (double n = bottom + side / 4; n < top; n += side / 2) all.push_back(start + s * along + n * up);
        return all;
    }
};
struct slide {
    double way, lift,
        heat;  // from t = 0 on, without what the start's speed adds; the largest lift; over that of theory
};

slide run(const slope& on, const place& pull, double mu) {
    const loads all{body_acceleration{[&](const auto&, const auto&, double t) {
                        return (std::min(1., 2 * (t / settling + 1)) * g * pull).eval();
                    }},
                    grid_damping{[](double t) { return t < 0 ? 40. : 0.; }}};
    const fixed bed{[&](const auto& at) { return (at - on.start).dot(on.up) < -0.15; }};
    // Damping leaves the shortest waves to USL+.
    solver mpm{uniform_grid{{0., 0.}, {2.6, 1.8}, side}, fmpm<2>{}, usl_minus{}, all, bed, contact{coulomb{mu}}};
    const linear_elastic law{.young = 500, .poisson = 0.3, .density = 1};
    auto block = mpm.make_body_at(law, on.fill(0, length, 0, height), side * side / 4);
    auto ground = mpm.make_body_at(law, on.fill(-0.3, 1.5, -0.3, 0), side * side / 4);
    integrate(mpm, bodies(block, ground), {-settling, 0}, courant{0.3});
    const place from = mean(block, x);
    const double speed = mean(block, v).dot(on.along), heat = mpm.friction_heat();
    slide found{0, 0, 0};
    integrate(mpm, bodies(block, ground), {0, run_time}, courant{0.3},
              [&](double) { found.lift = std::max(found.lift, (mean(block, x) - from).dot(on.up)); });
    const double way = (mean(block, x) - from).dot(on.along), pressed = -total_mass(block) * g * pull.dot(on.up);
    found.way = way - speed * run_time;
    found.heat = (mpm.friction_heat() - heat) / (mu * pressed * way);
    return found;
}

void is_right(double degrees, double mu) {
    const double a = degrees * std::numbers::pi / 180, free_way = g * std::sin(a) * run_time * run_time / 2;
    const place down(std::cos(a), -std::sin(a)), up(std::sin(a), std::cos(a));
    const slope level{place(1, 0), place(0, 1), place(0.45, 0.5)}, turned{down, up, place(0.45, 0.55 + std::sin(a))};
    for (const bool along_grid : {true, false}) {
        const slide found =
            along_grid ? run(level, place(std::sin(a), -std::cos(a)), mu) : run(turned, place(0, -1), mu);
        const double right = std::max(0., std::sin(a) - mu * std::cos(a)) / std::sin(a) * free_way;
        CAPTURE(degrees, mu, along_grid, found.way / free_way, right / free_way, found.lift / side);
        CHECK(found.lift < 0.05 * side);
        if (right > 0) {
            CHECK(std::abs(found.way / right - 1) < 0.03);
            // Where it hardly slides, friction's heat is mostly that of a surface which trembles.
            if (mu > 0 && right > 0.3 * free_way) CHECK(std::abs(found.heat - 1) < 0.05);
        } else
            CHECK(std::abs(found.way) < 1e-3 * free_way);
    }
}

}  // namespace

TEST_CASE("contact slope: 15 degrees") {
    for (const double mu : {0., 0.1, 0.3, 0.8}) is_right(15, mu);
}
TEST_CASE("contact slope: 30 degrees") {
    for (const double mu : {0., 0.1, 0.3, 0.8}) is_right(30, mu);
}
TEST_CASE("contact slope: 45 degrees") {
    for (const double mu : {0., 0.1, 0.3, 0.8}) is_right(45, mu);
}
