#pragma once
#include <tamis/step/words.hpp>

namespace tamis::detail {

/// One step of dt. Stages stand in the order of the papers; those that a composition has no use for are absent, and
/// what nobody reads is not run. (Letters: docs/method.md; which passes follow from it: explain(mpm).)
template <class C> struct step_text : words<C> {
    using typename words<C>::momentum;
    using typename words<C>::start_velocity;
    using typename words<C>::strain_velocity;
    using typename words<C>::force;
    using typename words<C>::acceleration;
    using typename words<C>::velocity;
    using typename words<C>::new_momentum;
    using typename words<C>::new_velocity;
    using of = words<C>;
    using type =
        stages<typename of::masses,                 // m = S^T M, 1/m: in every step, if particles move
               p2g<momentum, typename C::carried>,  // p = S^T M V          (APIC: V + C (x - X))
               touch<C, momentum>,                  // bodies that meet at a node
               hold<C, momentum>,                   // conditions of time t
               divide<momentum, start_velocity>,    // v0 = p/m

               filter<C, start_velocity, strain_velocity>,                    // full mass matrix: v_s = v0(k)
               strain<C, typename of::before, typename of::velocity_before>,  // USF and USAVG

               p2g<force, typename of::load, typename C::motion>,  // f = -G^T V0 tau + loads
               damp_nodes<C>,                                      // f -= alpha p
               touch<C, force>, hold<C, force>,                    // conditions of t + dt
               check<C, divide<force, acceleration>>,              // a = f/m
               advance<start_velocity, velocity>,                  // v = v0 + a dt
               solve<C>,                                           // FMPM: v = v(k). XPIC: v_x = v0(k) + a dt
               g2p<typename C::update, typename C::motion, typename C::shape>,  // V', U

               p2g<new_momentum, typename C::carried>,  // p_n = S^T M V'       (USL+ and USAVG+)
               touch<C, new_momentum>, hold<C, new_momentum>, divide<new_momentum, new_velocity>,  // v_n = p_n/m
               filter<C, new_velocity, new_velocity>,
               strain<C, typename of::after, typename of::velocity_after>,  // USL-: by v. USL+: by v_n

               typename of::motion>;  // X' = X + U; particles go to their cells
};

/// The passes of a composition's step.
template <class C> using schedule_of =
    schedule<typename C::S, typename step_text<C>::type, typename C::read, C::sums_ahead>;

}  // namespace tamis::detail
