// The same steps by one thread and by all: wall time, for the processor time of threads adds up. Beside it, what the
// machine gives to as many blocks of the same size, each stepped apart by a thread of its own, at the same time.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <thread>
#include <vector>

#include "block.hpp"

namespace {

double nanoseconds(auto& problem, int steps) {
    const auto start = std::chrono::steady_clock::now();
    for (int n = 0; n < steps; ++n) problem.step();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() * 1e9 / steps /
           static_cast<double>(problem.particles());
}
double median(std::vector<double> all) {
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
    return all[all.size() / 2];
}

template <int Dim, class Scheme> void compare(const char* name, int n, const Scheme& scheme) {
    const tamis::threads every{};
    const auto most = static_cast<std::size_t>(every.count());
    const auto block = [&](int count) {
        return elastic_block<Dim, double>(n, tamis::quadratic_spline{}, scheme, tamis::threads{count});
    };
    auto alone = block(1), all = block(every.count());
    const auto bytes = alone.body->store().slots.size() * sizeof(alone.body->store().slots.front());
    // Each by the thread that steps it: so its memory is near to it.
    std::vector<std::optional<decltype(block(1))>> apart(most);
    const bool fits = static_cast<double>(most * bytes) < tamis::detail::memory_of_machine() / 4;
    if (fits) every.for_each(most, [&](std::size_t k) { apart[k].emplace(block(1)); });
    const int steps = std::max(4, static_cast<int>(5e6 / static_cast<double>(alone.particles())));
    std::vector<double> by_one, by_all, gain, of_apart;
    for (int round = 0; round < 10; ++round) {
        const double one = nanoseconds(alone, steps), together = nanoseconds(all, steps);
        std::vector<double> each(most);
        if (fits) every.for_each(most, [&](std::size_t k) { each[k] = nanoseconds(*apart[k], steps); });
        if (round == 0) continue;  // memory comes, caches and pages are filled
        by_one.push_back(one);
        by_all.push_back(together);
        gain.push_back(one / together);
        double sum = 0;
        for (const double it : each) sum += one / it;
        of_apart.push_back(sum);
    }
    std::printf("%-34s %10.2f %10.2f %8.2f ", name, median(by_one), median(by_all), median(gain));
    if (fits)
        std::printf("%8.2f\n", median(of_apart));
    else
        std::printf("%8s\n", "-");
}

/// Wall time by all threads over that by one, while as many other threads as there are processors keep those busy.
void compare_beside_others(const char* name, int n, int steps) {
    const auto block = [&](int count) {
        return elastic_block<2, double>(n, tamis::quadratic_spline{}, tamis::flip{}, tamis::threads{count});
    };
    const int most = tamis::threads{}.count();
    auto alone = block(1), all = block(most);
    std::atomic<bool> over{false};
    std::vector<std::thread> others;
    for (int k = 0; k < most; ++k)
        others.emplace_back([&over] {
            while (!over.load(std::memory_order_relaxed)) {
            }
        });
    std::vector<double> ratio;
    for (int round = 0; round < 10; ++round) {
        const double one = nanoseconds(alone, steps);
        ratio.push_back(nanoseconds(all, steps) / one);
    }
    over = true;
    for (std::thread& one : others) one.join();
    std::printf("%-34s %10.2f\n", name, median(ratio));
}

}  // namespace

int main() {
    using namespace tamis;
    std::printf("%-34s %10s %5d thr. %8s %8s\n", "step, ns per particle and step", "1 thread", threads{}.count(),
                "gain", "apart");
    compare<2>("2D/quadratic/flip/256 cells", 256, flip{});
    compare<2>("2D/quadratic/flip/512 cells", 512, flip{});
    compare<3>("3D/quadratic/flip/24 cells", 24, flip{});
    compare<3>("3D/quadratic/flip/40 cells", 40, flip{});
    compare<3>("3D/quadratic/flip/64 cells", 64, flip{});
    compare<3>("3D/quadratic/fmpm(2)/40 cells", 40, fmpm<2>{});
    std::puts("time by all threads over that by one, while others keep all processors busy");
    compare_beside_others("2D/quadratic/flip/32 cells", 32, 1000);
    compare_beside_others("2D/quadratic/flip/256 cells", 256, 20);
}
