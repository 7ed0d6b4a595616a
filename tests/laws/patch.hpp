#pragma once
#include "laws/composition.hpp"

namespace laws {

/// Nodes whose functions a wall changes: those on the walls and, for splines, the next ones.
template <class Shape, int D> std::function<bool(const place<D>&)> walls_of(const uniform_grid<D, double>& grid) {
    const double width = grid.spacing() * (detail::ghosts<Shape> + 0.1);
    return [=](const place<D>& at) {
        return ((at - grid.lower()).array() < width).any() || ((grid.upper() - at).array() < width).any();
    };
}

/// The patch test. A linear velocity field, imposed at the walls, strains the body evenly: velocities stay, and stress
/// is the same everywhere, that of the strain rate times the time. Particles are placed evenly, for which the lumped
/// mass matrix makes no error in a linear field. Where they move it does from the second step on, so `steps` is 1 then.
template <int D, class Composed> void patch(const Composed& composed, int steps) {
    CAPTURE(D, composed.name(), steps);
    const auto grid = box<D>(7, 6);
    const tensor<D> gradient = some_gradient<D>();
    const auto linear_field = [=](const place<D>& at, double) { return place<D>(gradient * at); };
    auto mpm = composed.on(grid, {walls_of<decltype(composed.shape)>(grid), linear_field});
    auto block = block_in(mpm, everywhere);
    for (auto p : block) p[symbols::v] = gradient * p[symbols::x];
    const double dt = 0.01;
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), dt);
    const tensor<D> stress = stress_of<D>(gradient, steps * dt);
    double velocity = 0, position = 0, stresses = 0;
    for (const auto p : std::as_const(block)) {
        velocity = std::max(velocity, (p[symbols::v] - gradient * p[x0]).norm());
        stresses = std::max(stresses, (p[symbols::sigma] - stress).norm());
        const place<D> at = composed.moves ? place<D>(p[x0] + dt * gradient * p[x0]) : place<D>(p[x0]);
        position = std::max(position, (p[symbols::x] - at).norm());
    }
    CHECK(velocity < 1e-13);
    CHECK(position < 1e-14);
    CHECK(stresses < 1e-13 * steps);
}

/// Simple shear of moving particles stays exact where nothing is known yet of the ends that they come from and go to:
/// rows slide as a whole, and every row keeps the weight it has on the nodes.
template <int D, class Composed> void shear(const Composed& composed) {
    CAPTURE(D, composed.name());
    const auto grid = box<D>(120, 5);
    const double rate = 0.8, dt = 0.02;
    const int steps = 3;
    const auto sliding = [=](const place<D>& at) {
        place<D> u = place<D>::Zero();
        u[0] = rate * at[D - 1];
        return u;
    };
    const double width = grid.spacing() * (detail::ghosts<decltype(composed.shape)> + 0.1);
    // In 3D the planes across the shear's are held, too: functions folded at the walls are not even.
    const auto across = [=](const place<D>& at) {
        bool beside = false;
        for (int d = 1; d < D; ++d)
            beside = beside || at[d] - grid.lower()[d] < width || grid.upper()[d] - at[d] < width;
        return beside;
    };
    auto mpm = composed.on(grid, {across, [=](const place<D>& at, double) { return sliding(at); }});
    auto block = block_in(
        mpm, [&](const place<D>& at) { return at[0] > grid.lower()[0] + 0.5 && at[0] < grid.upper()[0] - 0.5; });
    for (auto p : block) p[symbols::v] = sliding(p[symbols::x]);
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), dt);
    tensor<D> gradient = tensor<D>::Zero();
    gradient(0, D - 1) = rate;
    const tensor<D> stress = stress_of<D>(gradient, steps * dt);
    const double middle = (grid.lower()[0] + grid.upper()[0]) / 2;
    double velocity = 0, position = 0, stresses = 0;
    int count = 0;
    for (const auto p : std::as_const(block)) {
        if (std::abs(p[x0][0] - middle) > grid.spacing()) continue;
        ++count;
        velocity = std::max(velocity, (p[symbols::v] - sliding(p[x0])).norm());
        position = std::max(position, (p[symbols::x] - p[x0] - steps * dt * sliding(p[x0])).norm());
        stresses = std::max(stresses, (p[symbols::sigma] - stress).norm());
    }
    CHECK(count >= 4 * 10);
    CHECK(velocity < 1e-14);
    CHECK(position < 1e-14);
    CHECK(stresses < 1e-13);
}

}  // namespace laws
