#pragma once
#include <tamis/conservation/law.hpp>

namespace tamis::conservation {

// An end of a line says what the state there is, `end(inside, t)`, of the state that the inside brings to it. The flux
// through the end is that of this state, and unknowns that it changes are held.

/// An end where nothing changes what the inside brings: it goes out. (Waves that come in through it bring what the last
/// of the inside is, which is for ends where none do.)
struct outflow {
    /// The state at the end, of what the inside brings to it.
    template <class State> State operator()(const State& inside, double) const { return inside; }
};
/// All unknowns are given, value(t).
template <class F> struct inflow {
    /// Their values at a time (s).
    F value;
    /// The state at the end at time t (s).
    template <class State> State operator()(const State&, double t) const { return detail::as_state<State>(value(t)); }
};
template <class F> inflow(F) -> inflow<F>;
/// Unknown `Index` is given, value(t); the others go out. The held end of an `elastic_bar` gives unknown 1, a free end
/// unknown 0.
template <int Index, class F> struct given {
    /// Its value at a time (s).
    F value;
    /// The state at the end at time t (s), of what the inside brings to it.
    template <class State> State operator()(State inside, double t) const {
        inside[Index] = static_cast<typename State::Scalar>(value(t));
        return inside;
    }
};
/// The end at which unknown `Index` is value(t).
template <int Index, class F> given<Index, F> give(F value) { return {value}; }

/// The lower and the upper end of a line.
template <class Low = outflow, class High = outflow> struct ends {
    /// The lower end.
    Low low{};
    /// The upper end.
    High high{};
};
template <class Low, class High> ends(Low, High) -> ends<Low, High>;

}  // namespace tamis::conservation
