#pragma once
#include <tamis/load/loads.hpp>
#include <tamis/solver/kernels.hpp>

#include <array>
#include <type_traits>

namespace tamis::detail {

/// The node fields of the step's start: p and m (or 1/m, where masses do not change) until they become velocities, then
/// v and 1/m.
template <bool HoldsVelocity, bool MassIsNew> struct node_state {
    static constexpr bool mass_is_new = MassIsNew && !HoldsVelocity;
    using list = std::conditional_t<!HoldsVelocity,
                                    std::conditional_t<mass_is_new, fields<const field::mass, const field::momentum>,
                                                       fields<const field::inverse_mass, const field::momentum>>,
                                    fields<const field::inverse_mass, const field::velocity>>;
    template <class T> TAMIS_INLINE static T mass(auto i) {
        if constexpr (mass_is_new)
            return i[symbols::m];
        else
            return inverse_or_zero(i[symbols::im]);
    }
    template <class T> TAMIS_INLINE static auto momentum(auto i) {
        if constexpr (HoldsVelocity)
            return (i[symbols::v] * mass<T>(i)).eval();
        else
            return i[symbols::mv];
    }
};

/// f -= alpha m v.
template <class T, class State> struct damp_node {
    using list = typename concatenate<typename State::list, fields<field::force>>::type;
    T alpha;
    TAMIS_INLINE void operator()(auto i) const { i[symbols::f] -= alpha * State::template momentum<T>(i); }
};
/// m and m v^2/2.
template <class T, class State> struct kinetic_of_node {
    TAMIS_INLINE std::array<T, 2> operator()(auto i) const {
        using real = typename lane<T>::real;
        const T mass = State::template mass<T>(i);
        return {mass, State::template momentum<T>(i).squaredNorm() * inverse_or_zero(mass) / T(real(2))};
    }
};

/// The damping forces of all loads, and what they make of the kinetic energy; `each_sweeps(f)` calls f with the sweeps
/// of each velocity field. Throws `error` if alpha dt is above 1.
template <class T, class State, class Load, class EachSweeps>
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
                const auto sums =
                    sweeps.template sum_over_nodes<2>(typename State::list{}, kinetic_of_node<T, State>{});
                mass += to_double(sums[0]);
                kinetic += to_double(sums[1]);
            });
            one.sees(kinetic, mass, dt);
        }
    });
    using kernel = damp_node<T, State>;
    if (alpha > 0)
        each_sweeps([&](auto& sweeps) { sweeps.each_node(typename kernel::list{}, kernel{T(real(alpha))}); });
}

/// A new run: damping that evolves begins anew.
template <class Load> void restart_loads(Load& load) {
    each_load(load, [](auto, auto& one) {
        if constexpr (requires { one.restart(); }) one.restart();
    });
}

}  // namespace tamis::detail
