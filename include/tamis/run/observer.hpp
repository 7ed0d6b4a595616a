#pragma once
#include <tamis/core/error.hpp>
#include <tamis/run/warnings.hpp>

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace tamis {

/// From when to when a run goes.
struct interval {
    /// Times (s).
    double begin, end;
};
/// What a run's steps are as long as they are for: the number or count that was given, waves in the bodies, a node of
/// little mass at a free end, a load (damping), a law (viscosity).
enum class step_bound { given, waves, free_end, load, law };
/// In words: "given", "waves", "free end", "load", "law".
inline std::string_view name_of(step_bound bound) {
    constexpr std::string_view names[] = {"given", "waves", "free end", "load", "law"};
    return names[static_cast<int>(bound)];
}

/// Where a run stands; what observers are told.
struct progress_state {
    long step;                             ///< Steps done.
    long steps;                            ///< Steps in all, as far as is known now.
    double time;                           ///< At the end of the last step (s).
    interval span;                         ///< Of the run.
    double dt = 0;                         ///< Of the steps now (s).
    step_bound bound = step_bound::given;  ///< What allows no longer ones.
};

namespace detail {

/// Asked in this order, for a generic observer is not to be tried with a warning.
template <class Observer>
concept TakesWarnings = !std::invocable<Observer&, double> && !std::invocable<Observer&, const progress_state&> &&
                        std::invocable<Observer&, const warning&>;

template <class Observer> void tell(Observer& observer, const progress_state& state) {
    if constexpr (std::invocable<Observer&, const progress_state&>)
        observer(state);
    else if constexpr (std::invocable<Observer&, double>)
        observer(state.time);
    else
        static_assert(TakesWarnings<Observer>,
                      "tamis: an observer of integrate is called with the time, "
                      "f(double t), or with a progress_state; this one takes neither");
}

/// A run is over: an observer that was given away (`Observer` is no reference) puts its files in place, for nobody else
/// can tell it to.
template <class Observer> void commit_own(Observer& observer) {
    if constexpr (!std::is_reference_v<Observer> && requires { observer.commit(); }) observer.commit();
}

}  // namespace detail

/// What `every` makes. Files that the observer within holds back until `commit` are committed with it.
template <class F> class every_nth {
  public:
    /// Throws `error` if n is below 1.
    every_nth(long n, F f) : n_(n), f_(std::move(f)) {
        if (n < 1) throw error(detail::sentence("every: n is ", n, "; give a number of steps of 1 or more"));
    }
    /// Tells f, if it is its turn.
    void operator()(const progress_state& state) {
        if (state.step % n_ == 0) detail::tell(f_, state);
    }
    /// Commits what f holds back.
    void commit() requires requires(F& f) { f.commit(); }
    { f_.commit(); }

  private:
    long n_;
    F f_;
};
/// f, called at the start and after every n steps; f takes the time (double) or a progress_state. Throws `error` if n
/// is below 1. A copy of f is kept: give std::ref(f) where it is needed afterwards.
template <class F> every_nth<F> every(long n, F f) { return {n, std::move(f)}; }

}  // namespace tamis
