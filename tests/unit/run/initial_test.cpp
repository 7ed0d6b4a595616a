#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 4, .poisson = 0.25, .density = 2};

}  // namespace

TEST_CASE("initial: velocities, densities and strains come from functions of the place") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}};
    auto block = mpm.make_body(law, everywhere, per_cell{2}, fields<field::density, field::strain>{});
    set_velocity_of(block, [](const auto& at) { return (at * 2).eval(); });
    set_density_of(block, [](const auto& at) { return 1 + at[1]; });
    for (const auto p : std::as_const(block)) {
        CHECK(p[v] == 2 * p[x]);
        CHECK(p[rho] == 1 + p[x][1]);
        CHECK(p[m] == (1 + p[x][1]) * p[V]);
    }
    set_strain_of(block, [](const auto& at) { return (matrix<2, double>() << at[0], 0.5, 0.5, -0.25).finished(); });
    for (const auto p : std::as_const(block)) {
        const matrix<2, double> strain = (matrix<2, double>() << p[x][0], 0.5, 0.5, -0.25).finished();
        CHECK((p[sigma] - law.at_strain(p, strain)).norm() < 1e-15);
        CHECK(p[epsilon] == strain);
        CHECK(std::abs(p[rho] - (1 + p[x][1]) / (0.75 + p[x][0])) < 1e-15);
    }
    const std::string text = complaint([&] { set_density_of(block, [](const auto& at) { return at[0] - 0.5; }); });
    CAPTURE(text);
    CHECK(names(text, "set_density_of", "at (0.0625", "-0.4375", "positive"));
}

TEST_CASE("initial: deformation gradients give a law of finite strain its stresses") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.5}};
    const neo_hookean rubber{.young = 4, .poisson = 0.25, .density = 2};
    auto block = mpm.make_body(rubber, everywhere, per_cell{2}, fields<field::density, field::strain>{});
    const auto stretched = [](const auto& at) {
        return (matrix<2, double>() << 1 + at[0], 0.5, 0.25, 1 + at[1]).finished();
    };
    set_deformation_of(block, stretched);
    for (const auto p : std::as_const(block)) {
        const matrix<2, double> of = stretched(p[x]), B = of * of.transpose(), one = matrix<2, double>::Identity();
        CHECK(matrix<2, double>(p[F]) == of);
        // mu = lambda = 1.6
        CHECK((p[sigma] - 1.6 * (B - one + std::log(of.determinant()) * one)).norm() < 1e-14);
        CHECK(std::abs(p[rho] - 2 / of.determinant()) < 1e-15);
        CHECK((p[epsilon] - (of + of.transpose()) / 2 + one).norm() < 1e-15);
    }
    const std::string text = complaint([&] {
        set_deformation_of(block,
                           [](const auto& at) { return (matrix<2, double>() << at[0] - 0.5, 0, 0, 1).finished(); });
    });
    CAPTURE(text);
    CHECK(names(text, "set_deformation_of", "at (0.125", "-0.375", "positive"));
}

TEST_CASE("initial: a small strain sets the deformation gradient too, where it is stored") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2}, fields<field::deformation>{});
    set_strain_of(bar, [](const auto& at) { return 0.1 * at[0]; });
    for (const auto p : std::as_const(bar)) CHECK(p[F](0, 0) == 1 + 0.1 * p[x][0]);
}

TEST_CASE("initial: in 1D a number will do") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    set_velocity_of(bar, [](const auto& at) { return 3 * at[0]; });
    set_strain_of(bar, [](const auto& at) { return 0.1 * at[0]; });
    for (const auto p : std::as_const(bar)) {
        CHECK(p[v][0] == 3 * p[x][0]);
        CHECK(std::abs(p[sigma](0, 0) - 0.4 * p[x][0]) < 1e-16);
    }
}

TEST_CASE("initial: through the nodes, functions are what the shape functions make of them") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}};
    const auto square = through_nodes(mpm, [](const auto& at) { return at[0] * at[0]; });
    // Half-way between nodes: the mean of their values.
    CHECK(std::abs(square(point<1, double>(0.375)) - (0.0625 + 0.25) / 2) < 1e-16);
    CHECK(square(point<1, double>(0.5)) == 0.25);
    CHECK(square(point<1, double>(1.)) == 1);
}
