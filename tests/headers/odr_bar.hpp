#pragma once
#include <tamis/tamis.hpp>

/// The same instantiation in both translation units: the linker must find one definition of each part.
inline double momentum_of_bar() {
    using namespace tamis;
    using namespace tamis::symbols;
    solver mpm{uniform_grid{{0.}, {1.}, 1. / 8}, linear{}, flip{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .poisson = 0, .density = 1}, everywhere, per_cell{2});
    for (auto p : bar) p[v][0] = 0.01;
    for (int k = 0; k < 4; ++k) mpm.step(bodies(bar), 0.01);
    double sum = 0;
    for (auto p : bar) sum += p[m] * p[v][0];
    return sum;
}
