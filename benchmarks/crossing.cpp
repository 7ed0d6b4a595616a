// What it costs when particles change cells: a 3D block that drifts to and fro, its particles anywhere in their cells;
// and the block at rest where it had drifted to, whose lanes are about as unevenly filled although nobody crosses. The
// occupancy printed at the end is the share of lanes that hold a particle: the least, mean and most of 60 steps. The
// step by hand is that of a block of as many cells whose particles stay where they are.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "block.hpp"
#include "by_hand_3d.hpp"
#include "ratios.hpp"

namespace {

using namespace tamis;
using namespace tamis::symbols;
using place = point<3, double>;

constexpr int cells = 32;
constexpr double h = 1. / 64;

template <class Solver, class Body> struct drifting {
    std::unique_ptr<Solver> mpm;
    std::unique_ptr<Body> body;
    double dt, speed;
    int done = 0;
    void step() {
        // Back and forth over a cell and a half, all particles alike.
        if (done++ % turn() == 0) {
            for (auto p : *body) p[v] = place::Constant(speed);
            speed = -speed;
        }
        mpm->step(bodies(*body), dt);
    }
    int turn() const { return speed == 0 ? 1 << 30 : static_cast<int>(1.5 * h / (std::abs(speed) * dt)); }
    std::size_t particles() const { return body->size(); }
};

/// `share`: of the particles that cross in a step. The start is disordered: each particle takes a random place in its
/// quarter of the cell.
auto block(double share) {
    auto mpm = std::make_unique<solver<uniform_grid<3, double>, quadratic_spline, flip, usl_minus>>(
        uniform_grid{{0., 0., 0.}, {1., 1., 1.}, h}, quadratic_spline{}, flip{}, usl_minus{});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-0.25, 0.25);
    std::vector<place> places;
    for (int k = 0; k < 2 * cells; ++k)
        for (int j = 0; j < 2 * cells; ++j)
            for (int i = 0; i < 2 * cells; ++i) {
                const place at(16 + 0.5 * (i + 0.5), 16 + 0.5 * (j + 0.5), 16 + 0.5 * (k + 0.5));
                places.push_back((at + place(any(random), any(random), any(random)) - place::Constant(0.5)) * h);
            }
    const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};
    using body_type = decltype(mpm->make_body_at(law, places, h * h * h / 8));
    auto body = std::make_unique<body_type>(mpm->make_body_at(law, places, h * h * h / 8));
    const double dt = 1e-4 * h;
    return drifting<std::decay_t<decltype(*mpm)>, body_type>{std::move(mpm), std::move(body), dt, share / 3 * h / dt};
}

using drifting_block = decltype(block(0));

/// Once the first tiles have made room.
auto settled(double share) {
    auto one = block(share);
    for (int n = 0; n < 20; ++n) one.step();
    return one;
}
/// Stopped 0.45 cells from where it began, where lanes are filled about as they are in the mean of the drift.
auto stopped() {
    auto one = settled(0.05);
    for (int n = 0; n < 7; ++n) one.step();
    one.speed = 0;
    one.done = 0;
    return one;
}

void tell(const char* name, drifting_block one) {
    double least = 1, sum = 0, most = 0;
    const std::size_t before = one.mpm->crossings();
    for (int n = 0; n < 60; ++n) {
        one.step();
        const double now = one.body->occupancy();
        least = std::min(least, now);
        most = std::max(most, now);
        sum += now;
    }
    std::printf("%s: occupancy %.2f to %.2f, mean %.2f, in 60 steps; %.2f %% of the particles crossed per step\n", name,
                least, most, sum / 60,
                100 * static_cast<double>(one.mpm->crossings() - before) / 60 / static_cast<double>(one.particles()));
}

}  // namespace

int main(int argc, char** argv) {
    ratio_run run;
    const std::string kept = "3D/quadratic/flip/crossing 0 %", stopped_at = kept + ", stopped";
    const std::string one = "3D/quadratic/flip/crossing 1 %", five = "3D/quadratic/flip/crossing 5 %";
    run.add(kept, "", [] { return settled(0); });
    run.add(stopped_at, kept, stopped);
    run.add(one, kept, [] { return settled(0.01); });
    run.add(five, kept, [] { return settled(0.05); });
    run.compare(one, stopped_at);
    run.compare(five, stopped_at);
    using hand = by_hand::block_3d<double, space<3, native_lanes::type<double>>::width>;
    const std::string by_hand_kept = "3D/by hand/quadratic/flip/crossing 0 %";
    run.add(by_hand_kept, "", [] { return hand_stepped<hand>{std::make_unique<hand>(cells)}; });
    run.compare(one, by_hand_kept);
    run.compare(five, by_hand_kept);
    const int status = run.run(argc, argv);
    tell("crossing 0 %", block(0));
    tell("crossing 0 %, stopped", stopped());
    tell("crossing 1 %", block(0.01));
    tell("crossing 5 %", block(0.05));
    return status;
}
