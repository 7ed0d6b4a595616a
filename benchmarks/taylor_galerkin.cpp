// Critical Courant numbers of the two-step Taylor-Galerkin scheme, measured beside those of theory: the tables of
// docs/taylor-galerkin.md.
#include "../examples/support/amplification.hpp"

#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include <complex>
#include <cstdio>

namespace {

using namespace tamis;

template <class Shape> auto scheme(const Shape& shape, int cells, int particles, int k) {
    return taylor_galerkin{uniform_grid{{0.}, {1.}, 1. / cells}.wrapped(0), conservation::advection<>{{1.}},
                           per_cell{particles}, shape, full_mass<dynamic>{k}};
}
/// Up to which nothing grows by more than `tolerance` a step.
template <class Shape> double measured(const Shape& shape, int cells, int particles, int k, double tolerance) {
    auto line = scheme(shape, cells, particles, k);
    return amplification::critical_courant(line, tolerance);
}
/// |g| - 1 of the longest wave.
double growth_of_longest(int cells, int k, double courant) {
    auto line = scheme(quadratic_spline{}, cells, 2, k);
    const Eigen::MatrixXd step = amplification::step_matrix(line, courant / cells);
    std::complex<double> g = 0;
    for (int i = 0; i < cells; ++i) g += step(i, 0) * std::polar(1., -2 * std::numbers::pi * i / cells);
    return std::abs(g) - 1;
}

}  // namespace

int main() {
    std::puts("| particles per cell | k | theory, 64 cells | measured | theory, long waves |\n|---|---|---|---|---|");
    for (const int n : {2, 3, 4})
        for (const int k : {1, 2, 3, 4, 8, 16})
            std::printf("| %d | %d | %.4f | %.4f | %.4f |\n", n, k, amplification::critical_courant_of_theory(n, k, 64),
                        measured(linear{}, 64, n, k, 1e-11), k == 1 ? 1. : std::sqrt((n * n - 1) / 3.) / n);
    std::puts(
        "\n| k | linear, 1e-4 | quadratic | cubic | linear, 1e-3 | quadratic | cubic |\n|---|---|---|---|---|---|---|");
    for (const int k : {1, 2, 3, 4, 8, 16}) {
        std::printf("| %d |", k);
        for (const double tolerance : {1e-4, 1e-3})
            std::printf(" %.3f | %.3f | %.3f |", measured(linear{}, 32, 2, k, tolerance),
                        measured(quadratic_spline{}, 32, 2, k, tolerance),
                        measured(cubic_spline{}, 32, 2, k, tolerance));
        std::puts("");
    }
    std::puts("\n| C | cells | growth of the longest wave, quadratic, k = 16 | C^4 theta^4/8 |\n|---|---|---|---|");
    for (const double courant : {0.1, 0.2})
        for (const int cells : {32, 64, 128})
            std::printf("| %.1f | %d | %.2e | %.2e |\n", courant, cells, growth_of_longest(cells, 16, courant),
                        std::pow(courant * 2 * std::numbers::pi / cells, 4) / 8);
}
