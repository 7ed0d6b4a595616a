// ADMPM's six benchmark runs (a bar, left end fixed, right end at 0.01 sin 10t) beside the same runs by hand: the step
// alone, and with the tables of particles and nodes that ADMPM records.
//
//     admpm           a tenth of the steps
//     admpm --full    all of them
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>

#include "by_hand_bar.hpp"

namespace {

using namespace tamis;

struct driven_ends {
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    template <class Point> Point velocity(const Point& at, auto t) const {
        return Point::Constant(at[0] <= 0 ? 0.0 : 0.01 * std::sin(10 * t));
    }
};

/// Velocities of the particles at the end by the place they started from, which storage keeps while none goes to another cell.
template <class Motion>
std::vector<double> run_library(const by_hand::bar_run& run, const std::filesystem::path& folder, Motion motion) {
    solver mpm{uniform_grid{{0.}, {1.}, 1. / (run.nodes - 1)}, linear{}, flip{}, euler{}, driven_ends{}, motion};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{run.per_cell});
    const interval span{0, run.dt * static_cast<double>(run.steps)};
    if (folder.empty())
        integrate(mpm, bodies(bar), span, fixed_steps{run.steps});
    else {
        csv_output tables(mpm, bodies(bar), folder);
        integrate(mpm, bodies(bar), span, fixed_steps{run.steps}, every(run.record_every, std::ref(tables)));
        tables.commit();
    }
    std::vector<std::pair<double, double>> all;
    for (const auto p : std::as_const(bar)) all.emplace_back(p[symbols::x][0], p[symbols::v][0]);
    std::sort(all.begin(), all.end());
    std::vector<double> velocities;
    for (const auto& [x, v] : all) velocities.push_back(v);
    return velocities;
}
std::vector<double> run_library(const by_hand::bar_run& run, const std::filesystem::path& folder) {
    return run.moving ? run_library(run, folder, moving{}) : run_library(run, folder, held{});
}

/// Particles in the order of their places, as the library's.
std::vector<double> in_order(const by_hand::bar_run& run, const std::vector<double>& by_slot) {
    std::vector<double> all;
    const auto cells = static_cast<std::size_t>(run.nodes - 1), slots = static_cast<std::size_t>(run.per_cell);
    for (std::size_t c = 0; c < cells; ++c)
        for (std::size_t s = 0; s < slots; ++s) all.push_back(by_slot[s * cells + c]);
    return all;
}

double median(std::vector<double> of) {
    std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
    return of[of.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    bool full = false;
    for (int k = 1; k < argc; ++k) {
        if (std::strcmp(argv[k], "--full") != 0) {
            std::fprintf(stderr, "usage: admpm [--full]\n");
            return 2;
        }
        full = true;
    }
    const int repeats = full ? 3 : 5;
    const by_hand::bar_run sizes[] = {{51, 2, 3. / 300000, 300000, 300, true},
                                      {101, 2, 6. / 600000, 600000, 3000, true},
                                      {201, 4, 10. / 1000000, 1000000, 5000, true}};
    const auto folder = std::filesystem::temp_directory_path() / "tamis_admpm";
    std::printf("%-34s %12s %10s %10s %7s %10s %10s %7s %10s\n", "run", "steps/s", "ns/p/step", "by hand", "ratio",
                "+ tables", "by hand", "ratio", "max |dv|");
    for (int r = 0; r < 6; ++r) {
        by_hand::bar_run run = sizes[r % 3];
        run.moving = r < 3;
        if (!full) run.steps /= 10;
        std::vector<double> times[4], library, hand;
        for (int repeat = 0; repeat < repeats; ++repeat)
            for (int k = 0; k < 4; ++k) {
                const std::filesystem::path to = k < 2 ? std::filesystem::path{} : folder;
                std::filesystem::remove_all(folder);
                const std::clock_t begin = std::clock();
                if (k % 2 == 0)
                    library = run_library(run, to);
                else
                    hand = by_hand::run_bar(run, to);
                times[k].push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
            }
        std::filesystem::remove_all(folder);
        hand = in_order(run, hand);
        double difference = 0;
        for (std::size_t p = 0; p < hand.size(); ++p) difference = std::max(difference, std::abs(hand[p] - library[p]));
        const double updates = static_cast<double>(run.steps) * static_cast<double>(hand.size());
        double ns[4];
        for (int k = 0; k < 4; ++k) ns[k] = median(times[k]) * 1e9 / updates;
        char name[64];
        std::snprintf(name, sizeof name, "%d: %d nodes, %d per cell, %s", r + 1, run.nodes, run.per_cell,
                      run.moving ? "moving" : "held");
        std::printf("%-34s %12.0f %10.2f %10.2f %7.2f %10.2f %10.2f %7.2f %10.1e\n", name,
                    static_cast<double>(run.steps) / median(times[0]), ns[0], ns[1], ns[0] / ns[1], ns[2], ns[3],
                    ns[2] / ns[3], difference);
        std::fflush(stdout);
    }
}
