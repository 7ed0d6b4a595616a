#include "bar.hpp"
#include "scenes/standing_wave.hpp"

#include "catch.hpp"

namespace {

bar_options options_of(const std::string& update, int order, const std::string& particles, int cells) {
    bar_options o(standing_wave());
    o.update = update;
    o.order = order;
    o.particles = particles;
    o.cells = cells;
    return o;
}
bar_errors errors(const bar_options& o) { return errors_of(standing_wave(), o, run_bar(standing_wave(), o)); }

}  // namespace

TEST_CASE("held particles keep to the exact wave") {
    const auto check = [](const std::string& update, double velocity, double strain) {
        CAPTURE(update);
        const auto o = options_of(update, 2, "held", 50);
        const auto result = run_bar(standing_wave(), o);
        const auto e = errors_of(standing_wave(), o, result);
        CHECK(result.steps == 1000);
        CHECK(e.velocity_l2 < velocity);
        CHECK(e.strain_l2 < strain);
        CHECK(e.velocity_max < 2 * velocity);
        CHECK(std::abs(result.mass - 1) < 1e-13);
        CHECK(std::abs(result.energy.back().total() / result.energy.front().total() - 1) < 1e-3);
    };
    check("fmpm", 3e-4, 1.2e-3);
    check("flip", 1e-4, 3e-3);
    check("xpic", 4e-4, 3e-3);
}

TEST_CASE("errors fall with the square of the spacing") {
    for (const std::string update : {"flip", "fmpm"}) {
        bar_errors coarse = errors(options_of(update, 2, "held", 25));
        for (const int cells : {50, 100, 200}) {
            CAPTURE(update, cells);
            const bar_errors fine = errors(options_of(update, 2, "held", cells));
            CHECK(std::log2(coarse.velocity_l2 / fine.velocity_l2) > 1.95);
            CHECK(std::log2(coarse.strain_l2 / fine.strain_l2) > 1.95);
            coarse = fine;
        }
    }
}

TEST_CASE("PIC damps, FMPM(1) is PIC") {
    const auto pic = errors(options_of("pic", 1, "held", 50)), fmpm = errors(options_of("fmpm", 1, "held", 50));
    CHECK(pic.velocity_l2 > 0.1);
    CHECK(std::abs(pic.velocity_l2 - fmpm.velocity_l2) < 1e-12);
}

TEST_CASE("ADMPM's order feeds energy into the wave, with it its error") {
    auto o = options_of("flip", 2, "held", 50);
    o.stress = "euler";
    const auto result = run_bar(standing_wave(), o);
    CHECK(result.energy.back().total() > 1.015 * result.energy.front().total());
}

TEST_CASE("every composition that the options name runs and keeps mass and wave") {
    for (const std::string precision : {"double", "float"})
        for (const std::string shape : {"linear", "quadratic", "cubic"})
            for (const std::string particles : {"held", "moving"})
                for (const std::string update : {"pic", "flip", "blend", "xpic", "fmpm"})
                    for (const std::string stress : {"usf", "usl-", "usl+", "usavg-", "usavg+", "euler"}) {
                        CAPTURE(precision, shape, particles, update, stress);
                        auto o = options_of(update, 3, particles, 20);
                        o.precision = precision;
                        o.shape = shape;
                        o.stress = stress;
                        o.amplitude = 1e-4;
                        o.time = 0.2;
                        if (!is_built(o)) continue;
                        const auto result = run_bar(standing_wave(), o);
                        const auto e = errors_of(standing_wave(), o, result);
                        REQUIRE(std::abs(result.mass - 1) < (precision == "float" ? 1e-5 : 1e-13));
                        REQUIRE(e.velocity_l2 < (update == "pic" ? 0.2 : 0.02));
                        REQUIRE(e.strain_l2 < (update == "pic" ? 0.2 : 0.04));
                        REQUIRE(result.bytes_per_particle >= (precision == "float" ? 20u : 40u));
                    }
}
