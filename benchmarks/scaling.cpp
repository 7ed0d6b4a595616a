// The same steps by one thread and by all: wall time, for the processor time of threads adds up.
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

template <int Dim> void compare(const char* name, int n, int steps) {
    const int most = tamis::threads{}.count();
    auto alone = elastic_block<Dim, double>(n, tamis::quadratic_spline{}, tamis::flip{}, tamis::threads{1});
    auto all = elastic_block<Dim, double>(n, tamis::quadratic_spline{}, tamis::flip{}, tamis::threads{most});
    alone.step();
    all.step();
    std::vector<double> by_one, by_all, gain;
    for (int round = 0; round < 9; ++round) {
        by_one.push_back(nanoseconds(alone, steps));
        by_all.push_back(nanoseconds(all, steps));
        gain.push_back(by_one.back() / by_all.back());
    }
    std::printf("%-44s %10.2f %10.2f %8.2f\n", name, median(by_one), median(by_all), median(gain));
}

}  // namespace

int main() {
    std::printf("%-44s %10s %7d thr. %8s\n", "step, ns per particle and step", "1 thread", tamis::threads{}.count(),
                "gain");
    compare<2>("2D/quadratic/flip", 256, 20);
    compare<3>("3D/quadratic/flip", 40, 10);
}
