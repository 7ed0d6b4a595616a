#include "front.hpp"

#include "catch.hpp"

namespace {

/// A profile with fronts at 1/2 -+ t, as wide as w, that goes beyond the plateau by `more` near the right one.
std::vector<bar_particle> profile(double t, double w, double more) {
    std::vector<bar_particle> all;
    for (int k = 0; k < 800; ++k) {
        const double x = (k + 0.5) / 800;
        const auto ramp = [&](double from_front) { return std::min(1.0, std::max(0.0, 0.5 - from_front / w)); };
        double strain = -(ramp(x - (0.5 - t)) + ramp(x - (0.5 + t))) / 2;
        if (std::abs(x - (0.5 + t - 2 * w)) < 0.002) strain *= 1 + more;
        all.push_back({x, 0, strain});
    }
    return all;
}

}  // namespace

TEST_CASE("fronts are where the profile crosses half its height") {
    std::vector<front_places> places;
    for (double t = 0.05; t < 0.41; t += 0.05) {
        const auto at = find_fronts(t, profile(t, 0.0137, 0.3), 1);
        CHECK(std::abs(at.left - (0.5 - t)) < 1e-12);
        CHECK(std::abs(at.right - (0.5 + t)) < 1e-12);
        places.push_back(at);
    }
    CHECK(std::abs(front_speed(places) - 1) < 1e-12);
}

TEST_CASE("overshoot is what goes beyond the plateau") {
    CHECK(overshoot(0.3, profile(0.3, 0.01, 0), 1) < 1e-12);
    CHECK(std::abs(overshoot(0.3, profile(0.3, 0.01, 0.3), 1) - 0.3) < 1e-12);
}

TEST_CASE("without a front there is no place and no speed") {
    const std::vector<bar_particle> quiet{{0.1, 0, 0}, {0.2, 0, 0}};
    CHECK(std::isnan(find_fronts(0.1, quiet, 1).right));
    CHECK(std::isnan(front_speed({find_fronts(0.1, quiet, 1)})));
}
