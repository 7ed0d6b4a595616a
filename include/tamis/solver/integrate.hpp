#pragma once
#include <tamis/solver/initial.hpp>
#include <tamis/solver/solver.hpp>

#include <algorithm>
#include <cmath>
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

/// A number of equal steps, (end - begin)/count each. Courant numbers above `limit` are refused.
struct fixed_steps {
    long count;
    double limit = 1.0;
};
/// Steps by the Courant number (c + |V|) dt/h, c the law's wave speed, |V| the speed of the fastest particle (of moving
/// ones only: held particles carry nothing along). The last step ends exactly at the end.
struct courant {
    double number;
    double limit = 1.0;
};

namespace detail {

template <class Body> double wave_speed_of(const Body& body) {
    double c = 0;
    if constexpr (requires { body.law.wave_speed_at(*body.begin(), Body::dim); }) {
        for (const auto p : body) c = std::max(c, static_cast<double>(body.law.wave_speed_at(p, Body::dim)));
    } else if constexpr (requires { body.law.wave_speed(Body::dim); })
        c = static_cast<double>(body.law.wave_speed(Body::dim));
    else
        c = static_cast<double>(body.law.wave_speed());
    if constexpr (
        requires {
            typename Body::law_type;
            body.law.density;
        } &&
        !requires { body.law.wave_speed_at(*body.begin(), Body::dim); }) {
        // A body given another density than its law's has another wave speed.
        double lightest = static_cast<double>(body.law.density);
        for (const auto p : body) lightest = std::min(lightest, detail::to_double(p[symbols::m] / p[symbols::V]));
        c *= std::sqrt(static_cast<double>(body.law.density) / lightest);
    }
    return c;
}

/// Fastest signal through the bodies (m/s).
template <bool Moves, class... Body> double signal_speed(const std::tuple<Body&...>& all) {
    double fastest = 0;
    const auto one = [&](const auto& body) {
        double speed = 0;
        if constexpr (Moves)
            for (const auto p : body) speed = std::max(speed, detail::to_double(p[symbols::v].norm()));
        fastest = std::max(fastest, wave_speed_of(body) + speed);
    };
    std::apply([&](const auto&... b) { (one(b), ...); }, all);
    return fastest;
}

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
    std::apply([&](const auto&... b) { (one(b), ...); }, all);
}

inline void check_courant(double number, double limit, double dt, long step, double t) {
    if (!(number <= limit))
        throw error(sentence("step ", step, ", t = ", t, ": the Courant number (c + |V|) dt/h is ", number,
                             " with dt = ", dt, ", above the limit of ", limit, "; take steps of at most ",
                             dt * limit / number));
}

template <class Observer> void tell(Observer& observer, const progress_state& state) {
    if constexpr (std::invocable<Observer&, const progress_state&>)
        observer(state);
    else {
        static_assert(std::invocable<Observer&, double>,
                      "tamis: an observer of integrate is called with the time, "
                      "f(double t), or with a progress_state; this one takes neither");
        observer(state.time);
    }
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
    if (!(span.end > span.begin))
        throw error("integrate: the end is not after the beginning; give an interval {begin, end}");
    if (steps.count < 1)
        throw error(detail::sentence("integrate: ", steps.count, " steps; give fixed_steps{1} or more"));
    const double dt = (span.end - span.begin) / static_cast<double>(steps.count);
    const double h = detail::to_double(mpm.grid().spacing());
    mpm.start_at(span.begin);
    progress_state state{0, steps.count, span.begin, span};
    (detail::tell(observers, state), ...);
    for (long k = 1; k <= steps.count; ++k) {
        if ((k - 1) % 1000 == 0) {
            const double speed = detail::signal_speed<Solver::composition_type::moves>(std::as_const(all));
            detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
            detail::check_courant(speed * dt / h, steps.limit, dt, k - 1, state.time);
        }
        const double end = k == steps.count ? span.end : span.begin + dt * static_cast<double>(k);
        mpm.step(all, real(dt), end);
        state.step = k;
        state.time = end;
        (detail::tell(observers, state), ...);
    }
    detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
    return steps.count;
}

/// The same with steps chosen by a Courant number; looked at again every 20 steps.
template <class Solver, class... Body, class... Observer>
long integrate(Solver& mpm, std::tuple<Body&...> all, interval span, courant pace, Observer&&... observers) {
    using real = typename Solver::real;
    if (!(span.end > span.begin))
        throw error("integrate: the end is not after the beginning; give an interval {begin, end}");
    if (!(pace.number > 0))
        throw error(detail::sentence("integrate: the Courant number is ", pace.number, "; give a positive one"));
    if (pace.number > pace.limit)
        throw error(detail::sentence("integrate: the Courant number is ", pace.number, ", above the limit of ",
                                     pace.limit, "; give a smaller one"));
    const double h = detail::to_double(mpm.grid().spacing());
    mpm.start_at(span.begin);
    progress_state state{0, 0, span.begin, span};
    double from = span.begin, dt = 0;
    long done = 0, left = 0, since = 0;
    const auto choose = [&] {
        const double speed = detail::signal_speed<Solver::composition_type::moves>(std::as_const(all));
        detail::check_finite(std::as_const(all), mpm.steps(), mpm.time(), dt);
        from = state.time;
        since = 0;
        const double wanted = (span.end - from) * speed / (pace.number * h);
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
