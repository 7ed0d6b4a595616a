// What one core of the machine can do: memory traffic of a triad over vectors far larger than its caches, and fused
// multiplications and additions in registers. Every other figure can be held against these two.
#include <tamis/core/lanes.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using number = tamis::native_lanes::type<double>;
constexpr int width = tamis::lane<number>::width;

template <class F> double best_seconds(F f) {
    double best = 1e300;
    for (int repeat = 0; repeat < 7; ++repeat) {
        const auto start = std::chrono::steady_clock::now();
        f();
        best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    return best;
}

double triad_bytes_per_second() {
    const std::size_t count = std::size_t(1) << 24;
    std::vector<double> a(count, 1.), b(count, 2.), c(count, 3.);
    const double seconds = best_seconds([&] {
        for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + 0.5 * c[k];
    });
    if (a[count / 2] != 3.5) std::puts("the triad is wrong");
    return 3 * 8 * static_cast<double>(count) / seconds;
}

double flops_per_second() {
    constexpr int chains = 12;
    constexpr long rounds = 4'000'000;
    number sums[chains];
    for (int k = 0; k < chains; ++k) sums[k] = number(1. + k);
    const number factor(0.999999), more(1e-6);
    const double seconds = best_seconds([&] {
        for (long round = 0; round < rounds; ++round)
            for (number& sum : sums) sum = sum * factor + more;
    });
    double out[width], total = 0;
    for (const number& sum : sums) {
        tamis::lane<number>::store(out, sum);
        total += out[0];
    }
    if (!(total > 0)) std::puts("the sums are wrong");
    return 2. * chains * width * static_cast<double>(rounds) / seconds;
}

}  // namespace

int main() {
    std::printf("%-44s %10.1f GB/s\n", "memory, triad", triad_bytes_per_second() * 1e-9);
    const std::string lanes = std::to_string(width) + (width == 1 ? " lane" : " lanes");
    std::printf("%-44s %10.1f GFlop/s\n", ("fused multiply-add, double, " + lanes).c_str(), flops_per_second() * 1e-9);
}
