// Two neo-Hookean disks collide and part again, as examples/disks.cpp on a coarser grid: the energy that is lost,
// pinned to what was measured. It depends on where the disks meet: by far the most is lost where the plane between them
// is one of nodes.
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;

namespace {

using place = point<2, double>;

struct outcome {
    double loss, rebound;  // share of the energy (%), mean speed over that before
};

/// Both disks moved by `shift` (m) along x.
template <class Scheme> outcome collide(double shift, const Scheme& scheme) {
    constexpr double radius = 0.01, gap = 0.002;
    const neo_hookean law{.young = 1e9, .poisson = 0.33, .density = 1500};
    const double speed = 0.005 * law.wave_speed(2);
    solver mpm{uniform_grid{{0., 0.}, {0.05, 0.024}, 0.001}, ugimp{2}, scheme, usl_minus{}};
    const auto disk = [](double centre) {
        return [=](const auto& at) { return std::hypot(at[0] - centre, at[1] - 0.012) < radius; };
    };
    auto left = mpm.make_body(law, disk(0.025 + shift - gap / 2 - radius), per_cell{2});
    auto right = mpm.make_body(law, disk(0.025 + shift + gap / 2 + radius), per_cell{2});
    set_velocity_of(left, [&](const auto&) { return place(speed, 0); });
    set_velocity_of(right, [&](const auto&) { return place(-speed, 0); });
    const double before = kinetic_energy(left) + kinetic_energy(right);
    integrate(mpm, bodies(left, right), {0, gap / (2 * speed) + 0.186e-3}, courant{0.2});
    const double after = kinetic_energy(left) + kinetic_energy(right) + elastic_energy(left) + elastic_energy(right);
    return {100 * (1 - after / before), mean(right, symbols::v)[0] / speed};
}
template <class Scheme> void loses(double percent, double shift, const Scheme& scheme) {
    const outcome found = collide(shift, scheme);
    CAPTURE(shift, found.rebound);
    CHECK_THAT(found.loss, Catch::Matchers::WithinAbs(percent, 0.02));
    CHECK(found.rebound > 0.98);
    CHECK(found.rebound < 1);
}

}  // namespace

TEST_CASE("disks: what a collision costs where they meet on nodes") {
    loses(2.307, 0, flip{});
    loses(2.030, 0, fmpm<4>{});
}
TEST_CASE("disks: and where they meet between nodes") {
    loses(0.261, 0.0005, flip{});
    loses(0.607, 0.0005, fmpm<4>{});
}
