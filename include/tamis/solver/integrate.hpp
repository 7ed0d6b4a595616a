#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/solver/step_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace tamis {

/// From when to when a run goes (s).
struct interval {
    double begin, end;
};
/// Where a run stands; what observers are told.
struct progress_state {
    long step;      // steps done
    long steps;     // steps in all, as far as is known now
    double time;    // at the end of the last step (s)
    interval span;  // of the run
};

/// What `integrate` says of a step that is between the limits of free ends and of inner nodes, and of one that it chose
/// although nothing is known of the composition. Observers that take a `const warning&` and nothing else are told; if
/// there is none, the sentence goes to standard error. Once in a solver's life.
struct warning {
    std::string sentence;
    double number, limit;  // Courant numbers: the step's, and the one at free ends, or 1
};

/// A number of equal steps, (end - begin)/count each. Courant numbers (c + |V|) dt/h above `limit` are refused; by
/// default the composition's own (docs/stability.md), 1 at most.
struct fixed_steps {
    long count;
    std::optional<double> limit{};
};
/// Steps by the Courant number (c + |V|) dt/h, c the law's wave speed, |V| the speed of the fastest particle (of moving
/// ones only: held particles carry nothing along). Without a number it is `safety` times the composition's limit, that
/// of free ends where there are any. The last step ends exactly at the end.
struct courant {
    std::optional<double> number{};
    std::optional<double> limit{};
    double safety = 0.9;
};

namespace detail {

/// Throws if a particle's velocity or stress is not a number, or if its law refuses it.
template <class... Body> void check_finite(const std::tuple<Body&...>& all, long steps, double time, double dt) {
    const auto one = [&](const auto& body) {
        long k = 0;
        for (const auto p : body) {
            const double sum = detail::to_double(p[symbols::v].sum() + p[symbols::sigma].sum());
            std::string why;
            if constexpr (requires { body.law.check(p); }) {
                try {
                    body.law.check(p);
                } catch (const error& e) {
                    why = e.what();
                }
            }
            if (!std::isfinite(sum))
                why = sentence(
                    "its velocity or stress is not a number. Likely causes: a time step above the stability "
                    "limit (dt = ",
                    dt, "), or a law that returned one", why.empty() ? "" : ". Its law says: ", why);
            if (!why.empty())
                throw error(sentence("particle ", k, " at (", list_of(p[symbols::x]), "), step ", steps, ", t = ", time,
                                     ": ", why));
            ++k;
        }
    };
    detail::each_of(all, one);
}

inline void check_span(const interval& span) {
    if (!(span.end > span.begin && std::isfinite(span.end - span.begin)))
        throw error(sentence("integrate: the interval is ", span.begin, " to ", span.end,
                             " s; give a beginning and a later, finite end"));
}
inline void check_count(const fixed_steps& steps) {
    if (steps.count < 1) throw error(sentence("integrate: ", steps.count, " steps; give fixed_steps{1} or more"));
}

/// Asked in this order, for a generic observer is not to be tried with a warning.
template <class Observer>
concept TakesWarnings = !std::invocable<Observer&, double> && !std::invocable<Observer&, const progress_state&> &&
                        std::invocable<Observer&, const warning&>;

/// Tells the observers that take warnings, or standard error; once in a solver's life.
template <class Solver, class Sentence, class... Observer>
void warn_once(Solver& mpm, double number, double limit, const Sentence& sentence_of, Observer&... observers) {
    if constexpr (requires { mpm.warnings(); }) {
        if (!mpm.warnings().empty()) return;
        const warning all{sentence_of(), number, limit};
        mpm.warn(all.sentence);
        const auto one = [&](auto& observer) {
            if constexpr (TakesWarnings<std::remove_reference_t<decltype(observer)>>) observer(all);
        };
        (one(observers), ...);
        if constexpr (!(TakesWarnings<Observer> || ...)) std::fprintf(stderr, "%s\n", all.sentence.c_str());
    }
}
/// Steps are too large for a free end.
template <class Solver, class... Observer>
void warn_of_free_end(Solver& mpm, double number, const step_limit& limit, double dt, Observer&... observers) {
    if (!(number > limit.free_end)) return;
    const auto sentence_of = [&] {
        return sentence("tamis: ", composition_of(mpm), ": the Courant number ", number, " is above ", limit.free_end,
                        ", beyond which disturbances may grow at a free end, for a node there has only ", limit.share,
                        " of an inner node's mass; take steps of at most ", dt * limit.free_end / number,
                        ", or strain by particles' velocities (usf, usl_plus, usavg_plus), or take smoother functions "
                        "(docs/stability.md)");
    };
    warn_once(mpm, number, limit.free_end, sentence_of, observers...);
}
/// An automatic step is taken of a composition whose limit is not known.
template <class Solver, class... Observer>
void warn_of_unknown_limit(Solver& mpm, double number, const step_limit& limit, Observer&... observers) {
    if (limit.known || limit.given) return;
    const auto sentence_of = [&] {
        return sentence("tamis: ", composition_of(mpm),
                        ": nothing is known of how large a step of this composition may ",
                        "be; courant{} takes the Courant number ", number,
                        ", which may be too large. Give a number, "
                        "courant{0.3}, or a limit; stability::critical_numbers finds them (docs/stability.md)");
    };
    warn_once(mpm, number, limit.inner, sentence_of, observers...);
}

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

/// `count` steps from the beginning to the end of a span: look(steps done, t, dt) before every n-th and after the last,
/// step(dt, t at its end), and the observers.
template <class Look, class Step, class... Observer>
long in_equal_steps(const interval& span, long count, long n, Look look, Step step, Observer&... observers) {
    const double dt = (span.end - span.begin) / static_cast<double>(count);
    progress_state state{0, count, span.begin, span};
    (tell(observers, state), ...);
    for (long k = 1; k <= count; ++k) {
        if ((k - 1) % n == 0) look(k - 1, state.time, dt);
        const double end = k == count ? span.end : span.begin + dt * static_cast<double>(k);
        step(dt, end);
        state.step = k;
        state.time = end;
        (tell(observers, state), ...);
    }
    look(count, state.time, dt);
    return count;
}

}  // namespace detail

/// f, called at the start and after every n steps; f takes the time (double) or a progress_state.
template <class F> auto every(long n, F f) {
    if (n < 1) throw error(detail::sentence("every: n is ", n, "; give a number of steps of 1 or more"));
    return [n, f](const progress_state& state) mutable {
        if (state.step % n == 0) detail::tell(f, state);
    };
}

/// Steps the bodies from span.begin to span.end. Observers are called at the start and after every step. Throws `error`
/// if the Courant number goes beyond its limit, or if a particle is not a number (looked for every 1000 steps and at
/// the end). Returns the number of steps.
template <class Solver, class... Body, class... Observer>
long integrate(Solver& mpm, std::tuple<Body&...> all, interval span, fixed_steps steps, Observer&&... observers) {
    using real = typename Solver::real;
    detail::check_span(span);
    detail::check_count(steps);
    const double h = detail::to_double(mpm.grid().spacing());
    mpm.start_at(span.begin);
    const auto look = [&](long done, double t, double dt) {
        detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
        if (done == steps.count) return;
        const double speed = detail::signal_speed<Solver::composition_type::moves>(std::as_const(all));
        const auto limit = detail::limit_of(mpm, all, steps.limit);
        detail::check_courant(mpm, speed * dt / h, limit, dt, done, t);
        detail::warn_of_free_end(mpm, speed * dt / h, limit, dt, observers...);
    };
    const auto step = [&](double dt, double end) { mpm.step(all, real(dt), end); };
    return detail::in_equal_steps(span, steps.count, 1000, look, step, observers...);
}

/// The same with steps chosen by a Courant number; looked at again every 20 steps. Warns if steps are too large for the
/// bodies' free ends, or chosen although nothing is known of the composition (`warning`).
template <class Solver, class... Body, class... Observer>
long integrate(Solver& mpm, std::tuple<Body&...> all, interval span, courant pace, Observer&&... observers) {
    using real = typename Solver::real;
    detail::check_span(span);
    if (pace.number && !(*pace.number > 0))
        throw error(detail::sentence("integrate: the Courant number is ", *pace.number, "; give a positive one"));
    if (!(pace.safety > 0 && pace.safety <= 1))
        throw error(detail::sentence("integrate: the safety factor is ", pace.safety, "; give one up to 1"));
    const double h = detail::to_double(mpm.grid().spacing());
    mpm.start_at(span.begin);
    progress_state state{0, 0, span.begin, span};
    double from = span.begin, dt = 0;
    long done = 0, left = 0, since = 0, looked = 0;
    detail::step_limit limit;
    const auto choose = [&] {
        const double speed = detail::signal_speed<Solver::composition_type::moves>(std::as_const(all));
        detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
        from = state.time;
        since = 0;
        // Free ends change slowly; an automatic step follows them.
        if (!pace.number || looked++ % 10 == 0) limit = detail::limit_of(mpm, all, pace.limit);
        if (pace.number && *pace.number > limit.inner)
            detail::check_courant(mpm, *pace.number, limit, *pace.number * h / speed, done, from);
        const double number = pace.number ? *pace.number : pace.safety * detail::automatic_number(limit);
        detail::warn_of_free_end(mpm, number, limit, number * h / speed, observers...);
        if (!pace.number) detail::warn_of_unknown_limit(mpm, number, limit, observers...);
        const double wanted = (span.end - from) * speed / (number * h);
        if (!(wanted < 1e15))
            throw error("integrate: the bodies' speed is not finite; check the law and the velocities");
        left = std::max(1L, static_cast<long>(std::ceil(wanted * (1 - 1e-12))));
        dt = (span.end - from) / static_cast<double>(left);
        state.steps = done + left;
    };
    choose();
    (detail::tell(observers, state), ...);
    while (left > 0) {
        // Held particles' signal speed does not change.
        if (Solver::composition_type::moves ? since == 20 : since == 1000) choose();
        ++since;
        ++done;
        --left;
        const double end = left == 0 ? span.end : from + dt * static_cast<double>(since);
        mpm.step(all, real(dt), end);
        state.step = done;
        state.time = end;
        (detail::tell(observers, state), ...);
    }
    detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
    return done;
}

}  // namespace tamis
