// The density of particles by strain increments, rho' = rho/(1 + tr d_eps) (Molinos 2019, with USF; docs/method.md,
// Strain and laws), in a body that is stretched uniformly: all nodes follow v_d = a_d x_d/(1 + a_d t), so a particle of
// place X is at X (1 + a_d t) and has the density rho0/prod_d (1 + a_d t).
#include <tamis/boundary/conditions.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/run/integrate.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

constexpr double rates[2] = {0.6, -0.3}, end = 0.5;

/// What is off after a run, relative to the exact density: the density, and rho J/rho0 with the particle's own J.
struct off {
    double density = 0, with_own_volume = 0;
};
template <int Dim, class Order> off stretched(const Order& order, long steps) {
    const auto follow = prescribed{everywhere, [](const auto& at, auto t) {
                                       auto v = at;
                                       for (int d = 0; d < Dim; ++d) v[d] *= rates[d] / (1 + rates[d] * t);
                                       return v;
                                   }};
    const auto grid = [] {
        if constexpr (Dim == 1)
            return uniform_grid{{0.}, {1.}, 0.125};
        else
            return uniform_grid{{0., 0.}, {1., 1.}, 0.125};
    }();
    solver mpm{grid, quadratic_spline{}, pic{}, order, follow};
    const linear_elastic law{.young = 1e-3, .poisson = 0, .density = 2};
    auto body = mpm.make_body(
        law, [](const auto& at) { return at.maxCoeff() < 0.5; }, per_cell{2},
        fields<field::density, field::deformation>{});
    integrate(mpm, bodies(body), {0, end}, fixed_steps{steps});
    double exact = law.density;
    for (int d = 0; d < Dim; ++d) exact /= 1 + rates[d] * end;
    off most;
    for (const auto p : std::as_const(body)) {
        const double rho = p[symbols::rho], J = p[symbols::F].determinant();
        most.density = std::max(most.density, std::abs(rho / exact - 1));
        most.with_own_volume = std::max(most.with_own_volume, std::abs(rho * J / law.density - 1));
    }
    return most;
}
template <int Dim, class Order> void density_has_order(const Order& order, double expected) {
    const off coarse = stretched<Dim>(order, 40), fine = stretched<Dim>(order, 80);
    CAPTURE(Dim, Order::name, coarse.density, fine.density);
    CHECK(std::abs(std::log2(coarse.density / fine.density) - expected) < 0.1);
    CHECK(coarse.density < 0.02);
}

}  // namespace

TEST_CASE("density: in one dimension USF is exact in uniform stretching, and rho J = rho0 in every order") {
    // (1 + a t)/(1 + a (t + dt)) = 1/(1 + dt L(t)) with L(t) = a/(1 + a t), the slope of the step's start.
    const off first = stretched<1>(usf{}, 40);
    CHECK(first.density < 1e-13);
    for (const off& each : {first, stretched<1>(usl_minus{}, 40), stretched<1>(usavg_minus{}, 40)})
        CHECK(each.with_own_volume < 1e-13);
    // The slope of the step's end; half of each, and (1 + dt L/2)^2 is not 1 + dt L.
    density_has_order<1>(usl_minus{}, 1);
    density_has_order<1>(usavg_minus{}, 1);
}

TEST_CASE("density: in two dimensions 1 + tr d_eps is det(1 + d_eps) to first order") {
    density_has_order<2>(usf{}, 1);
    const off coarse = stretched<2>(usf{}, 40), fine = stretched<2>(usf{}, 80);
    CHECK(std::abs(std::log2(coarse.with_own_volume / fine.with_own_volume) - 1) < 0.1);
    // F is exact here, so that both are the same.
    CHECK(std::abs(coarse.with_own_volume / coarse.density - 1) < 1e-9);
}
