// A step takes no memory from the heap once the first has made its place.
#include <tamis/tamis.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

#include "catch.hpp"

namespace {

std::atomic<long> allocations{0};

void* allocate(std::size_t size) {
    ++allocations;
    if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
    throw std::bad_alloc();
}
void* allocate(std::size_t size, std::align_val_t align) {
    ++allocations;
    const auto to = static_cast<std::size_t>(align);
    if (void* p = std::aligned_alloc(to, (size + to - 1) / to * to)) return p;
    throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size == 0 ? 1 : size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(size == 0 ? 1 : size);
}
void* operator new(std::size_t size, std::align_val_t align) { return allocate(size, align); }
void* operator new[](std::size_t size, std::align_val_t align) { return allocate(size, align); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 1};

template <class Solver, class Body> long allocations_of_steps(Solver& mpm, Body& body, int steps) {
    mpm.step(bodies(body), 1e-3);
    const long before = allocations;
    for (int k = 0; k < steps; ++k) mpm.step(bodies(body), 1e-3);
    return allocations - before;
}

}  // namespace

TEST_CASE("allocation: they are counted here") {
    const long before = allocations;
    std::vector<double> some(10);
    std::vector<native_lanes::type<double>> lanes_of_them(10);
    CHECK(allocations - before == 2);
}

TEST_CASE("allocation: the steps of a held bar take no memory after the first") {
    const auto ends = prescribed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; },
                                 [](const auto& at, auto t) { return (at * std::sin(t)).eval(); }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.02}, linear{}, fmpm<2>{}, usavg_plus{}, held{}, ends};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    for (auto p : bar) p[v][0] = p[x][0];
    CHECK(allocations_of_steps(mpm, bar, 50) == 0);
}

TEST_CASE("allocation: the steps of a moving block in its cells take no memory after the first") {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.1},
               quadratic_spline{},
               flip{},
               usl_plus{},
               gravity{point<2, double>(0.01, 0)},
               slip{[](const auto& at) { return at[1] <= 0; }, point<2, double>(0, 1)}};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] < 1.2; }, per_cell{2});
    for (auto p : block) p[v] << 0.1, 0.05 * p[x][0];
    CHECK(allocations_of_steps(mpm, block, 50) == 0);
    CHECK(mpm.crossings() == 0);
}

TEST_CASE("allocation: sums over nodes take no memory after the first") {
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.02}, linear{}, adaptive_fmpm{1e-3, 8}, ends, kinetic_feedback{0, 1, 10}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    for (auto p : bar) p[v][0] = 0.01 * p[x][0];
    CHECK(allocations_of_steps(mpm, bar, 50) == 0);
    CHECK(mpm.load().alpha() > 0);
}

TEST_CASE("allocation: a block that goes from cell to cell takes memory now and then, not every step") {
    solver mpm{uniform_grid{{0., 0.}, {4., 1.}, 0.1}, quadratic_spline{}, flip{}};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.2 && at[0] < 1.2; }, per_cell{2});
    for (auto p : block) p[v][0] = 1;
    CHECK(allocations_of_steps(mpm, block, 1000) < 500);
    CHECK(mpm.crossings() > 1000);
}
