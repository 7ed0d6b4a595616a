// Held planes stop particles as well as nodes, in every order and update, and what that takes is counted in the
// reaction. What leaves through a side that nothing holds is another matter.
#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "unit/complaint.hpp"

#include <cmath>

using namespace tamis;
using namespace tamis::symbols;

namespace {

using vec = point<2, double>;

/// No stress: particles fly as they are updated.
struct dust {
    double density = 1;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto) const { return L * 0; }
};

const auto sides = slip{[](const auto& at) { return at[0] <= 0 || at[0] >= 2; }, vec(1, 0)};
const auto ends = slip{[](const auto& at) { return at[1] <= 0 || at[1] >= 1; }, vec(0, 1)};

/// Grains that fly at the walls of a closed box: none is lost, none beyond, and momentum changes by reactions only.
template <class... Policies> void fly_in_a_box(const Policies&... policies) {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.125}, conditions{sides, ends}, policies...};
    std::vector<vec> places;
    for (int k = 0; k < 40; ++k)
        places.push_back(vec(0.03 + std::fmod(0.377 * k, 1.94), 0.02 + std::fmod(0.211 * k, 0.96)));
    auto grains = mpm.make_body_at(dust{}, places, 0.01);
    int k = 0;
    for (auto p : grains) {
        const double angle = 0.7 * ++k;
        p[v] = vec(std::cos(angle), std::sin(angle));
    }
    const double dt = 0.9 * 0.125 / 3;  // less than a cell a step, also for what has become faster
    for (int step = 0; step < 60; ++step) {
        const vec before = total_momentum(grains);
        mpm.step(bodies(grains), dt);
        vec impulse = vec::Zero();
        for (const auto& node : mpm.reactions()) impulse += node.reaction * dt;
        const vec change = total_momentum(grains) - before - impulse;
        CAPTURE(step);
        REQUIRE(change.norm() < 1e-14);
        std::size_t seen = 0;
        for (const auto p : std::as_const(grains)) {
            ++seen;
            REQUIRE((p[x][0] >= 0 && p[x][0] <= 2 && p[x][1] >= 0 && p[x][1] <= 1));
        }
        REQUIRE(seen == places.size());
    }
}

/// A grain that is faster than its nodes: FMPM moves it by its own velocity too.
template <class... Policies>
auto thrown_at(const vec& from, const vec& speed, int steps, double dt, const Policies&... policies) {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.25}, policies...};
    auto grain = mpm.make_body_at(dust{}, {from}, 0.01);
    for (auto p : grain) p[v] = speed;
    struct {
        vec at, v, reaction;
        std::string complaint;
    } end{vec::Zero(), speed, vec::Zero(), {}};
    end.complaint = complaint([&] {
        for (int k = 0; k < steps; ++k) {
            mpm.step(bodies(grain), dt);
            for (const auto& node : mpm.reactions()) end.reaction += node.reaction * dt;
        }
    });
    for (const auto p : std::as_const(grain)) {
        end.at = p[x];
        end.v = p[v];
    }
    return end;
}

}  // namespace

TEST_CASE("walls: a closed box holds every particle, whatever composes the step") {
    fly_in_a_box(linear{}, flip{});
    fly_in_a_box(quadratic_spline{}, flip{}, usavg_minus{});
    fly_in_a_box(quadratic_spline{}, fmpm<2>{}, usl_plus{});
    fly_in_a_box(cubic_spline{}, xpic<3>{}, usf{});
    fly_in_a_box(ugimp{1}, pic{}, leaving_removes{});
    fly_in_a_box(linear{}, graphics_blend{0.99}, leaving_clamps{}, one_lane{});
}

TEST_CASE("walls: a particle that jumps over cells is stopped at the side of the grid too") {
    const auto end =
        thrown_at(vec(0.9, 0.4), vec(-7, 0.1), 1, 0.25, linear{}, flip{}, conditions{sides, ends}, leaving_removes{});
    CAPTURE(end.complaint, end.at);
    CHECK(end.complaint == "nothing");
    CHECK(end.at[0] > 0);
    CHECK(end.at[0] < 1e-5);
    CHECK(std::abs(end.v[0]) < 1e-12);
    CHECK(std::abs(end.v[1] - 0.1) < 1e-12);
    // Node and wall together took the momentum.
    CHECK(std::abs(end.reaction[0] - 0.07) < 1e-14);
}

TEST_CASE("walls: a held plane inside of the grid stops particles from both sides") {
    const auto plane = slip{[](const auto& at) { return std::abs(at[0] - 1) < 1e-9; }, vec(1, 0)};
    const auto check = [&](const auto&... policies) {
        for (const double side : {-1., 1.}) {
            const auto end = thrown_at(vec(1 + 0.21 * side, 0.4), vec(-side, 0.02), 6, 0.15, plane, policies...);
            CAPTURE(side, end.at, end.complaint);
            CHECK(end.complaint == "nothing");
            CHECK((end.at[0] - 1) * side > 0);
            CHECK(std::abs(end.reaction[0] + end.v[0] * -0.01 - side * 0.01) < 1e-14);
        }
    };
    check(linear{}, fmpm<2>{});
    check(quadratic_spline{}, fmpm<3>{});
    check(quadratic_spline{}, graphics_blend{1.});
    check(cubic_spline{}, graphics_blend{1.}, usl_plus{});
}

TEST_CASE("walls: one that moves stops what it meets, and lets go what goes its way") {
    const auto piston = [](double speed) {
        return prescribed{[](const auto& at) { return at[0] <= 0; },
                          [speed](const auto&, double) { return vec(speed, 0); }, vec(1, 0)};
    };
    const auto met = thrown_at(vec(0.2, 0.4), vec(-1, 0), 6, 0.1, linear{}, graphics_blend{1.}, piston(0.5));
    CHECK(met.complaint == "nothing");
    CHECK(met.v[0] > 0);
    const auto pulled = thrown_at(vec(0.2, 0.4), vec(-1, 0), 6, 0.1, linear{}, graphics_blend{1.}, piston(-0.5));
    CAPTURE(pulled.complaint);
    CHECK(names(pulled.complaint, "left the grid", "side x = 0", "moves the side outwards"));
}

TEST_CASE("walls: the message names the side, and why nothing stopped the particle") {
    const auto floor = slip{[](const auto& at) { return at[1] <= 0; }, vec(0, 1)};
    const auto open = thrown_at(vec(1.9, 0.4), vec(1, 0), 3, 0.1, floor);
    CAPTURE(open.complaint);
    CHECK(names(open.complaint, "side x = 2", "no condition keeps the body from that side"));
    const auto along = slip{[](const auto& at) { return at[0] >= 2; }, vec(0, 1)};
    const auto across = thrown_at(vec(1.9, 0.4), vec(1, 0), 3, 0.1, along);
    CAPTURE(across.complaint);
    CHECK(names(across.complaint, "side x = 2", "does not hold the side across"));
}

TEST_CASE("walls: a bar that is pulled through held nodes goes on") {
    const auto grip =
        prescribed{[](const auto& at) { return at[0] >= 1.25; }, [](const auto&, double) { return vec(0.3, 0); }};
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.125}, grip, fmpm<2>{}};
    auto bar = mpm.make_body(
        dust{}, [](const auto& at) { return at[0] < 1.5 && at[1] < 0.25; }, per_cell{2});
    double before = 0;
    for (const auto p : std::as_const(bar)) before = std::max(before, p[x][0]);
    for (int k = 0; k < 40; ++k) mpm.step(bodies(bar), 0.025);
    double after = 0;
    for (const auto p : std::as_const(bar)) after = std::max(after, p[x][0]);
    CHECK(std::abs(after - before - 0.3) < 0.01);
}

#if defined(_OPENMP)
TEST_CASE("walls: threads change no bit of what is stopped") {
    const auto run = [](auto execution) {
        solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 1. / 32}, conditions{sides, ends}, graphics_blend{1.}, execution};
        auto body = mpm.make_body(dust{}, everywhere, per_cell{2}, fields<field::id>{});
        for (auto p : body) p[v] = vec(std::sin(9 * p[x][1]), std::cos(7 * p[x][0]));
        std::vector<double> all;
        for (int k = 0; k < 20; ++k) mpm.step(bodies(body), 0.008);
        for (const auto& node : mpm.reactions()) all.insert(all.end(), {node.reaction[0], node.reaction[1]});
        for (const auto p : std::as_const(body)) all.insert(all.end(), {p[field::id{}], p[x][0], p[v][1]});
        return all;
    };
    CHECK(run(serial{}) == run(threads{2}));
}
#endif

TEST_CASE("walls: they stop particles in 1D too, where sums are made ahead") {
    const auto both_ends = fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 4; }};
    const auto run = [&](auto... policies) {
        solver mpm{uniform_grid{{0.}, {4.}, 0.125}, both_ends, policies...};
        auto grains = mpm.make_body(dust{}, everywhere, per_cell{2});
        for (auto p : grains) p[v][0] = p[x][0] < 2 ? -0.3 : 1 + 0.1 * std::sin(40 * p[x][0]);
        const std::size_t count = grains.size();
        const double dt = 0.05;
        for (int k = 0; k < 80; ++k) {
            const double before = total_momentum(grains)[0];
            mpm.step(bodies(grains), dt);
            double impulse = 0;
            for (const auto& node : mpm.reactions()) impulse += node.reaction[0] * dt;
            REQUIRE(std::abs(total_momentum(grains)[0] - before - impulse) < 1e-13);
            std::size_t seen = 0;
            for (const auto p : std::as_const(grains)) {
                ++seen;
                REQUIRE((p[x][0] >= 0 && p[x][0] <= 4));
            }
            REQUIRE(seen == count);
        }
    };
    run(linear{}, graphics_blend{1.});
    run(quadratic_spline{}, graphics_blend{1.});
    run(linear{}, graphics_blend{1.}, one_lane{});
}

TEST_CASE("walls: water that splashes in a closed box stays there with USL+, and gains next to no energy") {
    constexpr double g = 9.81;
    const slip left_and_right{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }, vec(1, 0)};
    const slip below_and_above{[](const auto& at) { return at[1] <= 0 || at[1] >= 1; }, vec(0, 1)};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 1. / 16}, usl_plus{}, conditions{left_and_right, below_and_above},
               gravity{vec(0, -g)}};
    auto water = mpm.make_body(
        tait{.bulk = 1e5, .exponent = 7, .density = 1000}, [](const auto& at) { return at[0] < 0.25 && at[1] < 0.5; },
        per_cell{2});
    const std::size_t count = water.size();
    const auto energy = [&] {
        return g * total_mass(water) * mean(water, x)[1] + kinetic_energy(water) + elastic_energy(water);
    };
    const double before = energy();
    integrate(mpm, bodies(water), {0, 1}, courant{}, [&](double t) {
        CAPTURE(t, energy() / before);
        REQUIRE(energy() < 1.03 * before);  // 1.019 on this coarse grid
    });
    std::size_t inside = 0;
    for (const auto p : std::as_const(water)) inside += p[x].minCoeff() >= 0 && p[x].maxCoeff() <= 1 ? 1 : 0;
    CHECK(inside == count);
}
