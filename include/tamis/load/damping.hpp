#pragma once
#include <tamis/core/error.hpp>
#include <tamis/load/load.hpp>

#include <cmath>
#include <limits>

namespace tamis {

namespace detail {

/// A rate (1/s), given as a number or as a function of time.
template <class Alpha> class damping_rate {
  public:
    damping_rate(std::string_view owner, const Alpha& alpha) : owner_(owner), alpha_(alpha) {
        if constexpr (!std::invocable<const Alpha&, double>) check(static_cast<double>(alpha_));
    }
    double at(double t) const {
        if constexpr (std::invocable<const Alpha&, double>) {
            const double alpha = static_cast<double>(alpha_(t));
            check(alpha, t);
            return alpha;
        } else
            return static_cast<double>(alpha_);
    }

  private:
    std::string_view owner_;
    Alpha alpha_;
    template <class... When> void check(double alpha, When... t) const {
        if (alpha >= 0 && std::isfinite(alpha)) return;
        if constexpr (sizeof...(When) > 0)
            throw error(
                sentence(owner_, ": alpha is ", alpha, " at t = ", t..., "; give 0 or a positive, finite rate"));
        else
            throw error(sentence(owner_, ": alpha is ", alpha, "; give 0 or a positive, finite rate"));
    }
};

template <class Alpha>
concept DampingRate = std::convertible_to<Alpha, double> || std::invocable<const Alpha&, double>;

}  // namespace detail

/// The force -alpha m v on every node, v its velocity at the step's start. `alpha` (1/s): a number, or a function of
/// time. A mode of frequency w dies as exp(-alpha t/2), fastest without ringing at alpha = 2 w. Throws `error` if alpha
/// is negative or not finite, and if alpha dt > 1: a step must not turn velocities round.
template <detail::DampingRate Alpha> class grid_damping {
  public:
    static constexpr std::string_view name = "grid_damping";
    /// alpha (1/s).
    explicit grid_damping(Alpha alpha) : rate_(name, alpha) {}
    double damping(double t) const { return rate_.at(t); }
    /// 1/alpha: a larger step would turn velocities round (s).
    double largest_step(double t) const { return 1 / rate_.at(t); }

  private:
    detail::damping_rate<Alpha> rate_;
};
template <class Alpha> grid_damping(Alpha) -> grid_damping<Alpha>;

/// The acceleration -alpha V of particles, a body load: the force on nodes is -alpha S^T M V, which is that of
/// `grid_damping` where no node is held, and a little dearer. `alpha` as there.
template <detail::DampingRate Alpha> class particle_damping {
  public:
    static constexpr std::string_view name = "particle_damping";
    static constexpr bool in_lanes = true;
    /// alpha (1/s).
    explicit particle_damping(Alpha alpha) : rate_(name, alpha) {}
    template <class V> V acceleration(const V&, const V& v, double t) const {
        return v * constant<typename V::Scalar>(-rate_.at(t));
    }
    double largest_step(double t) const { return 1 / rate_.at(t); }

  private:
    detail::damping_rate<Alpha> rate_;
};
template <class Alpha> particle_damping(Alpha) -> particle_damping<Alpha>;

/// Grid damping whose rate follows the kinetic energy T (J) of the nodes, so that T comes to a target, as in
/// Nairn's codes:
///
///     d alpha/dt = gain * 2 (T - target)/M,    0 <= alpha <= maximum
///
/// M is the mass of all nodes, so 2 T/M is the mean square of the velocity and `gain` is in 1/m^2: alpha grows by
/// `maximum` in a time t at a mean speed u for gain = maximum/(u^2 t). Explicit Euler in time: a step takes alpha of
/// its start. The state is the solver's; a new run (`start_at`) begins with `start`. With target 0 alpha only grows.
class kinetic_feedback {
  public:
    static constexpr std::string_view name = "kinetic_feedback";
    /// target (J), gain (1/m^2), maximum and start (1/s). Throws `error` if they make no sense.
    kinetic_feedback(double target, double gain, double maximum, double start = 0)
        : target_(target), gain_(gain), maximum_(maximum), start_(start), alpha_(start) {
        const auto bad = [](const auto&... parts) { return error(detail::sentence("kinetic_feedback: ", parts...)); };
        if (!(target >= 0 && std::isfinite(target)))
            throw bad("the target is ", target, " J; give 0 or a positive energy");
        if (!(gain > 0 && std::isfinite(gain))) throw bad("the gain is ", gain, "; give a positive one, in 1/m^2");
        if (!(maximum > 0 && std::isfinite(maximum)))
            throw bad("the maximum of alpha is ", maximum, "; give a positive rate");
        if (!(start >= 0 && start <= maximum))
            throw bad("alpha starts as ", start, "; give a rate from 0 to the maximum, ", maximum);
    }
    /// The present rate (1/s).
    double alpha() const { return alpha_; }
    double damping(double) const { return alpha_; }
    double largest_step(double) const { return 1 / maximum_; }
    void sees(double kinetic, double mass, double dt) {
        if (!(mass > 0)) return;
        const double next = alpha_ + dt * gain_ * 2 * (kinetic - target_) / mass;
        // Energies that are not numbers must not become a rate.
        if (std::isfinite(next)) alpha_ = next < 0 ? 0 : next > maximum_ ? maximum_ : next;
    }
    void restart() { alpha_ = start_; }

  private:
    double target_, gain_, maximum_, start_, alpha_;
};

}  // namespace tamis
