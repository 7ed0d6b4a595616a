#pragma once
#include <tamis/core/by_lane.hpp>
#include <tamis/load/loads.hpp>
#include <tamis/engine/near.hpp>
#include <tamis/shape/held_weights.hpp>

#include <cmath>
#include <utility>

namespace tamis::detail {

/// Places of a slot's particles, from what the composition stores of them.
template <class S, class Shape, class Slot>
TAMIS_INLINE typename S::vector places(const Slot& slot, const frame<S>& at) {
    if constexpr (stores<typename Slot::list, field::position>)
        return place_now<S>(slot.template get<field::position>(), slot, at);
    else {
        using weights = held_weights<Shape>;
        const auto& kept = slot.template get<weights>();
        typename S::vector r;
        for (int d = 0; d < S::dim; ++d)
            r[d] = weights::template place<S>(d, [&](int c) -> const typename S::scalar& { return kept[c]; });
        return place_now<S>(r, slot, at);
    }
}

/// Side of the cube that a particle of the given volume is when its body is made.
template <int D, class Real> Real side_of(const Real& volume) {
    if constexpr (D == 1)
        return volume;
    else
        return Real(D == 2 ? std::sqrt(to_double(volume)) : std::cbrt(to_double(volume)));
}

/// The acceleration that one load gives a slot's particles at time t.
template <class S, class Load, class Slot>
typename S::vector acceleration_at(const Load& load, const Slot& slot, const typename S::vector& x, double t) {
    using T = typename S::scalar;
    using real = typename S::real;
    constexpr int D = S::dim, W = S::width;
    const typename S::vector v = slot.template get<field::velocity>();
    if constexpr (W == 1)
        return detail::as_point_like(x, load.acceleration(x, v, t));
    else if constexpr (requires { requires Load::in_lanes; }) {
        // Empty lanes have no place for which the load need make sense: 0 times infinity would go onto nodes.
        typename S::vector b = load.acceleration(x, v, t);
        const auto there = slot.template get<field::mass>() > T(real(0));
        for (int d = 0; d < D; ++d) b[d] = select(there, b[d], T(real(0)));
        return b;
    } else {
        const by_lane<T, D> xs(x), vs(v);
        const by_lane<T, 1> mass(slot.template get<field::mass>());
        by_lane<T, D> bs;
        each_lane<T>([&](int l) { return mass(0, l) > real(0); },
                     [&](int l) {
                         const point<D, real> at = xs.at(l), speed = vs.at(l);
                         bs.put(l, as_point<D, real>(load.acceleration(at, speed, t)));
                     });
        typename S::vector b;
        bs.to(b);
        return b;
    }
}

/// The acceleration that a load gives a slot's particles by the fields they carry.
template <class S, class Load, class Slot>
TAMIS_INLINE typename S::vector acceleration_of(const Load& load, const Slot& slot, const frame<S>& at, double t) {
    using T = typename S::scalar;
    using row = slot_row<S, const Slot, on_particles_t<Load>>;
    static_assert(
        requires(row p) { load.acceleration_of(p, t); },
        "tamis: a load by_fields has no acceleration_of(p, t) that can be called; give it `auto acceleration_of(auto "
        "p, "
        "double t) const`, which returns a vector of lanes");
    typename S::vector b = load.acceleration_of(row{slot, at}, t);
    // Empty lanes have no fields for which the load need make sense.
    const auto there = slot.template get<field::mass>() > T(typename S::real(0));
    for (int d = 0; d < S::dim; ++d) b[d] = select(there, b[d], T(typename S::real(0)));
    return b;
}

/// The force of one load on a slot's particles that were chosen for it.
template <class S, class Load>
typename S::vector force_at(const Load& load, const typename S::scalar& share, const typename S::vector& x, double t) {
    using T = typename S::scalar;
    using real = typename S::real;
    constexpr int D = S::dim;
    const by_lane<T, 1> shares(share);
    const by_lane<T, D> xs(x);
    by_lane<T, D> forces;
    each_lane<T>([&](int l) { return shares(0, l) != real(0); },
                 [&](int l) {
                     const point<D, real> at = xs.at(l);
                     const point<D, real> force = as_point<D, real>(load.force(at, t));
                     forces.put(l, point<D, real>(shares(0, l) * force));
                 });
    typename S::vector all;
    forces.to(all);
    return all;
}

/// What loads give the nodes around a slot's particles: w F + K dw.
///
/// F is M b and the forces on particles and on faces. K is the sum of F d^T over faces: w + d . dw is the first-order
/// value of the functions at a face's centre x + d. They add up to one and reproduce linear fields, so force and moment
/// are exactly those of F at x + d. The functions' own values there would reach nodes that no particle reaches, where a
/// force is lost.
template <class S, bool Faces> struct loading { typename S::vector force; };
template <class S> struct loading<S, true> {
    typename S::vector force;
    typename S::tensor couple;
};

/// Adds the tractions on a slot's faces.
template <class S, class Load, class Faces>
void add_tractions(const Load& load, const Faces& faces, const typename S::vector& x, const typename S::scalar& volume,
                   double t, loading<S, true>& to) {
    using T = typename S::scalar;
    using real = typename S::real;
    constexpr int D = S::dim;
    const by_lane<T, 2 * D> areas(faces);
    const by_lane<T, D> xs(x);
    const by_lane<T, 1> volumes(volume);
    by_lane<T, D> forces;
    by_lane<T, D * D> couples;  // (d, axis) at axis D + d
    for (int side = 0; side < 2 * D; ++side)
        each_lane<T>([&](int l) { return areas(side, l) != real(0); },
                     [&](int l) {
                         const int axis = side / 2;
                         const real half = (side % 2 == 0 ? real(-1) : real(1)) * side_of<D>(volumes(0, l)) / real(2);
                         point<D, real> at = xs.at(l), normal = point<D, real>::Zero();
                         at[axis] += half;
                         normal[axis] = side % 2 == 0 ? real(-1) : real(1);
                         const point<D, real> on = areas(side, l) * as_point<D, real>(load.per_area(
                                                                        std::as_const(at), std::as_const(normal), t));
                         for (int d = 0; d < D; ++d) {
                             forces(d, l) += on[d];
                             couples(axis * D + d, l) += on[d] * half;
                         }
                     });
    for (int d = 0; d < D; ++d) {
        to.force[d] += forces.lanes(d);
        for (int e = 0; e < D; ++e) to.couple(d, e) += couples.lanes(e * D + d);
    }
}

template <class S, class Shape, class Load, class Slot>
auto loading_of(const Load& load, const Slot& slot, const frame<S>& at, double t) {
    using T = typename S::scalar;
    using real = typename S::real;
    using at_point = point<S::dim, real>;
    using kinds = load_kinds<Load, at_point>;
    [[maybe_unused]] const typename S::vector x = places<S, Shape>(slot, at);
    loading<S, kinds::by_face> all;
    [[maybe_unused]] bool first = true;
    if constexpr (!kinds::by_mass) all.force.setConstant(T(real(0)));
    each_load(load, [&](auto, const auto& one) {
        if constexpr (Accelerates<std::remove_cvref_t<decltype(one)>, at_point>) {
            const typename S::vector b = [&] {
                if constexpr (FieldLoad<std::remove_cvref_t<decltype(one)>>)
                    return acceleration_of<S>(one, slot, at, t);
                else
                    return acceleration_at<S>(one, slot, x, t);
            }();
            if (std::exchange(first, false))
                all.force = b;
            else
                all.force += b;
        }
    });
    if constexpr (kinds::by_mass) all.force = all.force * slot.template get<field::mass>();
    if constexpr (kinds::by_face) all.couple.setConstant(T(real(0)));
    each_load(load, [&](auto k, const auto& one) {
        using type = std::remove_cvref_t<decltype(one)>;
        if constexpr (ParticleLoad<type, at_point>) {
            const T& share = slot.template get<field::chosen<decltype(k)::value>>();
            if (lane<T>::any(share != T(real(0)))) all.force += force_at<S>(one, share, x, t);
        }
        if constexpr (SurfaceLoad<type, at_point>) {
            const auto& faces = slot.template get<field::faces<decltype(k)::value>>();
            T area = faces[0];
            for (int side = 1; side < 2 * S::dim; ++side) area += faces[side];
            if (lane<T>::any(area != T(real(0))))
                add_tractions<S>(one, faces, x, slot.template get<field::volume>(), t, all);
        }
    });
    return all;
}

}  // namespace tamis::detail
