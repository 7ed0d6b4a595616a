// Peak memory of a process that makes a body and steps it, over the size of the fields of its particles and nodes.
#include <tamis/tamis.hpp>

#include <cstdio>
#include <random>
#include <vector>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "block.hpp"

namespace {

using namespace tamis;
using namespace tamis::symbols;
using place = point<3, double>;

double peak_in_mb() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_maxrss) / 1024;
}

/// Steps, and tells.
template <class Problem> void run(const char* name, Problem problem, int steps) {
    const double made = peak_in_mb();
    for (int n = 0; n < steps; ++n) problem.step();
    using body_type = std::decay_t<decltype(*problem.body)>;
    const double particles = static_cast<double>(problem.particles()), h = problem.mpm->grid().spacing();
    double volume = 0;
    for (const auto p : std::as_const(*problem.body)) volume += p[V];
    const double nodes = volume / (h * h * h);
    const double fields = (particles * static_cast<double>(body_type::bytes_per_particle()) +
                           nodes * static_cast<double>(problem.mpm->bytes_per_node())) /
                          (1 << 20);
    std::printf("%-44s %10.0f %10.0f %8.2f %8.2f\n", name, particles, fields, made / fields, peak_in_mb() / fields);
    std::fflush(stdout);
}

void in_place() { run("3D/quadratic/flip", elastic_block<3, double>(108, quadratic_spline{}, flip{}), 3); }

/// Particles anywhere in their cells, of which three in ten go to another in every step.
void crossing() {
    constexpr int cells = 63;
    const double h = 1. / 128, dt = 1e-4 * h;
    using solver_type = solver<uniform_grid<3, double>, quadratic_spline, flip, usl_minus>;
    auto mpm = std::make_unique<solver_type>(uniform_grid{{0., 0., 0.}, {1., 1., 1.}, h}, quadratic_spline{}, flip{},
                                             usl_minus{});
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<place> places;
    for (int p = 0; p < 8 * cells * cells * cells; ++p)
        places.push_back((place(any(random), any(random), any(random)) * cells + place::Constant(16)) * h);
    const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};
    using body_type = decltype(mpm->make_body_at(law, places, h * h * h / 8));
    auto body = std::make_unique<body_type>(mpm->make_body_at(law, places, h * h * h / 8));
    std::vector<place>().swap(places);
    for (auto p : *body) p[v] = place::Constant(h / 9 / dt);
    run("3D/quadratic/flip/crossing 30 %", stepped<solver_type, body_type>{std::move(mpm), std::move(body), dt}, 40);
}

}  // namespace

int main() {
    std::printf("%-44s %10s %10s %8s %8s\n", "", "particles", "fields, MB", "made", "peak");
    std::fflush(stdout);
    // In processes of their own: a peak is for life.
    for (const auto one : {in_place, crossing}) {
        const pid_t child = fork();
        if (child == 0) {
            one();
            _exit(0);
        }
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0) return 1;
    }
}
