#pragma once
#include <tamis/run/observer.hpp>
#include <tamis/run/step_limit.hpp>
#include <tamis/run/warnings.hpp>

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

namespace tamis {

namespace detail {

/// While it lives, those of some observers that take warnings are told instead of standard error, if there are any.
template <class Solver> class listening {
  public:
    template <class... Observer> explicit listening(const Solver& mpm, Observer&... observers) : mpm_(mpm) {
        if constexpr (warns && (TakesWarnings<Observer> || ...)) {
            before_ = mpm.when_warned([&](const warning& what) {
                const auto one = [&](auto& observer) {
                    if constexpr (TakesWarnings<std::remove_reference_t<decltype(observer)>>) observer(what);
                };
                (one(observers), ...);
            });
            listens_ = true;
        }
    }
    listening(const listening&) = delete;
    listening& operator=(const listening&) = delete;
    ~listening() {
        if constexpr (warns)
            if (listens_) mpm_.when_warned(std::move(before_));
    }

  private:
    static constexpr bool warns = requires(const Solver& mpm) { mpm.warnings(); };
    const Solver& mpm_;
    std::function<void(const warning&)> before_;
    bool listens_ = false;
};

template <class Solver, class Sentence>
void warn_once(Solver& mpm, double number, double limit, warning_kind kind, const Sentence& sentence_of) {
    if constexpr (requires { mpm.has_warned(kind); })
        if (!mpm.has_warned(kind)) mpm.warn({sentence_of(), number, limit, kind});
}
/// Loads that wait for what they act on are told of at the end.
template <class Solver> void warn_of_idle_loads(Solver& mpm) {
    if constexpr (requires { mpm.idle_loads(); }) {
        const std::string idle = mpm.idle_loads();
        if (!idle.empty()) mpm.warn({sentence("t = ", mpm.time(), ": ", idle), 0, 0, warning_kind::idle_load});
    }
}
/// Steps are too large for a free end.
template <class Solver> void warn_of_free_end(Solver& mpm, double number, const step_limit& limit, double dt) {
    if (!(number > limit.free_end)) return;
    const auto sentence_of = [&] {
        return sentence(composition_of(mpm), ": the Courant number ", number, " is above ", limit.free_end,
                        ", beyond which disturbances may grow at a free end, for a node there has only ", limit.share,
                        " of an inner node's mass; take steps of at most ", dt * limit.free_end / number,
                        ", or strain by particles' velocities (usf, usl_plus, usavg_plus), or take smoother functions "
                        "(docs/stability.md)");
    };
    warn_once(mpm, number, limit.free_end, warning_kind::free_end, sentence_of);
}
/// An automatic step is taken of a composition whose limit is not known.
template <class Solver> void warn_of_unknown_limit(Solver& mpm, double number, const step_limit& limit) {
    if (limit.known || limit.given) return;
    const auto sentence_of = [&] {
        return sentence(composition_of(mpm), ": nothing is known of how large a step of this composition may ",
                        "be; courant{} takes the Courant number ", number,
                        ", which may be too large. Give a number, "
                        "courant{0.3}, or a limit; stability::critical_numbers finds them (docs/stability.md)");
    };
    warn_once(mpm, number, limit.inner, warning_kind::unknown_limit, sentence_of);
}

}  // namespace detail
}  // namespace tamis
