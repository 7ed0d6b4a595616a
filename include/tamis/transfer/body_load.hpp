#pragma once
#include <tamis/load/load.hpp>
#include <tamis/transfer/near.hpp>

namespace tamis::detail {

/// Places of a slot's particles, from what the composition stores of them.
template <class S, class Shape, class Slot>
TAMIS_INLINE typename S::vector places(const Slot& slot, const frame<S>& at) {
    if constexpr (stores<typename Slot::list, field::position>)
        return position_reference<S>::place(slot.template get<field::position>(), at);
    else {
        using weights = held_weights<Shape>;
        const auto& kept = slot.template get<weights>();
        typename S::vector r;
        for (int d = 0; d < S::dim; ++d)
            r[d] = weights::template place<S>(d, [&](int c) -> const typename S::scalar& { return kept[c]; });
        return position_reference<S>::place(r, at);
    }
}

/// The body acceleration of a slot's particles at time t.
template <class S, class Shape, class Load, class Slot>
typename S::vector acceleration_of(const Load& load, const Slot& slot, const frame<S>& at, double t) {
    using T = typename S::scalar;
    using real = typename S::real;
    constexpr int D = S::dim, W = S::width;
    const typename S::vector x = places<S, Shape>(slot, at), v = slot.template get<field::velocity>();
    if constexpr (W == 1)
        return detail::as_point_like(x, load.acceleration(x, v, t));
    else if constexpr (requires { requires Load::in_lanes; }) {
        // Empty lanes have no place for which the load need make sense: 0 times infinity would go onto nodes.
        typename S::vector b = load.acceleration(x, v, t);
        const auto there = slot.template get<field::mass>() > T(real(0));
        for (int d = 0; d < D; ++d) b[d] = select(there, b[d], T(real(0)));
        return b;
    } else {
        real xs[D][W], vs[D][W], mass[W], bs[D][W];
        for (int d = 0; d < D; ++d) {
            lane<T>::store(xs[d], x[d]);
            lane<T>::store(vs[d], v[d]);
        }
        lane<T>::store(mass, slot.template get<field::mass>());
        for (int l = 0; l < W; ++l) {
            point<D, real> one_x, one_v, b = point<D, real>::Zero();
            for (int d = 0; d < D; ++d) {
                one_x[d] = xs[d][l];
                one_v[d] = vs[d][l];
            }
            if (mass[l] > real(0))
                b = as_point<D, real>(load.acceleration(std::as_const(one_x), std::as_const(one_v), t));
            for (int d = 0; d < D; ++d) bs[d][l] = b[d];
        }
        typename S::vector b;
        for (int d = 0; d < D; ++d) b[d] = lane<T>::load(bs[d]);
        return b;
    }
}

}  // namespace tamis::detail
