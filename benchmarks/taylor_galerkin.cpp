// Critical Courant numbers of the two-step Taylor-Galerkin scheme, measured beside those of theory: the tables of
// docs/taylor-galerkin.md.
#include "../examples/support/amplification.hpp"

#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <cstdio>

namespace {

using namespace tamis;

template <class Shape> double measured(const Shape& shape, int cells, int particles, int k, bool periodic) {
    uniform_grid<1> grid{{0.}, {1.}, 1. / cells};
    if (periodic) grid = grid.wrapped(0);
    const auto zero = [](double) { return 0; };
    const conservation::ends open{conservation::inflow{zero}, conservation::outflow{}};
    taylor_galerkin scheme{grid,  conservation::advection<>{{1.}}, per_cell{particles},
                           shape, full_mass<dynamic>{k},           open};
    // Where there are ends eigenvalues may fall together, and round-off moves them.
    return amplification::critical_courant(scheme, periodic ? 1e-11 : 1e-7);
}

}  // namespace

int main() {
    std::printf(
        "| particles per cell | k | theory, 64 cells | measured | theory, long waves |\n|---|---|---|---|---|\n");
    for (const int n : {2, 3, 4})
        for (const int k : {1, 2, 3, 4, 8, 16})
            std::printf("| %d | %d | %.4f | %.4f | %.4f |\n", n, k, amplification::critical_courant_of_theory(n, k, 64),
                        measured(linear{}, 64, n, k, true), k == 1 ? 1. : std::sqrt((n * n - 1) / 3.) / n);
    std::printf(
        "\n| k | linear, open | quadratic, periodic | open | cubic, periodic | open |\n|---|---|---|---|---|---|\n");
    for (const int k : {1, 2, 3, 4, 8, 16})
        std::printf("| %d | %.4f | %.4f | %.4f | %.4f | %.4f |\n", k, measured(linear{}, 32, 2, k, false),
                    measured(quadratic_spline{}, 32, 2, k, true), measured(quadratic_spline{}, 32, 2, k, false),
                    measured(cubic_spline{}, 32, 2, k, true), measured(cubic_spline{}, 32, 2, k, false));
}
