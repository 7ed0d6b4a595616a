#pragma once
#include <tamis/conservation/kernels.hpp>
#include <tamis/engine/wrap.hpp>
#include <tamis/step/run_schedule.hpp>

#include <utility>

namespace tamis::detail {

/// A step of the Taylor-Galerkin scheme under way: what stages, and the mass policy's series, see of it.
template <class Space, class Sweeps, class Body, class Ends, class Law, class Mass, class Real> struct galerkin_now {
    using S = Space;
    using T = typename S::scalar;
    static constexpr int count = Law::unknowns;
    using rate = field::rate<count>;
    using term = field::change_term<count>;

    Sweeps& sweeps;
    Body& body;
    Ends& ends;
    const Law& law;
    const Mass& mass;
    Real dt;
    double time, end;
    bool image_is_made_zero = false;

    T lanes_dt() const { return T(dt); }
    Real half() const { return dt / Real(2); }
    template <class F> void each_sweeps(F f) { f(sweeps); }
    template <class F> void each_body(F f) { f(body, sweeps); }
    template <class... F> void set_zero(fields<F...>) { sweeps.template set_zero<F...>(); }
    template <class... F> void exchange(fields<F...> sums) { wrap(body.lattice(), sweeps.nodes(), sums); }
    template <int, class Stages, class Sums> void over_particles(Stages all, Sums sums) {
        run_particle_pass(*this, all, sums);
    }
    void flow_through_ends() { ends.flow(law, sweeps.nodes(), dt, time + (end - time) / 2); }
    void hold_unknowns() { ends.hold(sweeps.nodes(), end); }
    void hold_change() { ends.hold_change(sweeps.nodes(), end); }
    void further_terms() { add_series<field::change<count>, term, term, rate>(mass.terms(), true, *this); }

    // What the series of the mass policy uses.
    template <class Kernel> void nodes(Kernel kernel) { sweeps.each_node(kernel); }
    template <class From> void spread() {
        static_assert(std::same_as<From, term>);
        if (!std::exchange(image_is_made_zero, false)) set_zero(fields<rate>{});
        sweeps.scatter(body, spread_change_term<S, count>{});
        exchange(fields<rate>{});
    }
    static constexpr bool clears_image = true;
    void image_is_zero() { image_is_made_zero = true; }
    static constexpr bool reads_last_increment = true;
    template <class, class = term> void hold_increment(bool) { hold_change(); }
};

}  // namespace tamis::detail
