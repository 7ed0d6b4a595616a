#pragma once
#include <tamis/core/values.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/shape/stencil.hpp>

namespace tamis {

namespace detail {

/// p[x] of a kernel: reads as a place in space, moves with +=.
template <class S> struct position_reference {
    typename S::vector& local;
    const frame<S>& at;
    TAMIS_INLINE operator typename S::vector() const { return place(local, at); }
    template <class E> TAMIS_INLINE void operator+=(const E& u) const {
        local += typename S::scalar(at.inverse_spacing) * u;
    }
    TAMIS_INLINE static typename S::vector place(const typename S::vector& r, const frame<S>& in) {
        using T = typename S::scalar;
        typename S::vector g;
        for (int d = 0; d < S::dim; ++d) g[d] = T(in.corner[static_cast<std::size_t>(d)]) + T(in.spacing) * r[d];
        g[0] += T(in.spacing) * lane<T>::iota();
        return g;
    }
};

/// Where a slot's particles are, from the places in their cells that they have or first had.
template <class S>
TAMIS_INLINE typename S::vector place_now(const typename S::vector& local, const auto& slot, const frame<S>& at) {
    typename S::vector x = position_reference<S>::place(local, at);
    if constexpr (keeps_first_place<typename std::remove_cvref_t<decltype(slot)>::list>)
        x += slot.template get<field::displacement>();
    return x;
}

/// W particles as a policy sees them: the fields it declared, const where it only reads.
template <class S, class Slot, class Shown> struct slot_row {
    Slot& all;
    const frame<S>& at;
    template <class F> TAMIS_INLINE decltype(auto) operator[](F) const {
        static_assert(contains<Shown, F>,
                      "tamis: a policy touches a field it did not declare; add it to the policy's "
                      "on_particles or on_nodes list");
        if constexpr (std::same_as<F, field::position>) {
            if constexpr (writes<Shown, F>)
                return position_reference<S>{all.template get<F>(), at};
            else
                return place_now<S>(all.template get<F>(), all, at);
        } else if constexpr (std::is_base_of_v<symmetric_field, F>) {
            static_assert(!std::same_as<F, field::stress> || !writes<Shown, F>,
                          "tamis: the stress is written through the law's return value; declare "
                          "symmetric fields as const");
            using stored = stored_symmetric<typename F::template full<S>, F::template components<S>>;
            if constexpr (writes<Shown, F>)
                return static_cast<const stored>(stored(all.template get<F>().data()));
            else if constexpr (std::is_base_of_v<symmetric_3x3_field, F>)
                return stored::read(all.template get<F>().data());
            else
                return unpack<S>(all.template get<F>());
        } else if constexpr (writes<Shown, F>)
            return (all.template get<F>());
        else
            return std::as_const(all.template get<F>());
    }
};

}  // namespace detail

/// What a kernel sees of W particles and of the nodes near them.
template <class S, class List, class Shown> using particle_row = detail::slot_row<S, values<S, List>, Shown>;

}  // namespace tamis
