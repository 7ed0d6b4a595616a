#pragma once

/// Scenes of two and three dimensions for the comparison with the reference: a block under gravity, with a step cut out
/// of its top on the right, wider than one tile of eight lanes. The last axis is up. Its bottom is fixed; its left
/// side, and in three dimensions front and back, slide along the walls; its right side is pushed to and fro; its top on
/// the left, and one row of the right side, slide along an inclined plane.

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "../support/compare.hpp"

namespace block {

inline constexpr double spacing = 0.1;
inline constexpr double young = 4;
inline constexpr double poisson = 0.3;
inline constexpr double density = 1.2;
inline constexpr int steps = 200;

/// Cells along the axes.
template <int D> inline constexpr std::array<int, static_cast<std::size_t>(D)> cells{};
template <> inline constexpr std::array<int, 2> cells<2>{10, 6};
template <> inline constexpr std::array<int, 3> cells<3>{9, 2, 3};

inline constexpr double lower = -0.2;  // along every axis
template <int D> double upper(int axis) { return lower + spacing * cells<D>[static_cast<std::size_t>(axis)]; }

/// Is a place within a quarter of a cell from the k-th plane of nodes across an axis?
template <int D> bool on(int axis, int k, const auto& at) {
    return std::abs(static_cast<double>(at[axis]) - (lower + spacing * k)) < spacing / 4;
}
template <int D> bool on_bottom(const auto& at) { return on<D>(D - 1, 0, at); }
template <int D> bool on_left(const auto& at) { return on<D>(0, 0, at); }
template <int D> bool on_right(const auto& at) { return on<D>(0, cells<D>[0], at) && !on_bottom<D>(at); }
template <int D> bool on_front_or_back(const auto& at) {
    return D == 3 && (on<D>(1, 0, at) || on<D>(1, cells<D>[1], at));
}
template <int D> bool on_incline(const auto& at) {
    const bool top = on<D>(D - 1, cells<D>[D - 1], at) && at[0] < lower + 3.75 * spacing;
    return top || (on_right<D>(at) && on<D>(D - 1, 2, at));
}

/// Velocity of the right side along the first axis (m/s).
inline double push(double t) { return -0.1 * std::sin(8 * t); }

template <int D> struct bottom {
    bool operator()(const auto& at) const { return on_bottom<D>(at); }
};
template <int D> struct left {
    bool operator()(const auto& at) const { return on_left<D>(at); }
};
template <int D> struct right {
    bool operator()(const auto& at) const { return on_right<D>(at); }
};
template <int D> struct front_and_back {
    bool operator()(const auto& at) const { return on_front_or_back<D>(at); }
};
template <int D> struct incline {
    bool operator()(const auto& at) const { return on_incline<D>(at); }
};
/// The second component is none of the condition's business, which holds along the first axis.
struct pushed {
    auto operator()(const auto& at, double t) const {
        auto speed = at;
        speed.setConstant(static_cast<typename std::decay_t<decltype(at)>::Scalar>(push(t)));
        return speed;
    }
};
template <int D> struct inside {
    bool operator()(const auto& at) const {
        return at[D - 1] < lower + spacing * (cells<D>[D - 1] - 1) || at[0] < lower + 4 * spacing;
    }
};

template <class Vector> Vector unit(int axis) { return Vector::Unit(axis); }
/// Normal of the inclined plane.
template <class Vector> Vector inclined() {
    Vector n = Vector::Zero();
    n[0] = typename Vector::Scalar(0.6);
    n[n.size() - 1] = typename Vector::Scalar(0.8);
    return n;
}
template <class Vector> Vector pull() {
    Vector g = Vector::Zero();
    g[0] = typename Vector::Scalar(0.3);
    g[g.size() - 1] = typename Vector::Scalar(-1.5);
    return g;
}

/// What is composed, for the reference.
struct composition {
    reference::shape_kind shape;
    reference::update update;
    reference::stress_order order;
};

template <int D> reference::scene scene(const composition& by);
template <int D> reference::state particles(const reference::scene& set);

/// Courant number 0.2.
double time_step();

struct outcome {
    compare::deviations found;
    std::size_t crossings;  ///< particles that went to another cell
};

template <int D, class Lanes, class Shape, class Update, class Order> outcome run() {
    using point = tamis::point<D, double>;
    const Update update = compare::make<Update>();

    double low[D], high[D];
    for (int d = 0; d < D; ++d) {
        low[d] = lower;
        high[d] = upper<D>(d);
    }
    const tamis::linear_elastic law{.young = young, .poisson = poisson, .density = density};
    const tamis::conditions walls{tamis::fixed{bottom<D>{}}, tamis::slip{left<D>{}, unit<point>(0)},
                                  tamis::slip{front_and_back<D>{}, unit<point>(1)},
                                  tamis::prescribed{right<D>{}, pushed{}, unit<point>(0)},
                                  tamis::slip{incline<D>{}, inclined<point>()}};
    tamis::solver mpm{tamis::uniform_grid{low, high, spacing}, Shape{}, update, Order{}, walls,
                      tamis::gravity{pull<point>()},           Lanes{}};
    auto body = mpm.make_body(law, inside<D>{}, tamis::per_cell{2}, tamis::fields<compare::number>{});

    const reference::scene set = scene<D>({compare::same(Shape{}), compare::same(update), compare::same(Order{})});
    compare::reference_run reference(set, particles<D>(set));
    compare::side_by_side(mpm, body, reference, time_step(), steps);
    return {reference.result(), mpm.crossings()};
}

/// A section of the test case at hand, named by the composition: agreement to 1e-10, with particles that change cells.
void check(int dimension, std::string_view shape, std::string_view update, std::string_view order,
           outcome (*composed)());

template <int D, class Lanes, class Shape, class Update, class... Order> void check_orders() {
    (check(D, Shape::name, Update::name, Order::name, run<D, Lanes, Shape, Update, Order>), ...);
}

}  // namespace block
