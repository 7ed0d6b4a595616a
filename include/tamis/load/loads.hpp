#pragma once
#include <tamis/core/fields.hpp>
#include <tamis/load/load.hpp>

#include <tuple>
#include <type_traits>
#include <utility>

namespace tamis {

/// Several loads at once; they add up.
///
///     loads{gravity{point<2, double>(0, -9.81)}, grid_damping{5.}, traction{at_the_end, push}}
template <class... Load> struct loads {
    /// The loads.
    std::tuple<Load...> all;
    /// Of one load or more.
    constexpr explicit loads(Load... each) : all(std::move(each)...) {}
};
template <class... Load> loads(Load...) -> loads<Load...>;

namespace field {

/// How much of the force of the K-th load, a `particle_force`, a particle takes: 1 or, where it was not chosen, 0.
template <int K> struct chosen : scalar_field {
    /// The same for every K.
    static constexpr std::string_view name = "chosen";
};
/// Areas (m^(Dim-1)) of a particle's faces that the K-th load, a `traction`, acts on, in the reference state: on the
/// lower and the upper side of x, of y, of z; 0 where it does not.
template <int K> struct faces {
    static constexpr std::string_view name = "faces";
    template <class S> using value = Eigen::Matrix<typename S::scalar, 2 * S::dim, 1, S::align>;
    template <class S> static constexpr int components = (2 * S::dim);
};

}  // namespace field

namespace detail {

/// A load, or several, by their types and one by one: f(std::integral_constant<int, K>, load).
template <class L> struct load_list { using type = std::tuple<L>; };
template <class... L> struct load_list<loads<L...>> { using type = std::tuple<L...>; };

template <class L> inline constexpr bool is_loads = false;
template <class... L> inline constexpr bool is_loads<loads<L...>> = true;

template <class Load, class F> TAMIS_INLINE void each_load(Load& load, F&& f) {
    if constexpr (is_loads<std::remove_const_t<Load>>)
        [&]<std::size_t... K>(std::index_sequence<K...>) TAMIS_INLINE_LAMBDA {
            (f(std::integral_constant<int, static_cast<int>(K)>{}, std::get<K>(load.all)), ...);
        }
    (std::make_index_sequence<std::tuple_size_v<decltype(load.all)>>{});
    else f(std::integral_constant<int, 0>{}, load);
}

template <class L, class Point>
concept Accelerates = FieldLoad<L> ||(BodyLoad<L, Point> && !requires { requires L::never; });
template <class L, class Point>
concept SingleLoad =
    BodyLoad<L, Point> || FieldLoad<L> || ParticleLoad<L, Point> || SurfaceLoad<L, Point> || NodeDamping<L>;

/// What the loads of a composition are, and the fields that particles must have for them.
template <class Point, class List> struct kinds_of_loads;
template <class Point, class... L> struct kinds_of_loads<Point, std::tuple<L...>> {
    static_assert(
        (SingleLoad<L, Point> && ...),
        "tamis: an argument of loads{...} is no load: it has neither acceleration(x, v, t), nor by_fields and "
        "acceleration_of(p, t), nor chooses(x) and force(x, t), nor takes(x, n) and per_area(x, n, t), nor damping(t); "
        "compare it with "
        "docs/concepts/load.md");
    /// Is there anything to do for particles, per unit of mass, per particle or per face; is there for nodes?
    static constexpr bool by_mass = (Accelerates<L, Point> || ...);
    static constexpr bool by_particle = (ParticleLoad<L, Point> || ...);
    static constexpr bool by_face = (SurfaceLoad<L, Point> || ...);
    static constexpr bool on_nodes = (NodeDamping<L> || ...);
    static constexpr bool on_particles = by_mass || by_particle || by_face;

    template <std::size_t... K> static auto fields_of(std::index_sequence<K...>)
        -> merge<on_particles_t<L>..., fields_if<ParticleLoad<L, Point>, field::chosen<static_cast<int>(K)>>...,
                 fields_if<SurfaceLoad<L, Point>, field::faces<static_cast<int>(K)>>...>;
    using particle_fields = decltype(fields_of(std::make_index_sequence<sizeof...(L)>{}));
};
template <class Load, class Point> using load_kinds = kinds_of_loads<Point, typename load_list<Load>::type>;

}  // namespace detail
}  // namespace tamis
