// A cantilever in plane strain, of length 8 and height 1, bends under its weight and a shear traction at its end, and
// is damped until it rests. Timoshenko's beam, E' = E/(1 - nu^2), I = H^3/12, kappa = 5/6:
//
//     P at the end    w(x) = P x^2 (3 L - x)/(6 E' I) + P x/(kappa G H)
//     q per length    w(x) = q x^2 (6 L^2 - 4 L x + x^2)/(24 E' I) + q (L x - x^2/2)/(kappa G H)
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;

/// Where a particle was created.
struct origin : vector_field {
    static constexpr std::string_view name = "origin";
};
constexpr origin x0;

constexpr double length = 8, height = 1, young = 1, poisson = 0.3;
constexpr double stiff = young / (1 - poisson * poisson), inertia = height * height * height / 12;
constexpr double shear = 5. / 6 * young / (2 * (1 + poisson)) * height;

struct beam_loads {
    double end, weight;  // force at the end, force per length
    double deflection(double at) const {
        return end * at * at * (3 * length - at) / (6 * stiff * inertia) + end * at / shear +
               weight * at * at * (6 * length * length - 4 * length * at + at * at) / (24 * stiff * inertia) +
               weight * (length * at - at * at / 2) / shear;
    }
};

/// Deflections at rest relative to Timoshenko's, at the end and half way.
struct ratios {
    double end, middle;
};
ratios bend(const beam_loads& given) {
    const double side = 1. / 6;
    // The first mode is damped critically.
    const double frequency = 3.516 * std::sqrt(stiff * inertia / height) / (length * length);
    const fixed clamp{[](const auto& at) { return at[0] <= 0; }};
    const loads all{gravity{place(0, given.weight / height)}, grid_damping{2 * frequency},
                    traction{[](const auto&, const auto& n) { return n[0] > 0; },
                             [&](const auto&, const auto&, double) { return place(0, given.end / height); }}};
    solver mpm{uniform_grid{{0., -1.}, {8.5, 2.}, side}, quadratic_spline{}, usl_minus{}, clamp, all};
    auto beam = mpm.make_body(
        linear_elastic{.young = young, .poisson = poisson, .density = 1},
        [](const auto& at) { return at[0] < length && at[1] > 0 && at[1] < height; }, per_cell{2}, fields<origin>{});
    for (auto p : beam) p[x0] = p[x];
    integrate(mpm, bodies(beam), {0, 9 / frequency}, courant{0.5});
    const auto ratio_at = [&](double column) {
        double sum = 0, at = 0, count = 0;
        for (const auto p : std::as_const(beam))
            if (std::abs(p[x0][0] - column) < side / 4 + 1e-9) {
                at += p[x0][0];
                sum += p[x][1] - p[x0][1];
                ++count;
            }
        return sum / count / given.deflection(at / count);
    };
    CHECK(largest_speed(beam) < 3e-3 * frequency * given.deflection(length));
    return {ratio_at(length - side / 4), ratio_at(length / 2)};
}

}  // namespace

TEST_CASE("cantilever: a traction at the end bends it as Timoshenko's beam") {
    const auto found = bend({1e-6, 0});
    CAPTURE(found.end, found.middle);
    CHECK(std::abs(found.end - 1) < 0.03);
    CHECK(std::abs(found.middle - 1) < 0.03);
}
TEST_CASE("cantilever: so does its weight") {
    const auto found = bend({0, 3e-7});
    CAPTURE(found.end, found.middle);
    CHECK(std::abs(found.end - 1) < 0.03);
    CHECK(std::abs(found.middle - 1) < 0.03);
}
