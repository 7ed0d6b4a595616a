#pragma once
#include <tamis/shape/linear.hpp>
#include <tamis/run/critical_rows.hpp>
#include <tamis/stability/lattice.hpp>

#include <numbers>

namespace tamis::stability {

/// Courant numbers c dt/h up to which nothing grows, in one dimension, at the worst place of the particles in their
/// cells.
struct critical_pair {
    /// In an endless body, and the place of particles where it is smallest.
    double inner, worst_offset;
    /// In a bar with free ends, and the place of its end where it is smallest.
    double free_end, worst_free_offset;
};

/// What counts as growth, per step.
inline constexpr double growth = 3e-5;
/// Numbers above it are not looked for.
inline constexpr double most_courant = 2;

/// Do the numbers at free ends fall to 0 with the mass of the lightest node? Linear functions have a slope of 1/h
/// however small they are: USL- and USAVG- strain a particle by the velocity that its own force gave a node of hardly
/// any mass.
template <class Shape, class Order> inline constexpr bool falls_with_mass =
    std::same_as<Shape, linear>&& Order::after > 0 && !Order::remap;

/// How many cells a step carries a disturbance.
template <class Shape> constexpr int reach_of(int k) { return (k < 1 ? 1 : k) * (Shape::support - 1) + 3; }

/// The critical number of an endless body whose particles sit at one place in their cells.
template <class... Policies>
double critical_inner(int per_cell, double offset, int reach, double most, const Policies&... policies) {
    const lattice_step<1> step(lattice<1>{per_cell, offset}, reach, policies...);
    constexpr int waves = 16;
    for (int n = waves; n > 0; --n) {
        const auto wave = step.of_wave({std::numbers::pi * n / waves});
        most = first_unstable(most, 0.05, [&](double c) { return spectral_radius_of(wave, c) <= 1 + growth; });
    }
    return most;
}

/// The critical numbers of a composition. `k`: order of the update, 0 for FLIP.
template <class Shape, class Update, class Order>
critical_pair critical_numbers(int per_cell, int k, const Shape& shape, const Update& update, const Order& order) {
    critical_pair found{most_courant, 0, most_courant, 0};
    // To half a particle's distance: what is beyond is a mirror image, or the same.
    for (int place = 0; place <= 10; ++place) {
        const double offset = place / 20. / per_cell;
        const double critical = critical_inner(per_cell, offset, reach_of<Shape>(k), found.inner, shape, update, order);
        if (critical < found.inner) found.inner = critical, found.worst_offset = offset;
    }
    const auto at_free_end = [&](double offset) {
        constexpr int cells = 6;
        std::vector<point<1, double>> places;
        for (int p = 0; p < cells * per_cell; ++p)
            places.push_back(point<1, double>(4 + offset + (p + 0.5) / per_cell));
        using matrix = step_matrix<Eigen::MatrixXd>;
        std::array<Eigen::MatrixXd, matrix::samples> at;
        for (int s = 0; s < matrix::samples; ++s)
            at[static_cast<std::size_t>(s)] = responses<1>(places, 1. / per_cell, cells + 8, 0, 0, cells * per_cell,
                                                           matrix::sample(s), shape, update, order);
        const matrix step(at);
        const auto is_stable = [&](double c) { return spectral_radius_of(step, c) <= 1 + growth; };
        const double critical = first_unstable(found.free_end, found.free_end / 20, is_stable);
        if (critical < found.free_end) found.free_end = critical, found.worst_free_offset = offset;
    };
    found.free_end = found.inner;
    // The last particle beyond a node, by a weight of the node's share of mass.
    const auto light = [&](double share) { return 0.5 / per_cell + share * per_cell; };
    if constexpr (falls_with_mass<Shape, Order>)
        at_free_end(light(tamis::detail::critical_share));
    else {
        at_free_end(light(1e-4));
        for (int place = 0; place < 20; ++place) at_free_end(place / 20.);
    }
    return found;
}

}  // namespace tamis::stability
