#include "bar.hpp"
#include "scenes/reflection.hpp"

#include "catch.hpp"

namespace {

bar_options options_of(const std::string& update, int order, const std::string& particles) {
    bar_options o(reflection());
    o.update = update;
    o.order = order;
    o.particles = particles;
    return o;
}

}  // namespace

TEST_CASE("the energy is the work of the driven end, up to the wave's return") {
    struct scheme {
        std::string update;
        int order;
        double bound;
    };
    // XPIC(2) damps a little more than 1 % at Courant number 0.1, most at t = 1.87.
    for (const scheme& s :
         {scheme{"flip", 0, 0.01}, scheme{"fmpm", 2, 0.01}, scheme{"fmpm", 4, 0.01}, scheme{"xpic", 2, 0.012}})
        for (const std::string particles : {"held", "moving"}) {
            CAPTURE(s.update, s.order, particles);
            auto o = options_of(s.update, s.order, particles);
            o.every = 10;
            const auto result = run_bar(reflection(), o);
            const auto exact = reflection().exact(o.amplitude);
            REQUIRE(result.energy.size() == 201);
            for (const auto& e : result.energy) {
                CAPTURE(e.t);
                // At first there is hardly any energy to be relative to.
                if (e.t >= 0.1) CHECK(std::abs(e.total() / exact.energy(e.t) - 1) < s.bound);
                CHECK(std::abs(e.boundary_work - exact.energy(e.t)) < 0.01 * exact.energy(o.time));
            }
            CHECK(std::abs(result.energy.back().total() / exact.energy(o.time) - 1) < 0.01);
        }
}

TEST_CASE("the wave is followed through its images") {
    auto o = options_of("fmpm", 2, "held");
    o.cells = 200;
    for (const double time : {1.7, 3.3}) {
        o.time = time;
        const auto e = errors_of(reflection(), o, run_bar(reflection(), o));
        CAPTURE(time);
        CHECK(e.velocity_l2 < 0.015);
        CHECK(e.strain_l2 < 0.03);
    }
}
