// What a step takes of a wave's energy (docs/stability.md, Energy over many steps).
#include <tamis/shape/linear.hpp>
#include <tamis/stability/lattice.hpp>

#include "catch.hpp"

#include <numbers>

namespace {

using namespace tamis;

/// Factor of a wave's energy in a step: |lambda|^2 of its pair of eigenvalues. Those of what the grid does not see are
/// real.
template <class Order> double energy_kept(double theta, double dt, const Order& order) {
    const stability::lattice_step<1> step(stability::lattice<1>{2, 0}, 4, linear{}, flip{}, order);
    const Eigen::MatrixXcd of_wave = step.of_wave({theta})(dt);
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> modes(of_wave, false);
    double kept = 0;
    for (const auto& lambda : modes.eigenvalues())
        if (std::abs(lambda.imag()) > 1e-3) kept = std::norm(lambda);
    return kept;
}

}  // namespace

TEST_CASE("stability: FLIP loses a wave's energy where strains use what particles do not have") {
    for (const double theta : {std::numbers::pi / 8, 1., 2.})
        for (const double dt : {0.1, 0.3}) {
            // Linear functions, 2 per cell: w^2 of the lumped grid, and the share that A takes.
            const double squared = 2 * (1 - std::cos(theta)) * dt * dt, unseen = 0.375 * (1 - std::cos(theta));
            CAPTURE(theta, dt);
            CHECK_THAT(energy_kept(theta, dt, usl_minus{}), Catch::Matchers::WithinAbs(1 - unseen * squared, 1e-9));
            CHECK_THAT(energy_kept(theta, dt, usavg_minus{}),
                       Catch::Matchers::WithinAbs(1 - unseen * squared / 2, 1e-9));
            CHECK_THAT(energy_kept(theta, dt, usf{}), Catch::Matchers::WithinAbs(1, 1e-9));
            CHECK_THAT(energy_kept(theta, dt, usl_plus{}), Catch::Matchers::WithinAbs(1, 1e-9));
            CHECK_THAT(energy_kept(theta, dt, usavg_plus{}), Catch::Matchers::WithinAbs(1, 1e-9));
        }
}
