// Taylor's impact test: a bar of 42CrMo4 steel, 32.4 mm long and 6.4 mm thick, hits a rigid wall at 287 m/s, on which
// it slides freely. Johnson and Cook's law; a quarter of the bar between two planes of symmetry. After 80 us finite
// elements of O. Pantale's DynELA (its manual, 3D; Abaqus in brackets) give: length 26.52 (26.55) mm, diameter of the
// foot 11.18 (11.22) mm, largest plastic strain 1.84 (1.84), where it is 597 (597) C. Exit code 1 outside 26.5 +- 0.3
// mm, 11.15 +- 0.25 mm or 1.8 +- 0.2.
#include "support/ranges.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

int main(int argc, char** argv) {
    using namespace tamis;
    using namespace tamis::symbols;
    using vec = point<3, double>;
    int cells = 4;
    CLI::App app{"Taylor's impact test: a steel bar hits a rigid wall."};
    app.add_option("--cells", cells, "Cells of the grid along the bar's radius")->check(whole_from(2, 40));
    CLI11_PARSE(app, argc, argv);

    const double radius = 3.2e-3, length = 32.4e-3, speed = 287, h = radius / cells;
    const johnson_cook steel{.young = 206.9e9,
                             .poisson = 0.3,
                             .density = 7830,
                             .yield = 806e6,
                             .hardening = 614e6,
                             .exponent = 0.168,
                             .rate_factor = 0.0089,
                             .reference_rate = 1,
                             .softening = 1.1,
                             .reference_temperature = 20,  // C
                             .melting_temperature = 1540,
                             .heat_capacity = 460,
                             .taylor_quinney = 0.9};
    const conditions held{slip{[](const auto& at) { return at[0] <= 0; }, vec(1, 0, 0)},
                          slip{[](const auto& at) { return at[1] <= 0; }, vec(0, 1, 0)},
                          slip{[](const auto& at) { return at[2] <= 0; }, vec(0, 0, 1)}};
    const double wide = h * std::ceil(2.2 * radius / h), high = h * std::ceil(length / h + 1);
    solver mpm{uniform_grid{{0., 0., 0.}, {wide, wide, high}, h}, held};
    const auto quarter = [&](const auto& at) {
        return at.minCoeff() > 0 && std::hypot(at[0], at[1]) < radius && at[2] < length;
    };
    auto bar = mpm.make_body(steel, quarter, per_cell{2});
    set_velocity_of(bar, [&](const auto&) { return vec(0, 0, -speed); });
    const double energy = kinetic_energy(bar);
    const auto clock = std::chrono::steady_clock::now();
    const long steps = integrate(mpm, bodies(bar), {0, 80e-6}, courant{});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - clock;

    // A particle reaches h/4 beyond its centre at the top, where nothing is deformed, and at the edge of the foot,
    // where the outermost ones are nearly as far apart along the radius as at first.
    double top = 0, along_x = 0, along_y = 0, strain = 0, hottest = 0, heat = 0;
    for (const auto p : std::as_const(bar)) {
        const auto at = p[x];
        top = std::max(top, at[2] + h / 4);
        if (at[2] < h / 2 && at[1] < h / 2) along_x = std::max(along_x, at[0]);
        if (at[2] < h / 2 && at[0] < h / 2) along_y = std::max(along_y, at[1]);
        strain = std::max(strain, p[field::plastic_strain{}]);
        hottest = std::max(hottest, p[field::temperature{}]);
        heat += p[m] * steel.heat_capacity * (p[field::temperature{}] - 20) / steel.taylor_quinney;
    }
    const double foot = along_x + along_y + h / 2;
    std::printf("%zu particles, %ld steps, %.1f s\n", bar.size(), steps, took.count());
    bool good = true;
    const auto compare = [&](const char* what, double found, double expected, double band) {
        std::printf("%s: %.3f, expected %.2f +- %.2f\n", what, found, expected, band);
        good = good && std::abs(found - expected) < band;
    };
    compare("length (mm)", 1e3 * top, 26.5, 0.3);
    compare("diameter of the foot (mm)", 1e3 * foot, 11.15, 0.25);
    compare("largest plastic strain", strain, 1.8, 0.2);
    std::printf("hottest: %.0f C\n", hottest);
    std::printf("energy: %.3f plastic, %.3f elastic, %.3f kinetic, of 1\n", heat / energy, elastic_energy(bar) / energy,
                kinetic_energy(bar) / energy);
    return good ? 0 : 1;
}
