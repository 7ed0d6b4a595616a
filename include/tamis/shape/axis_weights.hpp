#pragma once
#include <tamis/core/lanes.hpp>
#include <tamis/core/unroll.hpp>

#include <concepts>
#include <string_view>

namespace tamis {

/// Values of the N functions that reach a particle along one axis, and their slopes per cell side.
template <class T, int N> struct axis_weights {
    T w[N];   ///< Values.
    T dw[N];  ///< Slopes (per cell side).
};

/// A shape function of one axis; the library takes the tensor product over the axes.
/// `support`: how many nodes reach a particle along an axis. `shift`: 0 where cells of the bookkeeping start at nodes,
/// 0.5 where they are centred on nodes. `on_axis(r)`: the weights for a particle at place r in [0, 1] of its cell.
///
/// A shape whose functions depend on the particle has `on_particles`, the fields it reads, `on_axis(r, p, d)` for axis
/// d of particle p, and `undeformed()`, the shape for places where there is no particle.
template <class N>
concept ShapeFunction = requires(const N& shape) {
    { N::support } -> std::convertible_to<int>;
    { N::shift } -> std::convertible_to<double>;
}
&&(
    requires(const N& shape, double r) {
        { shape.on_axis(r) } -> std::same_as<axis_weights<double, N::support>>;
    } ||
    requires(const N& shape, double r) {
        typename N::on_particles;
        { shape.undeformed().on_axis(r) } -> std::same_as<axis_weights<double, N::support>>;
    });

namespace detail {

/// Nodes of the first cell that lie outside the box: their weight is folded onto the nodes inside.
template <class Shape> inline constexpr int ghosts = (Shape::support - 2 + static_cast<int>(2 * Shape::shift)) / 2;

/// Shapes that read particles.
template <class Shape> inline constexpr bool reads_particles = requires { typename Shape::on_particles; };
/// The functions for a place without a particle.
template <class Shape> TAMIS_INLINE const auto& functions_of_place(const Shape& shape) {
    if constexpr (reads_particles<Shape>)
        return shape.undeformed();
    else
        return shape;
}

/// The node whose weight is 1 less all others' and never small, where a shape says so (`pivot`); else -1. Sums then do
/// without it: S u = u_pivot + sum w_i (u_i - u_pivot), and a particle gives the pivot what it gives to all nodes less
/// what it gives to the others. A small weight must not be a pivot: its round-off is that of the sum.
template <class Shape> inline constexpr int pivot_of = -1;
template <class Shape>
requires requires { Shape::pivot; }
inline constexpr int pivot_of<Shape> = Shape::pivot;

/// Shapes whose slopes do not depend on the place in the cell need not store them.
template <class Shape> inline constexpr bool constant_slope = requires { requires Shape::constant_slope; };

}  // namespace detail
}  // namespace tamis
