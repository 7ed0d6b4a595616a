#include <tamis/tamis.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr double young = 7, poisson = 0.3, density = 2;
constexpr double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
const linear_elastic law{.young = young, .poisson = poisson, .density = density};

template <int D> matrix<D, double> any_strain() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1, 1);
    matrix<D, double> strain;
    for (int d = 0; d < D; ++d)
        for (int e = 0; e <= d; ++e) strain(d, e) = strain(e, d) = number(random);
    return strain;
}

/// Strain and stress in three dimensions: in 2D the third direction is held, in 1D sideways stress is zero.
template <int D> matrix<3, double> full_strain(const matrix<D, double>& strain) {
    matrix<3, double> full = matrix<3, double>::Zero();
    full.template topLeftCorner<D, D>() = strain;
    if (D == 1) full(1, 1) = full(2, 2) = -poisson * strain(0, 0);
    return full;
}

template <int D> void agrees_with_hooke() {
    CAPTURE(D);
    const matrix<D, double> strain = any_strain<D>();
    const matrix<3, double> full = full_strain<D>(strain);
    const matrix<3, double> hooke = lame * full.trace() * matrix<3, double>::Identity() + 2 * shear * full;
    const matrix<D, double> stress = law.at_strain(0, strain);
    const matrix<D, double> expected = hooke.topLeftCorner<D, D>();
    CHECK((stress - expected).norm() < 1e-14);
    CHECK(std::abs(law.energy(0, stress) - hooke.cwiseProduct(full).sum() / 2) < 1e-14);
}

/// The stress after a step with a velocity gradient from an earlier stress.
template <int D> void adds_stress_increments() {
    matrix<D, double> L = any_strain<D>() * 3, before = any_strain<D>();
    if (D > 1) L(0, 1) += 2;
    struct row {
        matrix<D, double> stress;
        matrix<D, double> operator[](field::stress) const { return stress; }
    };
    const double dt = 0.01;
    const matrix<D, double> after = law.stress(row{before}, L, dt);
    const matrix<D, double> half = (L + L.transpose()) / 2;
    const matrix<D, double> increment = law.at_strain(0, matrix<D, double>(dt * half));
    CHECK((after - before - increment).norm() < 1e-15);
}

std::string refusal(double e, double nu, double rho0) {
    return complaint([&] { linear_elastic{.young = e, .poisson = nu, .density = rho0}.check(); });
}

}  // namespace

TEST_CASE("linear_elastic: stress and energy are Hooke's, uniaxial in 1D, plane strain in 2D") {
    agrees_with_hooke<1>();
    agrees_with_hooke<2>();
    agrees_with_hooke<3>();
}

TEST_CASE("linear_elastic: a step adds the stress of its strain increment") {
    adds_stress_increments<1>();
    adds_stress_increments<2>();
    adds_stress_increments<3>();
}

TEST_CASE("linear_elastic: the wave speed is the longitudinal one") {
    CHECK(std::abs(law.wave_speed(1) - std::sqrt(young / density)) < 1e-15);
    CHECK(std::abs(law.wave_speed(2) - std::sqrt((lame + 2 * shear) / density)) < 1e-15);
    CHECK(law.wave_speed(3) == law.wave_speed(2));
}

TEST_CASE("linear_elastic: parameters that make no sense are refused by name") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    CHECK(refusal(1, 0.49, 1) == "nothing");
    CHECK(refusal(1, -0.9, 1) == "nothing");
    CHECK(names(refusal(-2, 0, 1), "linear_elastic", "Young's modulus is -2", "positive"));
    for (const double e : {0., infinity, not_a_number}) CHECK(names(refusal(e, 0, 1), "Young's modulus is"));
    CHECK(names(refusal(1, 0.5, 1), "linear_elastic", "Poisson's ratio is 0.5", "below 0.5"));
    for (const double nu : {-1., 0.7, not_a_number}) CHECK(names(refusal(1, nu, 1), "Poisson's ratio is"));
    CHECK(names(refusal(1, 0, -3), "linear_elastic", "density is -3", "positive"));
    for (const double rho0 : {0., infinity, not_a_number}) CHECK(names(refusal(1, 0, rho0), "density is"));
}

TEST_CASE("linear_elastic: a body is refused with the same words") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.5}};
    const auto with = [&](double e, double nu, double rho0) {
        return complaint([&] {
            mpm.make_body(linear_elastic{.young = e, .poisson = nu, .density = rho0}, everywhere, per_cell{1});
        });
    };
    CHECK(names(with(-2, 0, 1), "Young's modulus is -2"));
    CHECK(names(with(1, 0.5, 1), "Poisson's ratio is 0.5"));
    CHECK(names(with(1, 0, -3), "density is -3"));
}

TEST_CASE("varying_elastic: every particle has a modulus of its own") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}, held{}};
    auto bar = mpm.make_body(varying_elastic{.young = 2, .poisson = 0, .density = 1}, everywhere, per_cell{2});
    for (auto p : bar) {
        CHECK(p[E] == 2);
        p[E] = 1 + p[x][0];
        p[v][0] = p[x][0];
        CHECK(std::abs(bar.law.wave_speed_at(p, 1) - std::sqrt(p[E])) < 1e-15);
    }
    mpm.step(bodies(bar), 0.125);
    for (const auto p : std::as_const(bar)) {
        if (p[x][0] < 0.25 || p[x][0] > 0.75) continue;
        // The velocity's gradient is 1 away from the walls.
        const double stress = p[sigma](0, 0);
        CHECK(std::abs(stress - 0.125 * (1 + p[x][0])) < 1e-15);
        CHECK(std::abs(bar.law.energy(p, p[sigma]) - stress * 0.125 / 2) < 1e-15);
    }
}

TEST_CASE("varying_elastic: a modulus that is not positive is refused with its particle") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.5}};
    auto bar = mpm.make_body(varying_elastic{.young = 2, .poisson = 0, .density = 1}, everywhere, per_cell{1});
    for (auto p : bar)
        if (p[x][0] > 0.5) p[E] = -4;
    const std::string text = complaint([&] { mpm.step(bodies(bar), 0.1); });
    CAPTURE(text);
    CHECK(names(text, "particle 1 at (0.75)", "step 0", "t = 0", "its modulus is -4", "positive"));
}
