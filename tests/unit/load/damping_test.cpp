#include <tamis/tamis.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 2};
using place = point<2, double>;

/// A body in flight, without any stress at first.
template <class... Policy> auto flight(int steps, const Policy&... policy) {
    solver mpm{uniform_grid{{0., 0.}, {3., 2.}, 0.25}, quadratic_spline{}, policy...};
    auto disc = mpm.make_body(
        law, [](const auto& at) { return (at - place(1.5, 1)).norm() < 0.6; }, per_cell{2});
    for (auto p : disc) p[v] << 0.5, 0.25;
    for (int k = 0; k < steps; ++k) mpm.step(bodies(disc), 0.125);
    return mean(disc, v);
}

}  // namespace

TEMPLATE_TEST_CASE("damping: a flight slows by alpha dt in every step, in every order", "", usf, usl_minus, usl_plus,
                   usavg_minus, euler) {
    const place start(0.5, 0.25), slower = start * std::pow(1 - 0.125 * 0.8, 3);
    CHECK((flight(3, grid_damping{0.8}, TestType{}) - slower).norm() < 1e-14);
    CHECK((flight(3, particle_damping{0.8}, TestType{}) - slower).norm() < 1e-14);
    CHECK((flight(3, fmpm<2>{}, grid_damping{0.8}, TestType{}) - slower).norm() < 1e-14);
    CHECK((flight(3, grid_damping{0.8}, held{}, TestType{}) - slower).norm() < 1e-14);
    CHECK((flight(3, loads{grid_damping{0.5}, particle_damping{0.2}, grid_damping{0.1}}, TestType{}) - slower).norm() <
          1e-14);
}

TEST_CASE("damping: a rate may depend on time") {
    const auto alpha = [](double t) { return t < 0.2 ? 0. : 2.; };
    const place start(0.5, 0.25);
    CHECK((flight(3, grid_damping{alpha}) - start * 0.75).norm() < 1e-14);
    CHECK((flight(3, particle_damping{alpha}) - start * 0.75).norm() < 1e-14);
}

TEST_CASE("damping: rates that make no sense are named") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    CHECK(complaint([] { grid_damping{-1.}; }) == "grid_damping: alpha is -1; give 0 or a positive, finite rate");
    CHECK(complaint([] { particle_damping{-2}; }) ==
          "particle_damping: alpha is -2; give 0 or a positive, finite rate");
    CHECK(names(complaint([&] { grid_damping{none}; }), "alpha is nan"));
    CHECK(names(complaint([] { flight(2, grid_damping{[](double t) { return 1 - 16 * t; }}); }), "grid_damping",
                "alpha is -1 at t = 0.125"));
    CHECK(names(complaint([&] { flight(1, particle_damping{[=](double) { return none; }}); }), "particle_damping"));
    CHECK(names(complaint([] { flight(1, grid_damping{10.}); }), "alpha is 10", "take steps of at most 1/alpha = 0.1"));
}

TEST_CASE("kinetic feedback: alpha follows the kinetic energy, step by step") {
    for (const bool later : {false, true}) {
        CAPTURE(later);
        const double target = 0.5, gain = 4, dt = 0.125;
        const auto run = [&](auto order, auto motion) {
            solver mpm{uniform_grid{{0., 0.}, {3., 2.}, 0.25}, order, motion, kinetic_feedback{target, gain, 0.9, 0.1}};
            auto disc = mpm.make_body(
                law, [](const auto& at) { return (at - place(1.5, 1)).norm() < 0.6; }, per_cell{2});
            for (auto p : disc) p[v] << 2, 1;
            double alpha = 0.1;
            for (int k = 0; k < 40; ++k) {
                CAPTURE(k);
                const double speed = 2 * kinetic_energy(disc) / total_mass(disc);
                const double next = alpha + dt * gain * (speed - 2 * target / total_mass(disc));
                alpha = std::min(0.9, std::max(0., next));
                mpm.step(bodies(disc), dt);
                REQUIRE(std::abs(mpm.load().alpha() - alpha) < 1e-13);
            }
            if (later) {
                mpm.start_at(100);
                CHECK(mpm.load().alpha() == 0.1);
            }
        };
        run(usl_minus{}, held{});
        run(usf{}, held{});
    }
}

TEST_CASE("kinetic feedback: parameters that make no sense are named") {
    const double none = std::numeric_limits<double>::quiet_NaN();
    CHECK(names(complaint([] { kinetic_feedback{-1, 1, 1}; }), "kinetic_feedback: the target is -1 J"));
    CHECK(names(complaint([] { kinetic_feedback{1, 0, 1}; }), "the gain is 0"));
    CHECK(names(complaint([&] { kinetic_feedback{1, 1, none}; }), "the maximum of alpha is nan"));
    CHECK(names(complaint([] { kinetic_feedback{1, 1, 1, 2}; }), "alpha starts as 2"));
}
