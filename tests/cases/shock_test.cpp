#include "bar.hpp"
#include "scenes/shock.hpp"

#include "catch.hpp"

namespace {

struct scheme {
    std::string update;
    int order;
};
const std::vector<scheme> schemes{{"flip", 0}, {"xpic", 2}, {"fmpm", 1}, {"fmpm", 2}, {"fmpm", 4}};

}  // namespace

TEST_CASE("fronts run with the wave speed") {
    for (const double amplitude : {0.001, 0.01})
        for (const scheme& s : schemes)
            for (const std::string particles : {"held", "moving"}) {
                CAPTURE(amplitude, s.update, s.order, particles);
                bar_options o(shock());
                o.amplitude = amplitude;
                o.update = s.update;
                o.order = s.order;
                o.particles = particles;
                const auto result = run_bar(shock(), o);
                REQUIRE(result.fronts.size() == 100);
                CHECK(std::abs(front_speed(result.fronts) - 1) < 0.01);
                // Moving particles of the larger amplitude go to other cells, and linear functions kick them.
                if (amplitude < 0.01 || particles == "held")
                    CHECK(overshoot(o.time, result.particles, amplitude) < 0.3);
            }
}

TEST_CASE("on average strain and velocity between the fronts are half the first strain") {
    bar_options o(shock());
    o.particles = "held";
    const auto result = run_bar(shock(), o);
    double strain = 0, velocity = 0, n = 0;
    for (const auto& p : result.particles) {
        if (std::abs(p.x - 0.5) > 0.2) continue;
        strain += p.strain;
        velocity += p.velocity;
        n += 1;
    }
    CHECK(std::abs(strain / n + o.amplitude / 2) < 0.01 * o.amplitude / 2);
    CHECK(std::abs(velocity / n - o.amplitude / 2) < 0.01 * o.amplitude / 2);
}
