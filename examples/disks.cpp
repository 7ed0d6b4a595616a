// Two elastic disks collide and part again, in plane strain (Nairn 2026): how much of their energy does a scheme lose?
// Much depends on where they meet: with the plane between them on nodes, as here, most is lost; a quarter of a cell
// beside them (the last line), FLIP loses an eighth of it. Tables of the particles at some times, particles_<step>.csv,
// are left in the folder disks_csv/ (of flip); a picture of them:
//     gnuplot -e "csv='disks_csv'; out='disks'" examples/plots/disks.gp
#include <tamis/tamis.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

using namespace tamis;

constexpr double radius = 0.01, gap = 0.001, after_impact = 0.186e-3;  // m, m, s

template <class Scheme>
void collide(const char* name, const char* published, const Scheme& scheme, double shift = 0, bool writes = false) {
    const neo_hookean law{.young = 1e9, .poisson = 0.33, .density = 1500};
    const double speed = 0.01 * law.wave_speed(2) / 2;  // of each

    // One velocity field, which is contact enough: on nodes that both disks reach they move as one.
    solver mpm{uniform_grid{{0., 0.}, {0.05, 0.024}, 0.0005}, ugimp{2}, scheme, usl_minus{}};
    const auto disk = [](double centre) {
        return [=](const auto& at) { return std::hypot(at[0] - centre, at[1] - 0.012) < radius; };
    };
    auto left = mpm.make_body(law, disk(0.025 + shift - gap / 2 - radius), per_cell{2});
    auto right = mpm.make_body(law, disk(0.025 + shift + gap / 2 + radius), per_cell{2});
    set_velocity_of(left, [&](const auto&) { return point<2, double>(speed, 0); });
    set_velocity_of(right, [&](const auto&) { return point<2, double>(-speed, 0); });

    const auto kinetic = [&] { return kinetic_energy(left) + kinetic_energy(right); };
    const auto elastic = [&] { return elastic_energy(left) + elastic_energy(right); };
    const double energy = kinetic(), impact = gap / (2 * speed);
    const interval span{0, impact + after_impact};
    const auto clock = std::chrono::steady_clock::now();
    long steps = 0;
    if (writes) {
        csv_output tables(mpm, bodies(left, right), "disks_csv");
        steps = integrate(mpm, bodies(left, right), span, courant{0.2}, every(200, std::ref(tables)));
        tables.commit();
    } else
        steps = integrate(mpm, bodies(left, right), span, courant{0.2});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - clock;
    std::printf("%-16s %8.3f %11s %12.3f %10.3f %7ld %9.1f\n", name, 100 * (1 - (kinetic() + elastic()) / energy),
                published, kinetic() / energy, elastic() / energy, steps, took.count());
}

int main() {
    std::puts("0.186 ms after impact; published: with CPDI functions (Nairn 2026); kinetic, elastic: shares\n");
    std::puts("scheme           loss (%)   published      kinetic    elastic   steps   seconds");
    collide("flip", "3.23", flip{}, 0, true);
    collide("fmpm<2>", "", fmpm<2>{});
    collide("fmpm<4>", "", fmpm<4>{});
    collide("fmpm<8>", "2.23", fmpm<8>{});
    collide("flip, moved", "", flip{}, 0.000125);
}
