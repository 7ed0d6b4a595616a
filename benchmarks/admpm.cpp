// ADMPM's six benchmark runs (a bar, left end fixed, right end at 0.01 sin 10t) beside the same runs by hand: the step
// alone, and with the tables of particles and nodes that ADMPM records.
//
//     admpm           a tenth of the steps
//     admpm --full    all of them
//     admpm --error   to ADMPM's own error by other orders, at the largest Courant number that gives it: error against
//     time
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>

#include "by_hand_bar.hpp"

namespace {

using namespace tamis;

struct driven_ends {
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    template <class Point> Point velocity(const Point& at, auto t) const {
        return Point::Constant(at[0] <= 0 ? 0.0 : 0.01 * std::sin(10 * t));
    }
};

/// Velocities of the particles at the end, in the order of their places. A cell more than the bar has: its driven end
/// moves to and fro, and particles with it.
template <class Motion>
std::vector<double> run_library(const by_hand::bar_run& run, const std::filesystem::path& folder, Motion motion) {
    const double h = 1. / (run.nodes - 1);
    solver mpm{uniform_grid{{0.}, {Motion::moves ? 1 + h : 1.}, h}, linear{}, flip{}, euler{}, driven_ends{}, motion};
    const auto inside = [](const auto& at) { return at[0] < 1; };
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, inside, per_cell{run.per_cell});
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

double median(std::vector<double> of) {
    std::nth_element(of.begin(), of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2), of.end());
    return of[of.size() / 2];
}

constexpr by_hand::bar_run sizes[] = {{51, 2, 3. / 300000, 300000, 300, true},
                                      {101, 2, 6. / 600000, 600000, 3000, true},
                                      {201, 4, 10. / 1000000, 1000000, 5000, true}};
by_hand::bar_run run_of(int r, bool full) {
    by_hand::bar_run run = sizes[r % 3];
    run.moving = r < 3;
    if (!full) run.steps /= 10;
    return run;
}
std::string name_of(int r) {
    char name[64];
    std::snprintf(name, sizeof name, "%d: %d nodes, %d per cell, %s", r + 1, sizes[r % 3].nodes, sizes[r % 3].per_cell,
                  r < 3 ? "moving" : "held");
    return name;
}
double seconds_of(const auto& work) {
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void compare_times(bool full) {
    const auto folder = std::filesystem::temp_directory_path() / "tamis_admpm";
    std::printf("%-34s %12s %10s %10s %7s %10s %10s %7s %10s\n", "run", "steps/s", "ns/p/step", "by hand", "ratio",
                "+ tables", "by hand", "ratio", "max |dv|");
    for (int r = 0; r < 6; ++r) {
        const by_hand::bar_run run = run_of(r, full);
        std::vector<double> times[4], library, hand;
        for (int repeat = 0; repeat < (full ? 3 : 5); ++repeat)
            for (int k = 0; k < 4; ++k) {
                const std::filesystem::path to = k < 2 ? std::filesystem::path{} : folder;
                std::filesystem::remove_all(folder);
                times[k].push_back(seconds_of([&] {
                    if (k % 2 == 0)
                        library = run_library(run, to);
                    else
                        hand = by_hand::run_bar(run, to);
                }));
            }
        std::filesystem::remove_all(folder);
        double difference = 0;
        for (std::size_t p = 0; p < hand.size(); ++p) difference = std::max(difference, std::abs(hand[p] - library[p]));
        const double updates = static_cast<double>(run.steps) * static_cast<double>(hand.size());
        double ns[4];
        for (int k = 0; k < 4; ++k) ns[k] = median(times[k]) * 1e9 / updates;
        std::printf("%-34s %12.0f %10.2f %10.2f %7.2f %10.2f %10.2f %7.2f %10.1e\n", name_of(r).c_str(),
                    static_cast<double>(run.steps) / median(times[0]), ns[0], ns[1], ns[0] / ns[1], ns[2], ns[3],
                    ns[2] / ns[3], difference);
        std::fflush(stdout);
    }
}

/// Velocity of the bar: waves that the driven end sends out, and their images.
double exact_velocity(double x, double t) {
    const auto g = [](double s) { return s > 0 ? std::sin(10 * s) : 0.0; };
    double v = 0;
    for (double end = 1; end - x < t; end += 2) v += g(t - (end - x)) - g(t - (end + x));
    return 0.01 * v;
}
struct accuracy {
    double error, seconds;
    long steps;
};
/// Error of the particles' velocities over the amplitude, root mean square over the particles and the last fifth of the
/// run, and what the run took.
template <class Order, class Motion>
accuracy accuracy_of(const by_hand::bar_run& run, long steps, Order order, Motion motion) {
    const double h = 1. / (run.nodes - 1), end = run.dt * static_cast<double>(run.steps);
    accuracy result{0, 1e30, steps};
    // Once to look, then for the time.
    const bool is_short = steps < 100000;
    for (int repeat = 0; repeat < (is_short ? 4 : 2); ++repeat) {
        solver mpm{uniform_grid{{0.}, {Motion::moves ? 1 + h : 1.}, h}, linear{}, flip{}, order, driven_ends{}, motion};
        auto bar = mpm.make_body(
            linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] < 1; }, per_cell{run.per_cell});
        if (repeat > 0) {
            result.seconds = std::min(result.seconds, seconds_of([&] {
                                          integrate(mpm, bodies(bar), {0, end}, fixed_steps{steps});
                                      }));
            continue;
        }
        double sum = 0, count = 0;
        integrate(mpm, bodies(bar), {0, end}, fixed_steps{steps},
                  every(std::max(1L, steps / 500), [&](const progress_state& now) {
                      if (now.time < 0.8 * end) return;
                      for (const auto p : std::as_const(bar)) {
                          const double miss = p[symbols::v][0] - exact_velocity(p[symbols::x][0], now.time);
                          sum += miss * miss;
                          ++count;
                      }
                  }));
        result.error = std::sqrt(sum / count) / 0.01;
    }
    return result;
}
/// The fewest steps, by Courant numbers a factor of 0.8 apart, with an error of at most `wanted`.
template <class Order, class Motion>
accuracy cheapest(const by_hand::bar_run& run, double wanted, Order order, Motion motion) {
    const double end = run.dt * static_cast<double>(run.steps), least = end * (run.nodes - 1);
    for (double number = 0.9; number * static_cast<double>(run.steps) > least; number *= 0.8) {
        const auto steps = static_cast<long>(std::ceil(least / number));
        try {
            const accuracy found = accuracy_of(run, steps, order, motion);
            if (found.error <= wanted) return found;
        } catch (const error&) {
            // Too long a step: unstable.
        }
    }
    return {NAN, NAN, 0};
}
template <class Motion> void compare_errors(int r, Motion motion) {
    const by_hand::bar_run run = run_of(r, true);
    const double end = run.dt * static_cast<double>(run.steps);
    const auto courant_number = [&](long steps) { return end * (run.nodes - 1) / static_cast<double>(steps); };
    const accuracy admpm = accuracy_of(run, run.steps, euler{}, motion);
    std::printf("%-34s %-8s %9.2e %9.2e %9ld %9.2e %9s\n", name_of(r).c_str(), "euler", admpm.error,
                courant_number(admpm.steps), admpm.steps, admpm.seconds, "1");
    const auto other = [&](auto order) {
        const accuracy found = cheapest(run, admpm.error, order, motion);
        std::printf("%-34s %-8s %9.2e %9.2e %9ld %9.2e %9.0f\n", "", std::string(order.name).c_str(), found.error,
                    courant_number(found.steps), found.steps, found.seconds, admpm.seconds / found.seconds);
        std::fflush(stdout);
    };
    other(usl_minus{});
    other(usavg_minus{});
}

}  // namespace

int main(int argc, char** argv) {
    const std::string option = argc == 2 ? argv[1] : "";
    if (argc > 2 || (argc == 2 && option != "--full" && option != "--error")) {
        std::fprintf(stderr, "usage: admpm [--full | --error]\n");
        return 2;
    }
    if (option != "--error") {
        compare_times(option == "--full");
        return 0;
    }
    std::printf("%-34s %-8s %9s %9s %9s %9s %9s\n", "run", "order", "error", "Courant", "steps", "seconds", "speed-up");
    for (int r = 0; r < 3; ++r) compare_errors(r, moving{});
    for (int r = 3; r < 6; ++r) compare_errors(r, held{});
}
