#pragma once
#include <algorithm>
#include <array>
#include <map>

#include "laws/composition.hpp"

namespace laws {

/// All that a particle has, by the place where it was created.
template <class Body> auto snapshot(const Body& block) {
    constexpr int D = Body::dim, components = Body::store_type::components;
    std::map<std::array<double, D>, std::array<double, components + D>> all;
    for (const auto p : block) {
        std::array<double, D> key;
        std::array<double, components + D> values;
        const double* first = block.store().lane_of(p.slot(), p.lane_index());
        for (int c = 0; c < components; ++c) values[std::size_t(c)] = first[c * p.W];
        for (int d = 0; d < D; ++d) {
            key[std::size_t(d)] = p[x0][d];
            values[std::size_t(components + d)] = p[symbols::x][d];
        }
        all[key] = values;
    }
    return all;
}

/// A stirred body that flies through a few cells, away from the walls.
template <int D, class Solver> auto stirred_block(const Solver& mpm) {
    auto block = block_in(mpm, [](const place<D>& at) {
        return (at.array() > 0.05).all() && (at.array() < 0.8).all() && at.sum() < 0.7 * D;
    });
    stir(block, 0.6, 0.5);
    for (auto p : block) p[symbols::v][0] += 1;
    return block;
}

/// A run may be stopped and taken up by another solver: it goes on as if nothing had been, bit for bit.
template <int D, class Composed> void taken_up(const Composed& composed) {
    CAPTURE(D, composed.name());
    const auto grid = box<D>(10, 6);
    const walls<D> swaying{[&](const place<D>& at) { return at[0] < 0.3; },
                           [](const place<D>& at, double t) { return place<D>((at * std::sin(9 * t)).eval()); }};
    place<D> g = place<D>::Constant(-0.5);
    const double dt = 1. / 64;
    const int steps = 12;
    auto whole = composed.on(grid, swaying, g);
    auto block = stirred_block<D>(whole);
    auto parted = block;
    for (int step = 0; step < steps; ++step) whole.step(bodies(block), dt);
    auto first = composed.on(grid, swaying, g), second = composed.on(grid, swaying, g);
    for (int step = 0; step < steps / 3; ++step) first.step(bodies(parted), dt);
    second.start_at(first.time());
    for (int step = steps / 3; step < steps; ++step) second.step(bodies(parted), dt);
    CHECK(second.time() == whole.time());
    CHECK(snapshot(parted) == snapshot(block));
}

/// Particles may be given in any order: nothing changes but the last digits.
template <int D, class Composed> void any_order(const Composed& composed) {
    CAPTURE(D, composed.name());
    const auto grid = box<D>(10, 6);
    auto mpm = composed.on(grid);
    const auto block = stirred_block<D>(mpm);
    const double volume = (*block.begin())[symbols::V];
    std::vector<place<D>> points;
    for (const auto p : block) points.push_back(p[symbols::x]);
    const auto body_at_points = [&] {
        auto body = mpm.make_body_at(rubber(), points, volume, fields<origin>{});
        for (auto p : body) {
            const place<D> at = p[symbols::x];
            p[x0] = at;
            for (int d = 0; d < D; ++d) {
                p[symbols::v][d] = std::sin(9 * at.sum() + d);
                for (int e = 0; e < D; ++e) p[symbols::sigma](d, e) = std::cos(7 * at[0] + d + e);
            }
        }
        return body;
    };
    auto ordered = body_at_points();
    std::shuffle(points.begin(), points.end(), std::mt19937(3));
    auto shuffled = body_at_points();
    for (auto* body : {&ordered, &shuffled}) {
        auto own = composed.on(grid);
        for (int step = 0; step < 8; ++step) own.step(bodies(*body), 1. / 64);
    }
    const auto one = snapshot(std::as_const(ordered)), other = snapshot(std::as_const(shuffled));
    REQUIRE(one.size() == other.size());
    double difference = 0;
    for (const auto& [key, values] : one) {
        const auto& others = other.at(key);
        for (std::size_t c = 0; c < values.size(); ++c)
            difference = std::max(difference, std::abs(values[c] - others[c]));
    }
    CHECK(difference < 1e-11);
}

}  // namespace laws
