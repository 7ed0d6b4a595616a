#include "gas_wave.hpp"

#include "catch.hpp"
#include "unit/complaint.hpp"

#include <cmath>

namespace {

gas_wave_options of(const std::string& shape, const std::string& update, const std::string& particles) {
    gas_wave_options o;
    o.shape = shape;
    o.update = update;
    o.particles = particles;
    return o;
}

}  // namespace

TEST_CASE("gas wave: errors at t = 0.5, 1 and 1.4, beside those of ADMPM's own scheme") {
    const auto check = [](const gas_wave_options& o, double first, double second, double third) {
        const gas_wave_result r = run_gas_wave(o);
        REQUIRE(r.records.size() == 3);
        CAPTURE(o.update, o.stress, o.particles, o.rate, r.records[0].velocity_l2, r.records[1].velocity_l2,
                r.records[2].velocity_l2);
        CHECK(std::abs(r.records[0].velocity_l2 / first - 1) < 0.02);
        CHECK(std::abs(r.records[1].velocity_l2 / second - 1) < 0.02);
        CHECK(std::abs(r.records[2].velocity_l2 / third - 1) < 0.02);
    };
    check(of("linear", "flip", "moving"), 1.921e-2, 3.002e-2, 3.559e-2);
    check(of("linear", "fmpm", "held"), 1.366e-2, 1.653e-2, 2.489e-2);
    gas_wave_options admpm = of("linear", "flip", "moving");
    admpm.stress = "euler";
    admpm.rate = "admpm";
    admpm.courant = 0.01;
    check(admpm, 2.489e-2, 4.592e-2, 4.674e-2);
}

TEST_CASE("gas wave: second order in h before the wave comes to the fixed end") {
    // A drive without a kink, and an amplitude that leaves the gas as good as linear.
    for (const std::string particles : {"held", "moving"})
        for (const std::string shape : {"linear", "quadratic"}) {
            double before = 0;
            for (const int cells : {100, 200, 400}) {
                gas_wave_options o = of(shape, "flip", particles);
                o.drive = "smooth";
                o.amplitude = 1e-5;
                o.cells = cells;
                o.times = {0.9};
                const double now = run_gas_wave(o).records.back().velocity_l2;
                CAPTURE(particles, shape, cells, now, before);
                if (before > 0) CHECK(std::log2(before / now) > 1.85);
                before = now;
            }
        }
}

TEST_CASE(
    "gas wave: at finite amplitude each motion's own rate of pressure is right, ADMPM's is wrong for moving ones") {
    const auto error = [](const std::string& particles, const std::string& rate, int cells) {
        gas_wave_options o = of("quadratic", "flip", particles);
        o.rate = rate;
        o.drive = "smooth";
        o.amplitude = 0.005;
        o.cells = cells;
        o.times = {0.9};
        return run_gas_wave(o).records.back().velocity_l2_finite;
    };
    for (const std::string particles : {"moving", "held"}) {
        const double coarse = error(particles, "motion", 100), fine = error(particles, "motion", 200);
        CAPTURE(particles, coarse, fine);
        CHECK(std::log2(coarse / fine) > 1.8);
    }
    const double coarse = error("moving", "admpm", 100), fine = error("moving", "admpm", 200);
    CAPTURE(coarse, fine);
    // What is left when the grid's part, of second order, is taken off: the rate's own error.
    CHECK((4 * fine - coarse) / 3 > 5e-3);
}

TEST_CASE("gas wave: energy is the work of the driven end") {
    for (const std::string particles : {"held", "moving"}) {
        gas_wave_options o = of("quadratic", "flip", particles);
        o.stress = "usavg-";
        o.amplitude = 1e-3;
        o.times = {0.9, 1.4};
        for (const gas_wave_record& r : run_gas_wave(o).records) {
            CAPTURE(particles, r.time, r.kinetic, r.internal, r.boundary_work);
            CHECK(std::abs((r.kinetic + r.internal) / r.boundary_work - 1) < 0.02);
        }
    }
}

TEST_CASE("gas wave: what cannot be run gets a sentence") {
    const auto says = [](const gas_wave_options& o) { return complaint([&] { run_gas_wave(o); }); };
    gas_wave_options o;
    o.update = "apic";
    CHECK(names(says(o), "update", "'apic'", "fmpm"));
    o = of("quadratic", "flip", "moving");
    o.rate = "admpm";
    o.stress = "usavg-";
    CHECK(names(says(o), "admpm", "'usavg-'", "usl-"));
    // Particles at the driven end come to it, where no gas flows out.
    o = of("linear", "flip", "moving");
    o.amplitude = 0.1;
    CHECK(names(says(o), "particle ", "left the grid"));
}
