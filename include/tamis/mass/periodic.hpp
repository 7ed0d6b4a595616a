#pragma once
#include <tamis/mass/mass.hpp>
#include <tamis/update/schemes.hpp>

namespace tamis {

namespace detail {

/// A full mass matrix in the steps that are due, a lumped one between.
template <int K> struct periodic_mass : full_mass<K> {
    using full_mass<K>::full_mass;
    bool due = true;
    template <class From, class To> void filter(bool felt, auto& pass) const {
        if (due)
            full_mass<K>::template filter<From, To>(felt, pass);
        else if constexpr (!std::same_as<From, To>)
            pass.nodes(copy_field<From, To>{});
    }
};

/// FMPM's update in the steps that are due, FLIP's between.
struct periodic_update {
    static constexpr std::string_view text = "by turns: V = S v; U = (V + V') dt/2, and V += S a dt; U = S v dt";
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::velocity, const field::acceleration>;
    bool due = true;
    double start_share() const { return due ? 1 : 0; }
    auto velocity(auto p, auto near, auto dt) const {
        using namespace symbols;
        auto after = near.sum(v);
        if (!due) after = p[v] + dt * near.sum(a);
        return after;
    }
    auto displacement(const auto& before, const auto& after, auto near, auto dt) const {
        auto moved = near.sum(symbols::v);
        if (due) moved = (before + after) / 2;
        return (moved * dt).eval();
    }
};

}  // namespace detail

/// FMPM(K) every `period`-th step, FLIP between. It takes noise out at a fraction of the
/// cost.
template <int K> struct periodic_fmpm : transfer<detail::periodic_mass<K>, detail::periodic_update> {
    static_assert(K == dynamic || K > 1, "tamis: periodic_fmpm<K> needs K > 1; PIC steps between FLIP steps are blend");
    static constexpr std::string_view name = "periodic_fmpm";
    /// Throws `error` if the period is below 1.
    explicit periodic_fmpm(long period) requires(K != dynamic) : period_(checked(period)) {}
    /// The same with k terms, known at run time.
    periodic_fmpm(int k, long period) requires(K == dynamic)
        : transfer<detail::periodic_mass<K>, detail::periodic_update>{detail::periodic_mass<K>(k), {}},
          period_(checked(period)) {}
    /// Called by the solver with the number of steps done.
    void begin_step(long done) { this->mass.due = this->particle.due = (done + 1) % period_ == 0; }

  private:
    long period_;
    static long checked(long period) {
        if (period < 1)
            throw error(detail::sentence("periodic_fmpm: the period is ", period, " steps; give 1 or more"));
        return period;
    }
};

}  // namespace tamis
