// A bar of length 1, E = rho = c = 1, its left end fixed, is pulled at the right end by sigma from t = 0 on. By
// d'Alembert the end goes to 2 sigma L/E and back, a triangle wave of period 4 L/c, about the static stretch sigma L/E.
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double sigma0 = 1e-4;
constexpr double triangle(double t) {
    const double phase = t - 4 * static_cast<int>(t / 4);
    return sigma0 * (phase < 2 ? phase : 4 - phase);
}
const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
constexpr auto rod = [](const auto& at) { return at[0] < 1; };
constexpr auto left_end = fixed{[](const auto& at) { return at[0] <= 0; }};
constexpr auto pulled = traction{[](const auto&, const auto& n) { return n[0] > 0; },
                                 [](const auto&, const auto& n, double) { return (sigma0 * n).eval(); }};

/// Displacement of the end: the integral of the strain. Stress of the particle beside the middle.
template <class Body> double end_of(const Body& bar) {
    return sum_over(bar, [](const auto& p) { return p[field::strain{}](0, 0) * p[V]; });
}
template <class Body> double stress_at_middle(const Body& bar) {
    double nearest = 1, stress = 0;
    for (const auto p : bar)
        if (std::abs(p[x][0] - 0.5) < nearest) {
            nearest = std::abs(p[x][0] - 0.5);
            stress = p[sigma](0, 0);
        }
    return stress;
}

template <class... Policy> void rings(double deviation, const Policy&... policy) {
    CAPTURE(sizeof...(Policy));
    solver mpm{uniform_grid{{0.}, {1.2}, 0.02}, left_end, pulled, policy...};
    auto bar = mpm.make_body(law, rod, per_cell{2}, fields<field::strain>{});
    // Means over two periods by the trapezoidal rule.
    const long steps = 4000;
    double end = 0, stress = 0, worst = 0;
    integrate(mpm, bodies(bar), {0, 8}, fixed_steps{steps}, [&](const progress_state& now) {
        const double share = (now.step == 0 || now.step == steps ? 0.5 : 1.) / static_cast<double>(steps);
        const double at = end_of(std::as_const(bar));
        end += share * at;
        stress += share * stress_at_middle(std::as_const(bar));
        worst = std::max(worst, std::abs(at - triangle(now.time)));
    });
    CAPTURE(end / sigma0, stress / sigma0, worst / sigma0);
    CHECK(std::abs(end / sigma0 - 1) < 0.01);
    CHECK(std::abs(stress / sigma0 - 1) < 0.02);
    CHECK(worst < deviation * 2 * sigma0);
}

template <class... Policy> void comes_to_rest(const Policy&... policy) {
    CAPTURE(sizeof...(Policy));
    solver mpm{uniform_grid{{0.}, {1.2}, 0.02}, left_end, policy...};
    auto bar = mpm.make_body(law, rod, per_cell{2}, fields<field::strain>{});
    integrate(mpm, bodies(bar), {0, 30}, courant{0.5});
    const double end = end_of(std::as_const(bar)) / sigma0, stress = stress_at_middle(std::as_const(bar)) / sigma0;
    CAPTURE(end, stress);
    CHECK(std::abs(end - 1) < 0.005);
    CHECK(std::abs(stress - 1) < 0.005);
    CHECK(largest_speed(bar) < 1e-3 * sigma0);
}

}  // namespace

TEST_CASE("end traction: the bar rings about its static stretch") {
    rings(0.04, linear{}, flip{}, held{});
    rings(0.04, linear{}, fmpm<4>{}, held{});
    rings(0.04, quadratic_spline{}, flip{}, moving{});
    rings(0.04, quadratic_spline{}, xpic<4>{}, usf{}, moving{});
}
TEST_CASE("end traction: damped, the bar comes to rest at its static stretch") {
    comes_to_rest(loads{pulled, grid_damping{3.}}, held{}, linear{}, flip{});
    comes_to_rest(loads{pulled, grid_damping{[](double t) { return t < 1 ? 0. : 3.; }}}, fmpm<2>{}, usf{});
    // USL+ keeps the waves of a cell or two that USL- damps besides.
    comes_to_rest(loads{particle_damping{3.}, pulled}, usl_minus{});
    comes_to_rest(loads{kinetic_feedback{0, 2 / (sigma0 * sigma0), 3}, pulled}, usl_minus{});
}
