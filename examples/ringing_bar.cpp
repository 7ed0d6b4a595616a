// A bar with fixed ends rings in its first mode: v = 0.01 sin(pi x) cos(pi t).
#include <tamis/tamis.hpp>

#include <cstdio>
#include <numbers>

int main() {
    using namespace tamis;
    const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};

    solver mpm{uniform_grid{{0.}, {1.}, 1. / 50}, linear{}, fmpm<2>{}, usl_minus{}, ends};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    set_velocity_of(bar, [](const auto& at) { return 0.01 * std::sin(std::numbers::pi * at[0]); });

    integrate(mpm, bodies(bar), {0, 2}, courant{0.1}, every(100, [&](double t) {
                  std::printf("%6.3f s  kinetic %.6e J  elastic %.6e J\n", t, kinetic_energy(bar), elastic_energy(bar));
              }));
}
