#include "riemann.hpp"

#include <cmath>

#include "catch.hpp"

using riemann::solution;
using riemann::state;

namespace {

bool near(double a, double b, double share) { return std::abs(a - b) <= share * std::abs(b); }

/// Mass, momentum and energy through a discontinuity of speed s.
void check_jump(double gamma, const state& a, const state& b, double s) {
    const auto flux = [&](const state& w, int which) {
        const double energy = w.pressure / (gamma - 1) + w.density * w.velocity * w.velocity / 2;
        const double relative = w.velocity - s;
        return which == 0   ? w.density * relative
               : which == 1 ? w.density * w.velocity * relative + w.pressure
                            : energy * relative + w.pressure * w.velocity;
    };
    for (int which = 0; which < 3; ++which) CHECK(near(flux(a, which), flux(b, which), 1e-10));
}

}  // namespace

TEST_CASE("riemann: the tests of Toro, table 4.2") {
    // p*, u* of tests 1, 3, 4 and 5; test 2 has two rarefactions and nearly vacuum between.
    struct test {
        state left, right;
        double pressure, velocity;
    };
    const test all[] = {{{1, 0, 1}, {0.125, 0, 0.1}, 0.30313, 0.92745},
                        {{1, -2, 0.4}, {1, 2, 0.4}, 0.00189, 0.00000},
                        {{1, 0, 1000}, {1, 0, 0.01}, 460.894, 19.5975},
                        {{1, 0, 0.01}, {1, 0, 100}, 46.0950, -6.19633},
                        {{5.99924, 19.5975, 460.894}, {5.99242, -6.19633, 46.0950}, 1691.64, 8.68975}};
    for (const test& one : all) {
        const solution found(1.4, one.left, one.right);
        CHECK(std::abs(found.pressure() - one.pressure) < 6e-6 * std::fmax(one.pressure, 1));
        CHECK(std::abs(found.velocity() - one.velocity) < 6e-6 * std::fmax(std::abs(one.velocity), 1));
    }
}

TEST_CASE("riemann: shocks obey the jump conditions, rarefactions keep entropy and their invariant") {
    const double gamma = 1.4;
    const state left{1, 0, 1}, right{0.125, 0, 0.1};
    const solution found(gamma, left, right);
    const double s = found.right_front();
    check_jump(gamma, found.at(s * 0.999999), found.at(s * 1.000001), s);
    const auto invariant = [&](const state& w) {
        return w.velocity + 2 / (gamma - 1) * std::sqrt(gamma * w.pressure / w.density);
    };
    for (const double x : {-1.1, -0.8, -0.4, -0.1}) {
        const state w = found.at(x);
        CHECK(near(w.pressure / std::pow(w.density, gamma), 1, 1e-12));
        CHECK(near(invariant(w), invariant(left), 1e-12));
    }
    // The contact, and its mirror image.
    CHECK(found.at(0.92).density > found.at(0.93).density);
    const solution mirror(gamma, right, left);
    for (const double x : {-1.5, -1., -0.3, 0.5, 1., 1.7, 1.9}) {
        const state a = found.at(x), b = mirror.at(-x);
        CHECK(near(a.density, b.density, 1e-12));
        CHECK(near(a.pressure, b.pressure, 1e-12));
        CHECK(std::abs(a.velocity + b.velocity) < 1e-12);
    }
    CHECK_THROWS(solution(gamma, {1, -20, 1}, {1, 20, 1}));
}
