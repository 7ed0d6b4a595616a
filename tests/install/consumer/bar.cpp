// A bar with fixed ends rings for a quarter of its period; its energy of motion has then gone into strain.
#include <tamis/tamis.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

#if defined(EIGEN_ALONE) && (TAMIS_VECTOR_BYTES > 0 || defined(_OPENMP))
#error "vectors and OpenMP were switched off, and one of them is used"
#endif

int main() {
    using namespace tamis;
    using namespace tamis::symbols;

    const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / 16}, linear{}, flip{}, usl_minus{},
               fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    for (auto p : bar) p[v][0] = 0.01 * std::sin(std::numbers::pi * p[x][0]);

    const auto energy = [&] {
        double sum = 0;
        for (auto p : bar) sum += p[m] * p[v].squaredNorm() / 2;
        return sum;
    };
    const double before = energy();
    integrate(mpm, bodies(bar), {0, 0.5}, courant{0.1});
    std::printf("energy of motion: %.3e at the start, %.3e after a quarter of the period\n", before, energy());
    return energy() < before / 20 ? 0 : 1;
}
