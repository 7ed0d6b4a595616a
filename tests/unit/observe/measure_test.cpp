#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 3, .poisson = 0.25, .density = 2};

}  // namespace

TEST_CASE("measure: mass, momentum, energies and means of a body") {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.25}};
    auto block = mpm.make_body(law, everywhere, per_cell{2});
    const matrix<2, double> strain = (matrix<2, double>() << 0.1, 0.02, 0.02, -0.03).finished();
    for (auto p : block) {
        p[v] << 3, p[x][1];
        p[sigma] = law.at_strain(p, strain);
    }
    // A plate of 2 by 1 of density 2; v = (3, y), so that the mean of v^2 is 9 + 1/3 less what four per unit miss of
    // it.
    CHECK(std::abs(total_mass(block) - 4) < 1e-14);
    CHECK((total_momentum(block) - point<2, double>(12, 2)).norm() < 1e-13);
    const double mean_square = 9 + 1. / 3 - 1. / (12 * 64);
    CHECK(std::abs(kinetic_energy(block) - 2 * mean_square) < 1e-13);
    const matrix<2, double> stress = law.at_strain(0, strain);
    CHECK(std::abs(elastic_energy(block) - 2 * stress.cwiseProduct(strain).sum() / 2) < 1e-15);
    CHECK((mean(block, x) - point<2, double>(1, 0.5)).norm() < 1e-14);
    CHECK(std::abs(mean(block, m) - 4. / 128) < 1e-16);
    CHECK(std::abs(largest_speed(block) - std::hypot(3, 0.9375)) < 1e-15);
    CHECK(std::abs(sum_over(block, [](const auto& p) { return p[V]; }) - 2) < 1e-14);
}
