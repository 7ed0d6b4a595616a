#pragma once
#include <tamis/particles/carried.hpp>
#include <tamis/transfer/near.hpp>

namespace tamis {

/// What a law with `carries` is told of the flow at W particles: `stress(p, grad_v, dt, flow)`.
template <class S> struct flow {
    typename S::vector velocity;  // S v, of the velocity that strains the particles (m/s)
    typename S::vector slope;     // of the field that the law carries, per m
    typename S::scalar flux;      // sum of G_pi . v_i c_i: divergence of velocity times that field
};

namespace detail {

/// c V0 and V0 to nodes, c the field that the law carries.
template <class Carried> struct carried_to_nodes {
    template <class Slot> TAMIS_INLINE auto make(const Slot& slot, const auto&) const {
        const auto& volume = slot.template get<field::volume>();
        return std::array{volume, volume * slot.template get<Carried>()};
    }
    TAMIS_INLINE void operator()(auto, auto near, const auto& of) const {
        for (const auto& [i, w, dw] : near) {
            i[carried_volume{}] += w * of[0];
            i[carried{}] += w * of[1];
        }
    }
};

/// Looks at nothing: what laws without `carries` are told.
struct no_flow {};

/// Makes the flow at W particles from the nodes' velocities in `Velocity` and the table of what is carried.
template <class S, class Velocity> struct look_at_flow {
    const typename carried_nodes<S, true>::table_type& table;

    template <class Lattice, class Nodes, int N>
    TAMIS_INLINE flow<S> operator()(const Lattice& lattice, const Nodes& nodes, const stencil<S, N>& st,
                                    std::size_t first) const {
        using T = typename S::scalar;
        using real = typename S::real;
        using L = lane<T>;
        const typename S::vector zero = S::vector::Constant(T(real(0)));
        flow<S> at{zero, zero, T(real(0))};
        for (int r = 0; r < Lattice::rows; ++r) {
            const auto across = st.row(r);
            const std::size_t place = first + lattice.row_offset(r);
            unroll<N>([&](auto a) TAMIS_INLINE_LAMBDA {
                constexpr int step = a;
                const T w = st.weight(step, across), c = L::load(table.template column<carried>() + place + step);
                const typename S::vector dw = st.slope(step, across);
                typename S::vector u;
                unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
                    u[int(d)] = L::load(nodes.template column<Velocity>(int(d)) + place + step);
                });
                at.velocity += w * u;
                at.slope += c * dw;
                at.flux += c * u.dot(dw);
            });
        }
        return at;
    }
};

}  // namespace detail
}  // namespace tamis
