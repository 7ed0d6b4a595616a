#pragma once
#include "laws/composition.hpp"

namespace laws {

/// What a position update adds to the fall of n^2/2 g dt^2 in n steps, in n/2 g dt^2. All velocities are equal, V_n =
/// n g dt, so S p/m = V and S v+ = V + g dt. Hence in step n, from n - 1,
///
///     FLIP, PIC, blends   X' - X = S v+ dt = n g dt^2                        X_n = n (n + 1)/2 g dt^2    ahead by one
///     FLIP(psi)           X' - X = (S v+ - psi g dt/2) dt                    X_n = n (n + 1 - psi)/2 g dt^2
///     XPIC(k), FMPM(k)    X' - X = (V + V')/2 dt = (n - 1/2) g dt^2          X_n = n^2/2 g dt^2          exact
inline double lead(const auto&) { return 1; }
inline double lead(const modified_flip& scheme) { return 1 - scheme.particle.psi; }
template <int K> double lead(const xpic<K>&) { return 0; }
template <int K> double lead(const fmpm<K>&) { return 0; }

/// A body that falls freely keeps its form: V = g t, and X as the update discretises the parabola.
template <int D, class Composed> void fall(const Composed& composed) {
    CAPTURE(D, composed.name());
    place<D> g;
    for (int d = 0; d < D; ++d) g[d] = d == 0 ? 2 : -0.4 * d;
    auto mpm = composed.on(box<D>(14, 8), no_walls<D>(), g);
    auto block = block_in(mpm, [](const place<D>& at) {
        bool inside = at[0] > 0.05 && at[0] < 0.8;
        for (int d = 1; d < D; ++d) inside = inside && at[d] > 0.8 && at[d] < 1.5;
        return inside;
    });
    const double dt = 0.0161803;
    const int steps = 90;
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), dt);
    const place<D> speed = g * (steps * dt);
    const place<D> way = g * (dt * dt / 2 * steps * (steps + lead(composed.transfer)));
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
