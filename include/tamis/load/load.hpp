#pragma once
#include <tamis/core/space.hpp>

#include <concepts>
#include <utility>

namespace tamis {

/// A body acceleration (m/s^2): `acceleration(x, v, t)` at a particle's place and velocity of the step's start. It is
/// called particle by particle; with `static constexpr bool in_lanes = true;` it is called with vectors of lanes.
template <class L, class Vector>
concept BodyLoad = requires(const L& load, const Vector& x, const Vector& v, double t) {
    load.acceleration(x, v, t);
};

/// A body acceleration (m/s^2) from fields that particles carry: `acceleration_of(p, t)`, p a row that shows the load's
/// `on_particles`, in lanes. `static constexpr bool by_fields = true;` says so.
template <class L>
concept FieldLoad = requires {
    requires L::by_fields;
    typename L::on_particles;
};

/// A force (N) on each particle that `chooses(x)` picks when its body is made: `force(x, t)` at its present place.
template <class L, class Vector>
concept ParticleLoad = requires(const L& load, const Vector& x, double t) {
    { load.chooses(x) } -> std::convertible_to<bool>;
    load.force(x, t);
};
/// A force per area (Pa) on faces at a body's surface that `takes(x, n)` picks when the body is made, x a face's centre
/// and n its outward normal: `per_area(x, n, t)`.
template <class L, class Vector>
concept SurfaceLoad = requires(const L& load, const Vector& x, const Vector& n, double t) {
    { load.takes(x, n) } -> std::convertible_to<bool>;
    load.per_area(x, n, t);
};
/// A force -damping(t) m v on every node, v its velocity at the step's start (1/s). With `sees(kinetic, mass, dt)` it
/// is told the nodes' kinetic energy (J) and mass (kg) of the step's start, once damping(t) has been asked for.
template <class L>
concept NodeDamping = requires(const L& load, double t) {
    { load.damping(t) } -> std::convertible_to<double>;
};

/// No load.
struct unloaded {
    static constexpr bool never = true;
    auto acceleration(const auto& x, const auto&, auto) const { return (x * 0).eval(); }
};

/// The same acceleration everywhere and always.
template <class Vector> struct gravity {
    /// The acceleration (m/s^2).
    Vector g;
    static constexpr bool in_lanes = true;
    template <class V> V acceleration(const V&, const V&, auto) const {
        static_assert(
            static_cast<int>(Vector::SizeAtCompileTime) == static_cast<int>(V::SizeAtCompileTime),
            "tamis: gravity of another dimension than the grid's; give as many components as the grid has axes");
        V b;
        for (int d = 0; d < static_cast<int>(b.size()); ++d) b[d] = constant<typename V::Scalar>(g[d]);
        return b;
    }
};
template <class Vector> gravity(Vector) -> gravity<Vector>;

/// An acceleration f(x, v, t) given as a function, for instance a lambda.
template <class Function> struct body_acceleration {
    /// Acceleration (m/s^2) at a place (m), of a velocity (m/s), at a time (s).
    Function function;
    auto acceleration(const auto& x, const auto& v,
                      auto t) const requires std::invocable<const Function&, decltype(x), decltype(v), decltype(t)> {
        return function(x, v, t);
    }
};
template <class Function> body_acceleration(Function) -> body_acceleration<Function>;

}  // namespace tamis
