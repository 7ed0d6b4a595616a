#pragma once
#include <tamis/load/loads.hpp>
#include <tamis/core/error.hpp>
#include <tamis/core/lanes.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/unroll.hpp>

#include <array>
#include <type_traits>

namespace tamis::detail {

/// The mass of nodes, from m or from 1/m.
template <class T, class Mass> TAMIS_INLINE T mass_of_node(auto i) {
    if constexpr (std::same_as<Mass, field::inverse_mass>)
        return inverse_or_zero(i[symbols::im]);
    else
        return i[symbols::m];
}
/// f -= alpha p.
template <class T> struct damp_node {
    using list = fields<const field::momentum, field::force>;
    T alpha;
    TAMIS_INLINE void operator()(auto i) const { i[symbols::f] -= alpha * i[symbols::mv]; }
};
/// m and p^2/(2 m) of nodes; `Mass` holds m or 1/m.
template <class T, class Mass> struct kinetic_of_node {
    using list = fields<const Mass, const field::momentum>;
    TAMIS_INLINE std::array<T, 2> operator()(auto i) const {
        using real = typename lane<T>::real;
        const T mass = mass_of_node<T, Mass>(i);
        return {mass, i[symbols::mv].squaredNorm() * inverse_or_zero(mass) / T(real(2))};
    }
};

/// The damping forces of all loads, and what they make of the kinetic energy; `each_sweeps(f)` calls f with the sweeps
/// of each velocity field. Throws `error` if alpha dt is above 1.
template <class T, class Mass, class Load, class EachSweeps>
void damp(Load& load, double time, double dt, const EachSweeps& each_sweeps) {
    using real = typename lane<T>::real;
    double alpha = 0;
    each_load(load, [&](auto, const auto& one) {
        if constexpr (NodeDamping<std::remove_cvref_t<decltype(one)>>) alpha += one.damping(time);
    });
    if (!(alpha * dt <= 1))
        throw error(sentence("damping: alpha is ", alpha, " at t = ", time, ", and a step of ", dt,
                             " would turn velocities round; take steps of at most 1/alpha = ", 1 / alpha,
                             ", or a smaller alpha"));
    each_load(load, [&](auto, auto& one) {
        if constexpr (requires { one.sees(0., 0., dt); }) {
            double mass = 0, kinetic = 0;
            each_sweeps([&](auto& sweeps) {
                const auto sums = sweeps.template sum_over_nodes<2>(kinetic_of_node<T, Mass>{});
                mass += to_double(sums[0]);
                kinetic += to_double(sums[1]);
            });
            one.sees(kinetic, mass, dt);
        }
    });
    if (alpha > 0) each_sweeps([&](auto& sweeps) { sweeps.each_node(damp_node<T>{T(real(alpha))}); });
}

/// A new run: damping that evolves begins anew.
template <class Load> void restart_loads(Load& load) {
    each_load(load, [](auto, auto& one) {
        if constexpr (requires { one.restart(); }) one.restart();
    });
}

}  // namespace tamis::detail
