#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/material/principal.hpp>
#include <tamis/run/critical_courant.hpp>
#include <tamis/run/initial.hpp>
#include <tamis/run/observer.hpp>
#include <tamis/run/solver.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace tamis::detail {

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

/// Cells of a body of `total_lagrangian` are strained with it: the least principal stretch of its particles, 1 at most.
template <class Body> double least_stretch_of(const Body& body) {
    constexpr int D = Body::dim;
    double least = 1;  // principal value of F^T F
    for (const auto p : body) {
        const matrix<D, typename Body::real> F = p[symbols::F], C = F.transpose() * F;
        matrix<3, double> square = matrix<3, double>::Identity();
        for (int c = 0; c < D * D; ++c) square(c % D, c / D) = to_double(C(c % D, c / D));
        // No principal value is below the mean by more than this: few particles need theirs.
        const double mean = square.trace() / 3, apart = (square - isotropic<matrix<3, double>>(mean)).norm();
        if (mean - std::sqrt(2. / 3) * apart > 0.95 * least) continue;
        for (const double value : principal(square).values) least = std::min(least, std::max(value, 0.));
    }
    return std::sqrt(least);
}

/// Fastest signal through the bodies, in cells of their grid (m/s).
template <class Motion, class... Body> double signal_speed(const std::tuple<Body&...>& all) {
    double fastest = 0;
    const auto one = [&](const auto& body) {
        double speed = 0, stretch = 1;
        if constexpr (Motion::moves)
            for (const auto p : body) speed = std::max(speed, detail::to_double(p[symbols::v].norm()));
        if constexpr (is_total_lagrangian<Motion>) stretch = least_stretch_of(body);
        fastest = std::max(fastest, wave_speed_of(body) / stretch + speed);
    };
    detail::each_of(all, one);
    return fastest;
}

/// Bodies of `total_lagrangian` that have come together are refused.
template <class Motion, class... Body> void check_apart([[maybe_unused]] const std::tuple<Body&...>& all,
                                                        [[maybe_unused]] long step, [[maybe_unused]] double t) {
    if constexpr (is_total_lagrangian<Motion> && sizeof...(Body) > 1) {
        using first = std::remove_cvref_t<std::tuple_element_t<0, std::tuple<Body&...>>>;
        const std::string told = overlapping<first::dim>(all).told();
        if (!told.empty())
            throw error(sentence("step ", step, ", t = ", t, ": ", told,
                                 ". Bodies of total_lagrangian do not touch each other; give moving{} with a contact"));
    }
}

/// How large a step may be.
struct step_limit {
    double inner = 1;  // Courant numbers above it are refused
    bool given = false, known = false;
    double free_end = 1;  // those above it may grow at free ends
    double share = 1;     // of an inner node's mass that the lightest free node has
};

/// The largest step (s) that one of several limits allows.
struct bounded_step {
    double dt = std::numeric_limits<double>::infinity();
    step_bound bound = step_bound::given;
    void heed(double largest, step_bound by) {
        if (largest < dt) *this = {largest, by};
    }
};

/// The largest step that roles ask for besides waves, at time t: a load by `largest_step(t)`, a law by
/// `largest_step(h, Dim)`. Infinity if none does.
template <class Solver, class... Body>
bounded_step largest_step(const Solver& mpm, const std::tuple<Body&...>& all, double t) {
    bounded_step least;
    if constexpr (requires { mpm.load(); })
        each_load(mpm.load(), [&](auto, const auto& load) {
            if constexpr (requires { load.largest_step(t); }) least.heed(load.largest_step(t), step_bound::load);
        });
    const auto of_law = [&](const auto& body) {
        const double h = to_double(mpm.grid().spacing());
        if constexpr (requires { body.law.largest_step(h, Solver::dim); })
            least.heed(body.law.largest_step(h, Solver::dim), step_bound::law);
    };
    each_of(all, of_law);
    return least;
}

/// What a composition's table says of these bodies where they are now.
template <class Solver, class... Body>
step_limit limit_of(Solver& mpm, const std::tuple<Body&...>& all, const std::optional<double>& given) {
    step_limit limit;
    if (given) {
        limit.inner = limit.free_end = *given;
        limit.given = true;
        return limit;
    }
    if constexpr (requires { mpm.lightest_free_node(all); }) {
        using C = typename Solver::composition_type;
        constexpr int D = Solver::dim;
        const double cell = std::pow(to_double(mpm.grid().spacing()), D);
        std::optional<critical_courant> numbers;
        double lightest = std::numeric_limits<double>::infinity();  // mass of an inner node of the lightest body
        double corner = 1;
        bool known = true;
        const auto one = [&](const auto& body) {
            corner = std::min(corner, critical_at_corner<D>(body.law));
            double most = 0, least = std::numeric_limits<double>::infinity();
            for (const auto p : body) {
                const double volume = to_double(p[symbols::V]);
                most = std::max(most, volume);
                least = std::min(least, volume);
                lightest = std::min(lightest, to_double(p[symbols::m]) / volume * cell);
            }
            for (const double volume : {most, least}) {
                const auto found = critical_of<C>(mpm.scheme(), std::pow(cell / volume, 1. / D));
                if (!found)
                    known = false;
                else
                    numbers = numbers ? smaller(*numbers, *found) : *found;
            }
        };
        detail::each_of(std::as_const(all), one);
        if (!known || !numbers) return limit;
        limit.known = true;
        limit.inner = limit.free_end = std::min(1., numbers->inner);
        limit.share = mpm.lightest_free_node(all) / lightest;
        // Corners of a box have 2^-D.
        if (limit.share < 0.5 * std::pow(0.5, D))
            limit.free_end = std::min(limit.inner, corner * numbers->free_end(limit.share));
        else
            limit.share = 1;
    }
    return limit;
}

template <class Solver> std::string composition_of(const Solver& mpm) {
    if constexpr (requires { mpm.scheme(); })
        return name_of_composition<typename Solver::composition_type>(mpm.scheme());
    else
        return "this solver";
}

template <class Solver>
void check_courant(const Solver& mpm, double number, const step_limit& limit, double dt, long step, double t) {
    if (number <= limit.inner) return;
    const char* why = limit.given   ? " that was given"
                      : limit.known ? ": small waves inside the body would grow"
                                    : ": nothing is known of a smaller one";
    throw error(sentence("step ", step, ", t = ", t, ": the Courant number (c + |V|) dt/h is ", number,
                         " with dt = ", dt, ", above the limit of ", limit.inner, " of ", composition_of(mpm), why,
                         "; take steps of at most ", dt * limit.inner / number));
}

/// What an automatic step is a share of. A node of hardly any mass would ask for no step at all: moving particles pass
/// such places in a few steps, so a tenth of the inner limit is kept.
inline double automatic_number(const step_limit& limit) { return std::max(limit.free_end, 0.1 * limit.inner); }

}  // namespace tamis::detail
