// The same steps by one thread and by all: wall time, for the processor time of threads adds up. Beside it, what the
// machine gives at best: as many blocks apart, each stepped by a thread of its own, at the same time.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
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
    const int most = tamis::threads{}.count();
    const auto block = [&](int count) {
        return elastic_block<Dim, double>(n, tamis::quadratic_spline{}, scheme, tamis::threads{count});
    };
    auto alone = block(1), all = block(most);
    std::vector<decltype(block(1))> apart;
    while (static_cast<int>(apart.size()) < most) apart.push_back(block(1));
    const int steps = std::max(4, static_cast<int>(5e6 / static_cast<double>(alone.particles())));
    std::vector<double> by_one, by_all, gain, at_best;
    for (int round = 0; round < 10; ++round) {
        const double one = nanoseconds(alone, steps), together = nanoseconds(all, steps);
        std::vector<double> each(apart.size());
        tamis::threads{most}.for_each(apart.size(), [&](std::size_t k) { each[k] = nanoseconds(apart[k], steps); });
        if (round == 0) continue;  // memory comes, caches and pages are filled
        by_one.push_back(one);
        by_all.push_back(together);
        gain.push_back(one / together);
        at_best.push_back(most * one / median(each));
    }
    std::printf("%-34s %10.2f %10.2f %8.2f %8.2f\n", name, median(by_one), median(by_all), median(gain),
                median(at_best));
}

}  // namespace

int main() {
    using namespace tamis;
    std::printf("%-34s %10s %5d thr. %8s %8s\n", "step, ns per particle and step", "1 thread", threads{}.count(),
                "gain", "at best");
    compare<2>("2D/quadratic/flip/256 cells", 256, flip{});
    compare<2>("2D/quadratic/flip/512 cells", 512, flip{});
    compare<3>("3D/quadratic/flip/24 cells", 24, flip{});
    compare<3>("3D/quadratic/flip/40 cells", 40, flip{});
    compare<3>("3D/quadratic/flip/64 cells", 64, flip{});
    compare<3>("3D/quadratic/fmpm(2)/40 cells", 40, fmpm<2>{});
}
