#pragma once
#include <algorithm>

#include "laws/composition.hpp"

namespace laws {

template <class Body> place<Body::dim> momentum_of(const Body& block) {
    place<Body::dim> sum = place<Body::dim>::Zero();
    for (const auto p : block) sum += p[symbols::m] * p[symbols::v];
    return sum;
}
template <class Body> std::vector<double> masses_of(const Body& block) {
    std::vector<double> all;
    for (const auto p : block) all.push_back(p[symbols::m]);
    std::sort(all.begin(), all.end());
    return all;
}

/// No particle's mass changes, and the momentum of all changes by the reactions of the walls and by gravity, in every
/// step. The walls move; the body is stirred, flies against one of them, and its cells are not all full.
template <int D, class Composed> void balance(const Composed& composed) {
    CAPTURE(D, composed.name());
    const auto grid = box<D>(9, 6);
    const walls<D> moving_walls{
        [&](const place<D>& at) { return at[0] < grid.lower()[0] + 0.3 || at[D - 1] <= grid.lower()[D - 1]; },
        [](const place<D>& at, double t) { return place<D>((at * std::cos(9 * t)).eval()); }};
    place<D> g;
    for (int d = 0; d < D; ++d) g[d] = 3 - 4 * d;
    auto mpm = composed.on(grid, moving_walls, g);
    auto block = block_in(mpm, [&](const place<D>& at) {
        return (at.array() > -0.17).all() && (at.array() < (D == 1 ? 1.2 : 0.8)).all() && at.sum() < 1;
    });
    stir(block, 0.5, 0.4);
    if (composed.moves)
        for (auto p : block) p[symbols::v][0] -= 1.4;
    const auto masses = masses_of(block);
    double mass = 0;
    for (const double m : masses) mass += m;

    const double dt = 0.01;
    place<D> before = momentum_of(block);
    for (int step = 0; step < 12; ++step) {
        CAPTURE(step);
        mpm.step(bodies(block), dt);
        place<D> impulse = mass * g;
        double scale = impulse.norm();
        for (const auto& node : mpm.reactions()) {
            impulse += node.reaction;
            scale += node.reaction.norm();
        }
        const place<D> after = momentum_of(block);
        CHECK((after - before - dt * impulse).norm() < 1e-14 * (after.norm() + dt * scale));
        CHECK(scale > 1);
        before = after;
    }
    CHECK(masses_of(block) == masses);
    CHECK((mpm.crossings() > 0) == composed.moves);
}

}  // namespace laws
