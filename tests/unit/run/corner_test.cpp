// Automatic steps of free blocks: corners have smaller critical numbers than the ends of a bar (docs/stability.md).
#include <tamis/tamis.hpp>

#include "catch.hpp"

#include <cmath>
#include <vector>

namespace {

using namespace tamis;
using namespace tamis::symbols;

/// Energy of a rough start in a free block of 2 cells per axis after automatic steps, over the start's; particles are
/// held at a place where little of them reaches the nodes beyond the block.
template <int Dim> double energy_after(double poisson) {
    double lower[Dim] = {}, upper[Dim];
    for (double& end : upper) end = 10;
    solver mpm{uniform_grid<Dim, double>{lower, upper, 1.}, quadratic_spline{}, flip{}, usl_minus{}, held{}};
    std::vector<point<Dim, double>> places;
    for (int p = 0; p < detail::power(4, Dim); ++p) {
        point<Dim, double> at;
        for (int d = 0, left = p; d < Dim; ++d, left /= 4) at[d] = 4.2 + (left % 4 + 0.5) / 2;
        places.push_back(at);
    }
    const linear_elastic law{
        .young = (1 + poisson) * (1 - 2 * poisson) / (1 - poisson), .poisson = poisson, .density = 1};
    auto block = mpm.make_body_at(law, places, std::pow(0.5, Dim));
    int number = 0;
    for (auto p : block) {
        for (int d = 0; d < Dim; ++d) p[v][d] = 1e-9 * std::sin(1 + 2.3 * number * number + 1.7 * d * number);
        ++number;
    }
    const double before = kinetic_energy(block);
    integrate(mpm, bodies(block), {0, 200}, courant{});
    return (kinetic_energy(block) + elastic_energy(block)) / before;
}

}  // namespace

TEST_CASE("integrate: automatic steps are short enough for corners") {
    CHECK(energy_after<2>(0.3) < 1);
    CHECK(energy_after<2>(0.499) < 1);
    CHECK(energy_after<3>(0.) < 1);
    CHECK(energy_after<3>(0.3) < 1);
    CHECK(energy_after<3>(0.499) < 1);
}
