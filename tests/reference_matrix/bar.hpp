#pragma once

/// Scenes of one dimension for the comparison with the reference: a bar in 18 cells with two particles each, from
/// x = -0.4 to 0.6, wide enough for two tiles of sixteen lanes. It is deformed enough for particles to change their
/// cells, and loaded by forces that depend on place, velocity and time.

#include <cmath>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "../support/compare.hpp"

namespace bar {

inline constexpr double lower = -0.4;
inline constexpr double upper = 0.6;
inline constexpr double spacing = (upper - lower) / 18;
inline constexpr double young = 2;
inline constexpr double density = 1.3;
inline constexpr int steps = 200;

/// `driven`: the bar fills the grid, its right end moves to and fro. `free`: it fills half the grid.
enum class kind { driven, free };

/// Acceleration: a pull to and fro, drag, and a part that is the same everywhere.
struct pull {
    auto operator()(const auto& at, const auto& speed, double t) const {
        using vector = std::decay_t<decltype(at)>;
        using real = typename vector::Scalar;
        return (at * real(0.8 * std::cos(3 * t)) - speed * real(0.3) +
                vector::Constant(at.size(), real(0.2 * std::sin(5 * t) - 0.1)))
            .eval();
    }
};

/// Velocity of the driven end (m/s).
inline double driver(double t) { return -0.05 * std::sin(10 * t); }

struct left_end {
    bool operator()(const auto& at) const { return at[0] < lower + spacing / 4; }
};
struct right_end {
    kind which;
    bool operator()(const auto& at) const { return which == kind::driven && at[0] > upper - spacing / 4; }
};
struct driven_velocity {
    auto operator()(const auto& at, double t) const {
        auto speed = at;
        speed[0] = static_cast<typename std::decay_t<decltype(at)>::Scalar>(driver(t));
        return speed;
    }
};
struct inside {
    kind which;
    bool operator()(const auto& at) const { return which == kind::driven || at[0] < 0.1; }
};

/// What is composed, for the reference.
struct composition {
    reference::shape_kind shape;
    reference::update update;
    reference::stress_order order;
    reference::motion motion;
};

/// The scene, and what its particles start with: they move at up to a fifth of the wave speed, and are stressed.
reference::scene scene(kind which, const composition& by);
reference::state particles(kind which, const reference::scene& set);

/// Courant number 0.2; explicit Euler would multiply the shortest wave by a million in 200 such steps, so it gets a
/// quarter. The number is one that float has too.
double time_step(reference::stress_order order);

struct outcome {
    compare::deviations found;
    std::size_t crossings;  ///< particles that went to another cell
};

template <class Real, class Lanes, class Shape, class Motion, class Update, class Order> outcome run(kind which) {
    const Update update = compare::make<Update>();
    const composition by{compare::same(Shape{}), compare::same(update), compare::same(Order{}),
                         compare::same(Motion{})};

    const tamis::linear_elastic law{.young = young, .density = density};
    const tamis::uniform_grid<1, Real> grid{{Real(lower)}, {Real(upper)}, Real(spacing)};
    const tamis::conditions ends{tamis::fixed{left_end{}}, tamis::prescribed{right_end{which}, driven_velocity{}}};
    tamis::solver mpm{grid, Shape{}, update, Order{}, ends, tamis::body_acceleration{pull{}}, Motion{}, Lanes{}};
    auto body = mpm.make_body(law, inside{which}, tamis::per_cell{2}, tamis::fields<compare::number>{});

    const reference::scene set = scene(which, by);
    compare::reference_run reference(set, particles(which, set));
    compare::side_by_side(mpm, body, reference, time_step(by.order), steps);
    return {reference.result(), mpm.crossings()};
}

/// How well a composition must agree with the reference. A step rounds each number some ten times, by 1e-16 in double
/// precision and 6e-8 in float; 200 steps of that, in random directions, make 45 times as much, and the scenes let a
/// disturbance grow to less than a hundred times its size (bar_scene_test.cpp). That is 5e-13, and 3e-4.
template <class Real> inline constexpr double tolerance = 1e-10;
template <> inline constexpr double tolerance<float> = 3e-4;

/// A section of the test case at hand, named by the composition, that runs it in both scenes.
void check(std::string_view shape, std::string_view motion, std::string_view update, std::string_view order,
           outcome (*composed)(kind), double tolerance);

template <class Real, class Lanes, class Shape, class Motion, class Update, class... Order> void check_orders() {
    (check(Shape::name, Motion::name, Update::name, Order::name, run<Real, Lanes, Shape, Motion, Update, Order>,
           tolerance<Real>),
     ...);
}

/// An update in all six stress orders.
template <class Real, class Lanes, class Shape, class Motion, class Update> void check_all_orders() {
    check_orders<Real, Lanes, Shape, Motion, Update, tamis::usf, tamis::usl_minus, tamis::usl_plus, tamis::usavg_minus,
                 tamis::usavg_plus, tamis::euler>();
}

}  // namespace bar
