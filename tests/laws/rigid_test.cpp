// Rigid motion strains nothing, wherever particles are: on nodes, edges, corners, walls, and alone.
#include <tamis/tamis.hpp>

#include "catch.hpp"

#include <cmath>
#include <vector>

using namespace tamis;
using namespace tamis::symbols;

namespace {

using vec = point<2, double>;
const neo_hookean law{.young = 1000, .poisson = 0.3, .density = 1};

/// Particles on nodes, on edges and alone, in free flight; the largest stress and change of velocity.
template <class... Policies> double strained(const Policies&... policies) {
    solver mpm{uniform_grid{{0., 0.}, {16., 12.}, 1.}, policies...};
    std::vector<vec> block;
    for (int i = 1; i <= 3; ++i)
        for (int j = 1; j <= 2; ++j) block.push_back(vec(i, j));
    auto on_nodes = mpm.make_body_at(law, block, 1.);
    // So far from each other that no node sees two of them.
    const std::vector<vec> places{vec(8, 4), vec(8.3, 7), vec(0, 12), vec(7.4, 12)},
        speeds{vec(1, -0.5), vec(1, 0), vec(1, -1), vec(0, -1)};
    auto alone = mpm.make_body_at(law, places, 1., fields<field::id>{});
    for (auto p : on_nodes) p[v] = vec(1, 0);
    for (auto p : alone) p[v] = speeds[static_cast<std::size_t>(p[field::id{}])];
    double worst = 0;
    for (int k = 0; k < 2 * 256; ++k) {  // every 256th step on an edge again
        mpm.step(bodies(on_nodes, alone), 1. / 256);
        const auto look = [&](const auto& p, const vec& speed) {
            const matrix<2, double> tau = p[sigma];
            worst = std::max({worst, tau.cwiseAbs().maxCoeff(), (p[v] - speed).norm()});
        };
        for (const auto p : std::as_const(on_nodes)) look(p, vec(1, 0));
        for (const auto p : std::as_const(alone)) look(p, speeds[static_cast<std::size_t>(p[field::id{}])]);
    }
    return worst;
}

/// Particles on nodes, two side by side and a lone one, fly by two cells.
template <class... Policies> void fly_in_1d(const Policies&... policies) {
    solver mpm{uniform_grid{{0.}, {8.}, 1.}, linear{}, policies...};
    const std::vector<point<1, double>> places{point<1, double>(2), point<1, double>(3), point<1, double>(5.25)};
    auto bar = mpm.make_body_at(law, places, 1., fields<field::id>{});
    for (auto p : bar) p[v][0] = 1;
    for (int k = 0; k < 512; ++k) mpm.step(bodies(bar), 1. / 256);
    for (const auto p : std::as_const(bar)) {
        CHECK(std::abs(p[sigma](0, 0)) < 1e-9);
        CHECK(std::abs(p[v][0] - 1) < 1e-12);
        CHECK(std::abs(p[x][0] - places[static_cast<std::size_t>(p[field::id{}])][0] - 2) < 1e-12);
    }
}

}  // namespace

TEST_CASE("rigid motion strains nothing: particles on nodes, edges and walls, and alone") {
    CHECK(strained(linear{}, flip{}) < 1e-9);
    CHECK(strained(linear{}, fmpm<2>{}, usl_plus{}) < 1e-9);
    CHECK(strained(linear{}, apic{}, usf{}, one_lane{}) < 1e-9);
    CHECK(strained(quadratic_spline{}, flip{}) < 1e-9);
    CHECK(strained(cubic_spline{}, fmpm<2>{}, usf{}) < 1e-9);
    CHECK(strained(cpgimp{1}, flip{}) < 1e-9);
#if defined(_OPENMP)
    CHECK(strained(linear{}, flip{}, threads{2}) < 1e-9);
#endif
}

TEST_CASE("rigid motion strains nothing in 1D and 3D, and where particles are held") {
    fly_in_1d(flip{});
    // Where sums are not made ahead, fields take each other's columns.
    fly_in_1d(flip{}, one_lane{});
    fly_in_1d(flip{}, gravity{point<1, double>(0.)});
    fly_in_1d(flip{}, usavg_minus{}, one_lane{});
    fly_in_1d(pic{}, one_lane{});
    fly_in_1d(tpic{}, usf{});
    fly_in_1d(xpic<2>{}, usl_plus{});
    {
        using vec3 = point<3, double>;
        solver mpm{uniform_grid{{0., 0., 0.}, {6., 6., 6.}, 1.}, linear{}};
        auto body = mpm.make_body_at(
            law, {vec3(2, 2, 2), vec3(3, 2, 2), vec3(2, 3.5, 4), vec3(4.25, 4, 3), vec3(4.5, 1.5, 3)}, 1.);
        for (auto p : body) p[v] = vec3(1, 0.5, -0.25);
        for (int k = 0; k < 256; ++k) mpm.step(bodies(body), 1. / 256);
        for (const auto p : std::as_const(body)) {
            const matrix<3, double> tau = p[sigma];
            CHECK(tau.cwiseAbs().maxCoeff() < 1e-9);
        }
    }
    {
        solver mpm{uniform_grid{{0., 0.}, {6., 6.}, 1.}, linear{}, held{}};
        auto body = mpm.make_body_at(law, {vec(2, 2), vec(3, 2), vec(4.5, 4)}, 1.);
        for (auto p : body) p[v] = vec(1, 0.5);
        for (int k = 0; k < 8; ++k) mpm.step(bodies(body), 1. / 64);
        for (const auto p : std::as_const(body)) {
            const matrix<2, double> tau = p[sigma];
            CHECK(tau.cwiseAbs().maxCoeff() < 1e-9);
        }
    }
}

TEST_CASE("a block of particles on nodes that turns is strained no more than where they are in cells") {
    // With affine velocities nodes have those of the turn exactly.
    for (const double offset : {0., 0.5}) {
        solver mpm{uniform_grid{{0., 0.}, {8., 8.}, 1.}, linear{}, apic{}, usf{}};
        std::vector<vec> places;
        for (int i = 2; i <= 5; ++i)
            for (int j = 2; j <= 5; ++j) places.push_back(vec(i + offset, j + offset));
        auto block = mpm.make_body_at(law, places, 1.);
        for (auto p : block) {
            p[v] = vec(-p[x][1], p[x][0]);
            p[C] = matrix<2, double>{{0, -1}, {1, 0}};
        }
        mpm.step(bodies(block), 1e-6);
        for (const auto p : std::as_const(block)) {
            const matrix<2, double> tau = p[sigma];
            CAPTURE(offset, p[x][0], p[x][1]);
            CHECK(tau.cwiseAbs().maxCoeff() < 1000 * 1e-11);
        }
    }
}
