#include "odr.hpp"

#include "odr_stepped.hpp"

#include <cmath>
#include <cstdio>

// Steps and runs that odr_stepped.cpp has compiled.
double momentum_of_stepped() {
    using namespace tamis;
    stepped_solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, fmpm<2>{}};
    stepped_body bar = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] > 0.3 && at[0] < 0.5; },
        per_cell{2});
    for (auto p : bar) p[symbols::v][0] = 0.1;
    mpm.step(bodies(bar), 0.01);
    integrate(mpm, bodies(bar), {mpm.time(), 0.5}, courant{});
    return total_momentum(bar)[0];
}

int main() {
    const double a = momentum_a();
    const double b = momentum_b();
    const double c = momentum_of_stepped();
    std::printf("momentum of the bars: %.17g and %.17g, exactly 0.01, and %.17g, exactly 0.02\n", a, b, c);
    return a == b && std::abs(a - 0.01) < 1e-14 && std::abs(c - 0.02) < 1e-14 ? 0 : 1;
}
