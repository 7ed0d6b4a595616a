// What a step costs follows the body, not the box that it is in.
#include <tamis/tamis.hpp>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "catch.hpp"

#if defined(__unix__)
#include <sys/resource.h>
#endif

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<3, double>;

/// A block of 8 x 8 x 8 cells that drifts and deforms, near the lower corner of a box; its particles in order.
std::vector<std::array<double, 6>> drifting(int cells_of_box) {
    const double h = 1. / 1024, side = h * cells_of_box;
    solver mpm{uniform_grid{{0., 0., 0.}, {side, side, side}, h}, quadratic_spline{}, fmpm<2>{}};
    std::vector<place> places;
    for (int k = 0; k < 16; ++k)
        for (int j = 0; j < 16; ++j)
            for (int i = 0; i < 16; ++i) places.emplace_back(place(i + 8.5, j + 8.5, k + 8.5) * (h / 2));
    auto block = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0.3, .density = 1}, places, h * h * h / 8);
    set_velocity_of(block, [](const place& at) { return place(0.3 - 20 * at[1], 0.1 + 10 * at[2], 0.2); });
    for (int n = 0; n < 40; ++n) mpm.step(bodies(block), 0.2 * h);
    CHECK(mpm.crossings() > 1000);
    std::vector<std::array<double, 6>> all;
    for (const auto p : std::as_const(block)) {
        const place X = p[x], V = p[v];
        all.push_back({X[0], X[1], X[2], V[0], V[1], V[2]});
    }
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace

TEST_CASE("sparse: a body in a box of 1024^3 cells runs as in a small one, in proportion to the body") {
    const auto in_small = drifting(64);
#if defined(__unix__)
    const auto peak = [] {
        rusage used{};
        getrusage(RUSAGE_SELF, &used);
        return static_cast<double>(used.ru_maxrss) / 1024;
    };
    const double before = peak();
#endif
    const auto in_huge = drifting(1024);
    CHECK(in_huge == in_small);
#if defined(__unix__)
    // In MB; all nodes of the box would take 110 GB.
    CHECK(peak() - before < 64);
#endif
}

#if defined(__GLIBC__)
#include <malloc.h>
/// Is the heap a sanitizer's? Such tells nothing of itself. (g++ and clang say so in ways of their own.)
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TAMIS_TEST_SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define TAMIS_TEST_SANITIZED 1
#endif
#if defined(TAMIS_TEST_SANITIZED)
constexpr bool sanitizers_heap = true;
#else
constexpr bool sanitizers_heap = false;
#endif
TEST_CASE("sparse: particles that cross cells do not make the heap or the storage grow") {
    const double h = 1. / 64;
    solver mpm{uniform_grid{{0., 0., 0.}, {1., 1., 1.}, h}, quadratic_spline{}, flip{}};
    const auto inside = [&](const place& at) { return at.minCoeff() > 4 * h && at.maxCoeff() < 20 * h; };
    auto block = mpm.make_body(linear_elastic{.young = 1, .poisson = 0.3, .density = 1}, inside, per_cell{2});
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(0.2, 0.5);
    for (auto p : block) p[v] = place(any(random), any(random), any(random));
    struct {
        double heap, in_use;  // MB: what the allocator keeps, and what of it is used
        std::size_t slots;    // which are pages of their own
    } now;
    const auto step = [&](int count) {
        for (int n = 0; n < count; ++n) mpm.step(bodies(block), 0.2 * h);
        const auto heap = mallinfo2();
        now = {static_cast<double>(heap.arena + heap.hblkhd) / 1e6,
               static_cast<double>(heap.uordblks + heap.hblkhd) / 1e6, block.store().slots.size()};
    };
    step(40);
    const auto early = now;
    step(40);
    // By then the particles have spread over as many tiles as they ever will.
    const auto settled = now;
    const auto crossings = mpm.crossings();
    for (int n = 0; n < 4; ++n) {
        step(40);
        if (!sanitizers_heap) CHECK(now.in_use < 1.1 * settled.in_use);
        // Slots are sorted when they would be half as many again.
        CHECK(static_cast<double>(now.slots) < 1.6 * static_cast<double>(settled.slots));
        if (n < 2) CHECK(now.heap < 1.5 * early.heap + 8);
    }
    CHECK(mpm.crossings() > crossings + 500000);
}
#endif
