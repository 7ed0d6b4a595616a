// Particles of amplitude 0.01 in 100 cells go to other cells. Slopes of linear functions jump there, and the jumps go
// into the stress; splines have none.
#include "bar.hpp"
#include "scenes/standing_wave.hpp"

#include "catch.hpp"

namespace {

bar_options options_of(const std::string& shape, const std::string& update, double time) {
    bar_options o(standing_wave());
    o.cells = 100;
    o.shape = shape;
    o.update = update;
    o.time = time;
    return o;
}
bar_errors errors(const std::string& shape, const std::string& update, double time) {
    const auto o = options_of(shape, update, time);
    return errors_of(standing_wave(), o, run_bar(standing_wave(), o));
}

}  // namespace

TEST_CASE("linear functions suffer grid crossing") {
    for (const std::string update : {"flip", "xpic", "fmpm"}) {
        CAPTURE(update);
        CHECK(errors("linear", update, 2).strain_l2 > 0.1);
    }
}

TEST_CASE("splines do not") {
    for (const std::string shape : {"quadratic", "cubic"})
        for (const std::string update : {"flip", "xpic", "fmpm"}) {
            CAPTURE(shape, update);
            if (!is_built(options_of(shape, update, 2))) continue;
            const auto e = errors(shape, update, 2);
            CHECK(e.velocity_l2 < 0.02);
            CHECK(e.strain_l2 < 0.02);
        }
}
