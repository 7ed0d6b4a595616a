// Particles that are held: their weights and the nodes' masses are made once.
#include <tamis/tamis.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

long evaluations = 0;

/// Linear functions that count how often they are evaluated.
struct counted {
    static constexpr int support = 2;
    static constexpr double shift = 0;
    static constexpr bool constant_slope = true;
    template <class T> axis_weights<T, 2> on_axis(const T& r) const {
        ++evaluations;
        return {{T(1) - r, r}, {T(-1), T(1)}};
    }
};

template <class Motion> long evaluations_in_ten_steps() {
    const auto ends = fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, counted{}, flip{}, ends, Motion{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    for (auto p : bar) p[symbols::v][0] = 0.01 * (1 - p[symbols::x][0]);
    mpm.step(bodies(bar), 1e-3);
    const long before = evaluations;
    for (int k = 0; k < 10; ++k) mpm.step(bodies(bar), 1e-3);
    return evaluations - before;
}

}  // namespace

TEST_CASE("a step of held particles evaluates no weight") {
    CHECK(evaluations_in_ten_steps<held>() == 0);
    CHECK(evaluations_in_ten_steps<moving>() > 0);
}

TEST_CASE("a held body notices what the user changed between steps") {
    using namespace symbols;
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, pic{}, held{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    for (auto p : bar) p[v][0] = 1;
    mpm.step(bodies(bar), 1e-3);
    // Node masses follow the particles' when those are opened to changes: a uniform velocity stays uniform.
    for (auto p : bar) p[m] *= 1 + p[x][0];
    mpm.step(bodies(bar), 1e-3);
    for (const auto p : std::as_const(bar)) CHECK(std::abs(p[v][0] - 1) < 1e-14);
}
