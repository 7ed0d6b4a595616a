#pragma once
// Compositions of policies to put the laws to, and bodies for them. What differs from law to law (walls, gravity) is
// chosen when the test runs, so that all laws of a composition share one compiled step.
#include <tamis/tamis.hpp>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"

namespace laws {

using namespace tamis;

template <int D> using place = point<D, double>;
template <int D> using tensor = matrix<D, double>;

/// Nodes of a region move with a given velocity(at, t).
template <int D> using walls =
    prescribed<std::function<bool(const place<D>&)>, std::function<place<D>(const place<D>&, double)>>;

template <int D> walls<D> no_walls() {
    return {[](const place<D>&) { return false; }, [](const place<D>& at, double) { return at; }};
}

/// Where a particle was created; it goes along with the particle.
struct origin : vector_field {
    static constexpr std::string_view name = "origin";
};
inline constexpr origin x0;

/// The policies that a law is put to, besides walls and gravity.
template <class Shape, class Transfer, class Order, class Motion = moving> struct composed {
    Shape shape;
    Transfer transfer;
    Order order;
    Motion motion = {};

    static constexpr bool moves = Motion::moves;
    std::string name() const {
        std::string text;
        for (const std::string_view part : {Shape::name, Transfer::name, Order::name, Motion::name})
            text.append(part).append(" ");
        return text;
    }
    template <int D> using solver_type =
        solver<uniform_grid<D, double>, Shape, Transfer, Order, Motion, walls<D>, gravity<place<D>>>;
    template <int D> solver_type<D> on(const uniform_grid<D, double>& grid, const walls<D>& held = no_walls<D>(),
                                       const place<D>& g = place<D>::Zero()) const {
        return solver_type<D>(grid, shape, transfer, order, motion, held, gravity<place<D>>{g});
    }
};
template <class Shape, class Transfer, class Order> composed(Shape, Transfer, Order)
    -> composed<Shape, Transfer, Order>;
template <class Shape, class Transfer, class Order, class Motion> composed(Shape, Transfer, Order, Motion)
    -> composed<Shape, Transfer, Order, Motion>;

/// A box of n cells of side 1/4 per axis, with a corner that is no round number.
template <int D> uniform_grid<D, double> box(const int (&n)[D]) {
    constexpr double corner = -0.3, side = 0.25;
    double lower[D], upper[D];
    for (int d = 0; d < D; ++d) {
        lower[d] = corner;
        upper[d] = corner + side * n[d];
    }
    return {lower, upper, side};
}
/// Cells along x, and fewer along y and z.
template <int D> uniform_grid<D, double> box(int along, int across) {
    if constexpr (D == 1)
        return box<1>({along});
    else if constexpr (D == 2)
        return box<2>({along, across});
    else
        return box<3>({along, across, across});
}

inline linear_elastic rubber() { return {.young = 10, .poisson = 0.3, .density = 2}; }

/// Particles of a region, two per cell and axis.
template <class Solver, class Region> auto block_in(const Solver& mpm, const Region& region) {
    auto block = mpm.make_body(rubber(), region, per_cell{2}, fields<origin>{});
    for (auto p : block) p[x0] = p[symbols::x];
    return block;
}

/// Velocities and stresses of any size.
template <class Body> void stir(Body& block, double speed, double stress, unsigned seed = 7) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    constexpr int D = Body::dim;
    for (auto p : block) {
        for (int d = 0; d < D; ++d) p[symbols::v][d] = speed * number(random);
        for (int d = 0; d < D; ++d)
            for (int e = 0; e <= d; ++e) p[symbols::sigma](d, e) = stress * number(random);
    }
}

/// A velocity gradient without symmetry, per unit of time.
template <int D> tensor<D> some_gradient() {
    tensor<D> gradient;
    for (int d = 0; d < D; ++d)
        for (int e = 0; e < D; ++e) gradient(d, e) = 0.3 + 0.2 * d - 0.35 * e + (d == e ? 0.1 * d : 0.05 * e);
    return gradient;
}

/// Stress of a strain that grows at the rate of a velocity gradient.
template <int D> tensor<D> stress_of(const tensor<D>& gradient, double t) {
    const tensor<D> strain = (gradient + gradient.transpose()) * (t / 2);
    return rubber().at_strain(0, strain);
}

}  // namespace laws
