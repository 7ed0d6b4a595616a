#pragma once
#include <tamis/conservation/taylor_galerkin.hpp>
#include <tamis/run/integrate.hpp>

namespace tamis {

/// Steps a Taylor-Galerkin scheme from span.begin to span.end; as `integrate` of a solver. Stable Courant numbers are
/// in docs/taylor-galerkin.md.
template <class G, class L, class... P, class... Observer>
long integrate(taylor_galerkin<G, L, P...>& scheme, interval span, fixed_steps steps, Observer&&... observers) {
    using real = typename G::real;
    detail::check_span(span);
    detail::check_count(steps);
    const double h = detail::to_double(scheme.grid().spacing());
    scheme.start_at(span.begin);
    const auto look = [&](long done, double t, double dt) {
        scheme.check_finite(dt);
        if (done == steps.count) return;
        const double number = scheme.wave_speed() * dt / h, limit = steps.limit.value_or(1);
        if (!(number <= limit))
            throw error(detail::sentence("step ", done, ", t = ", t, ": the Courant number c dt/h is ", number,
                                         " with dt = ", dt, ", above the limit of ", limit, "; take steps of at most ",
                                         dt * limit / number));
    };
    const auto step = [&](double dt, double end) { scheme.step(real(dt), end); };
    const long done = detail::in_equal_steps(span, steps.count, 100, look, step, observers...);
    (detail::commit_own<Observer>(observers), ...);
    return done;
}

/// The same with equal steps of the Courant number that the start has, at most.
template <class G, class L, class... P, class... Observer>
long integrate(taylor_galerkin<G, L, P...>& scheme, interval span, courant pace, Observer&&... observers) {
    if (!pace.number)
        throw error(
            "integrate: a Taylor-Galerkin scheme does not choose its own steps; give courant{number}, stable numbers "
            "are "
            "in docs/taylor-galerkin.md");
    const double limit = pace.limit.value_or(1);
    if (!(*pace.number > 0 && *pace.number <= limit))
        throw error(detail::sentence("integrate: the Courant number is ", *pace.number,
                                     "; give a positive one, not above the limit of ", limit));
    const double h = detail::to_double(scheme.grid().spacing());
    const double wanted = (span.end - span.begin) * scheme.wave_speed() / (*pace.number * h);
    if (!(wanted < 1e15)) throw error("integrate: the law's wave speed is not finite; check the law and the states");
    const long steps = std::max(1L, static_cast<long>(std::ceil(wanted * (1 - 1e-12))));
    return integrate(scheme, span, fixed_steps{steps, limit}, std::forward<Observer>(observers)...);
}

}  // namespace tamis
