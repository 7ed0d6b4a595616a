#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/run/observer.hpp>
#include <tamis/run/step_limit.hpp>
#include <tamis/run/warn_of_steps.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace tamis {

/// A number of equal steps, (end - begin)/count each. Courant numbers (c + |V|) dt/h above `limit` are refused; by
/// default the composition's own (docs/stability.md), 1 at most.
struct fixed_steps {
    long count;                     ///< How many.
    std::optional<double> limit{};  ///< Courant number, in place of the composition's.
};
/// Steps by the Courant number (c + |V|) dt/h, c the law's wave speed, |V| the speed of the fastest particle (of moving
/// ones only: held particles carry nothing along). Without a number it is `safety` times the composition's limit, that
/// of free ends where there are any. The last step ends exactly at the end.
struct courant {
    std::optional<double> number{};  ///< Courant number of the steps.
    std::optional<double> limit{};   ///< In place of the composition's.
    double safety = 0.9;             ///< Share of the limit, 0 to 1, where no number is given.
};

namespace detail {

inline void check_span(const interval& span) {
    if (!(span.end > span.begin && std::isfinite(span.end - span.begin)))
        throw error(sentence("integrate: the interval is ", span.begin, " to ", span.end,
                             " s; give a beginning and a later, finite end"));
}
inline void check_count(const fixed_steps& steps) {
    if (steps.count < 1) throw error(sentence("integrate: ", steps.count, " steps; give fixed_steps{1} or more"));
}

/// `count` steps from the beginning to the end of a span: look(steps done, t, dt) before every n-th and after the last,
/// step(dt, t at its end), and the observers.
template <class Look, class Step, class... Observer>
long in_equal_steps(const interval& span, long count, long n, Look look, Step step, Observer&... observers) {
    const double dt = (span.end - span.begin) / static_cast<double>(count);
    progress_state state{0, count, span.begin, span, dt, step_bound::given};
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

/// Steps the bodies from span.begin to span.end. Observers are called at the start and after every step. Throws `error`
/// if the Courant number goes beyond its limit, or if a law refuses a particle (asked every 1000 steps and at
/// the end). Returns the number of steps. An observer given by value that has a `commit()`, a csv_output, is committed
/// at the end of the run; one given by std::ref is the caller's.
///
///     integrate(mpm, bodies(bar), {0, 2}, fixed_steps{4000}, every(100, [](double t) { std::printf("%g s\n", t); }));
template <class Solver, class... Body, class... Observer>
long integrate(Solver& mpm, std::tuple<Body&...> all, interval span, fixed_steps steps, Observer&&... observers) {
    using real = typename Solver::real;
    detail::check_span(span);
    detail::check_count(steps);
    const double h = detail::to_double(mpm.grid().spacing());
    const detail::listening<Solver> listens(mpm, observers...);
    mpm.start_at(span.begin);
    const auto look = [&](long done, double t, double dt) {
        detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
        if (done == steps.count) return;
        const double speed = detail::signal_speed<typename Solver::composition_type::motion>(std::as_const(all));
        const auto limit = detail::limit_of(mpm, all, steps.limit);
        detail::check_courant(mpm, speed * dt / h, limit, dt, done, t);
        detail::check_apart<typename Solver::composition_type::motion>(std::as_const(all), done, t);
        detail::warn_of_free_end(mpm, speed * dt / h, limit, dt);
    };
    const auto step = [&](double dt, double end) { mpm.step(all, real(dt), end); };
    const long done = detail::in_equal_steps(span, steps.count, 1000, look, step, observers...);
    (detail::commit_own<Observer>(observers), ...);
    detail::warn_of_idle_loads(mpm);
    return done;
}

/// The same with steps chosen by a Courant number, and no larger than loads (damping) and laws (viscosity) allow;
/// looked at again every 20 steps. Warns if steps are too large for the bodies' free ends, or chosen although nothing
/// is known of the composition (`warning`).
template <class Solver, class... Body, class... Observer>
long integrate(Solver& mpm, std::tuple<Body&...> all, interval span, courant pace, Observer&&... observers) {
    using real = typename Solver::real;
    detail::check_span(span);
    if (pace.number && !(*pace.number > 0))
        throw error(detail::sentence("integrate: the Courant number is ", *pace.number, "; give a positive one"));
    if (!(pace.safety > 0 && pace.safety <= 1))
        throw error(detail::sentence("integrate: the safety factor is ", pace.safety, "; give one up to 1"));
    const double h = detail::to_double(mpm.grid().spacing());
    const detail::listening<Solver> listens(mpm, observers...);
    mpm.start_at(span.begin);
    progress_state state{0, 0, span.begin, span};
    double from = span.begin, dt = 0;
    long done = 0, left = 0, since = 0, looked = 0;
    detail::step_limit limit;
    const auto choose = [&] {
        const double speed = detail::signal_speed<typename Solver::composition_type::motion>(std::as_const(all));
        detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
        detail::check_apart<typename Solver::composition_type::motion>(std::as_const(all), done, state.time);
        from = state.time;
        since = 0;
        // Free ends change slowly; an automatic step follows them.
        if (!pace.number || looked++ % 10 == 0) limit = detail::limit_of(mpm, all, pace.limit);
        if (pace.number && *pace.number > limit.inner)
            detail::check_courant(mpm, *pace.number, limit, *pace.number * h / speed, done, from);
        const double number = pace.number ? *pace.number : pace.safety * detail::automatic_number(limit);
        detail::warn_of_free_end(mpm, number, limit, number * h / speed);
        if (!pace.number) detail::warn_of_unknown_limit(mpm, number, limit);
        detail::bounded_step largest = detail::largest_step(mpm, std::as_const(all), from);
        largest.dt *= pace.safety;
        const bool light = detail::automatic_number(limit) < limit.inner;
        largest.heed(number * h / speed, pace.number ? step_bound::given
                                         : light     ? step_bound::free_end
                                                     : step_bound::waves);
        const double wanted = (span.end - from) / largest.dt;
        if (!(wanted < 1e15))
            throw error("integrate: the bodies' speed is not finite; check the law and the velocities");
        left = std::max(1L, static_cast<long>(std::ceil(wanted * (1 - 1e-12))));
        state.dt = dt = (span.end - from) / static_cast<double>(left);
        state.bound = largest.bound;
        state.steps = done + left;
    };
    choose();
    (detail::tell(observers, state), ...);
    while (left > 0) {
        // Held particles' signal speed does not change.
        using C = typename Solver::composition_type;
        if (C::moves || C::total ? since == 20 : since == 1000) choose();
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
    (detail::commit_own<Observer>(observers), ...);
    detail::warn_of_idle_loads(mpm);
    return done;
}

}  // namespace tamis
