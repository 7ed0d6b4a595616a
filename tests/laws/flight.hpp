#pragma once
#include "laws/composition.hpp"

namespace laws {

/// A body that flies without force stays as it is: velocities are equal and constant, there is no stress, and after a
/// flight over many cells every particle is where its velocity takes it.
template <int D, class Composed> void flight(const Composed& composed) {
    CAPTURE(D, composed.name());
    auto mpm = composed.on(box<D>(16, 8));
    auto block =
        block_in(mpm, [](const place<D>& at) { return (at.array() > 0.05).all() && (at.array() < 0.8).all(); });
    place<D> speed;
    for (int d = 0; d < D; ++d) speed[d] = 1 - 0.7 * d;
    for (auto p : block) p[symbols::v] = speed;
    // No particle comes to within round-off of a node. There, tents give a node no mass but a finite slope, and make
    // large accelerations of round-off in the stress.
    const double dt = 0.0161803;
    const int steps = 100;
    for (int step = 0; step < steps; ++step) {
        if (step == 30)
            for (int d = 1; d < D; ++d) {
                speed[d] = -0.1 * speed[d];
                for (auto p : block) p[symbols::v][d] = speed[d];
            }
        mpm.step(bodies(block), dt);
    }
    CHECK(mpm.crossings() > 4 * block.size());
    place<D> way;
    for (int d = 0; d < D; ++d) way[d] = steps * dt * (1 - 0.7 * d) * (d == 0 ? 1 : 0.3 - 0.1 * 0.7);
    double velocity = 0, position = 0, stress = 0;
    for (const auto p : std::as_const(block)) {
        velocity = std::max(velocity, (p[symbols::v] - speed).norm());
        position = std::max(position, (p[symbols::x] - p[x0] - way).norm());
        stress = std::max(stress, p[symbols::sigma].norm());
    }
    CHECK(velocity < 1e-13);
    CHECK(position < 1e-13);
    CHECK(stress < 1e-12);
}

}  // namespace laws
