#pragma once
#include <tamis/grid/lattice.hpp>
#include <tamis/engine/node_table.hpp>

namespace tamis::detail {

/// f(place, image) for the two storage places of each node that a wrapped axis has twice.
template <class S, class Shape, class F> void each_image(const lattice<S, Shape>& lattice, int axis, F f) {
    const int cells = lattice.grid().cells(axis);
    std::array<int, 3> end{1, 1, 1};
    for (int d = 0; d < S::dim; ++d) end[static_cast<std::size_t>(d)] = lattice.places_along(d);
    const auto a = static_cast<std::size_t>(axis);
    end[a] -= cells;
    std::array<int, 3> node;  // from -ghosts
    for (int k = 0; k < end[2]; ++k)
        for (int j = 0; j < end[1]; ++j)
            for (int i = 0; i < end[0]; ++i) {
                node = {i - ghosts<Shape>, j - ghosts<Shape>, k - ghosts<Shape>};
                const std::size_t place = lattice.node_place(node);
                node[a] += cells;
                f(place, lattice.node_place(node));
            }
}

/// Sums that particles left at the two places of a node are added up, and stand at both, along all wrapped axes.
template <class S, class Shape, class Nodes, class... F>
void wrap(const lattice<S, Shape>& lattice, const Nodes& nodes, fields<F...>) {
    for (int axis = 0; axis < S::dim; ++axis) {
        if (!lattice.grid().wraps(axis)) continue;
        const auto one = [&](auto tag) {
            using G = typename decltype(tag)::type;
            for (int c = 0; c < G::template components<S>; ++c) {
                each_image(lattice, axis, [&](std::size_t place, std::size_t image) {
                    auto& sum = nodes.template at<G>(place, c);
                    sum += nodes.template at<G>(image, c);
                    nodes.template at<G>(image, c) = sum;
                });
            }
        };
        (one(std::type_identity<F>{}), ...);
    }
}

/// Is an axis of the grid periodic?
template <class S, class Shape> bool any_axis_wraps(const lattice<S, Shape>& lattice) {
    bool any = false;
    for (int axis = 0; axis < S::dim; ++axis) any = any || lattice.grid().wraps(axis);
    return any;
}
/// Where one of a node's two places is in use, both are: `reached(place)` tells, `reach(place)` makes it so.
template <class S, class Shape, class Reached, class Reach>
void reach_images(const lattice<S, Shape>& lattice, const Reached& reached, const Reach& reach) {
    for (int axis = 0; axis < S::dim; ++axis)
        if (lattice.grid().wraps(axis))
            each_image(lattice, axis, [&](std::size_t place, std::size_t image) {
                if (!reached(place) && !reached(image)) return;
                reach(place);
                reach(image);
            });
}

}  // namespace tamis::detail
