#pragma once
#include <tamis/conservation/law.hpp>

namespace tamis::conservation {

/// An end of a line says what the state there is, `end(inside, t)`, of the state that the inside brings to it. The flux
/// through the end is that of this state, and unknowns that it changes are held.
///
/// Nothing changes what the inside brings: it goes out. (Waves that come in through it bring what the last of the
/// inside is, which is for ends where none do.)
struct outflow {
    template <class State> State operator()(const State& inside, double) const { return inside; }
};
/// All unknowns are given, value(t).
template <class F> struct inflow {
    F value;
    template <class State> State operator()(const State&, double t) const { return detail::as_state<State>(value(t)); }
};
template <class F> inflow(F) -> inflow<F>;
/// Unknown `Index` is given, value(t); the others go out. The held end of an `elastic_bar` gives unknown 1, a free end
/// unknown 0.
template <int Index, class F> struct given {
    F value;
    template <class State> State operator()(State inside, double t) const {
        inside[Index] = static_cast<typename State::Scalar>(value(t));
        return inside;
    }
};
template <int Index, class F> given<Index, F> give(F value) { return {value}; }

/// The lower and the upper end of a line.
template <class Low = outflow, class High = outflow> struct ends {
    Low low{};
    High high{};
};
template <class Low, class High> ends(Low, High) -> ends<Low, High>;

}  // namespace tamis::conservation
