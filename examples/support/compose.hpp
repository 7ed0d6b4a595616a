#pragma once
#include "recorder.hpp"

/// One composed step for each update and stress order that the options can name.
namespace compose {

#if defined(_OPENMP)
inline tamis::threads execution(int count) { return tamis::threads(std::max(1, count)); }
#else
inline tamis::serial execution(int) { return {}; }
#endif

template <class Solver> bar_result run(Solver& mpm, const bar_scene& scene, const bar_options& o) {
    const tamis::linear_elastic law{.young = bar_scene::young, .poisson = 0, .density = bar_scene::density};
    auto bar = mpm.make_body(law, tamis::everywhere, tamis::per_cell{o.per_cell});
    recorder records(mpm.lattice(), mpm.functions(), bar, scene, o,
                     {[&mpm] { return mpm.boundary_work(); }, [&mpm] { return mpm.crossings(); }});
    return records.follow(mpm.bytes_per_node(), [&](const bar_observer& look) {
        return tamis::integrate(mpm, tamis::bodies(bar), {0, o.time}, tamis::fixed_steps{steps_of(o)}, look,
                                tamis::progress_bar{});
    });
}

template <class F> bar_result with_update(const bar_options& o, F f) {
    if (o.update == "pic") return f(tamis::pic{});
    if (o.update == "flip") return f(tamis::flip{});
    if (o.update == "blend") return f(tamis::blend{o.alpha});
    if (o.update == "xpic") return f(tamis::xpic<tamis::dynamic>{o.order});
    return f(tamis::fmpm<tamis::dynamic>{o.order});
}
/// Conditions have a choice of methods where the mass matrix is full.
template <class Update> auto boundary_method_for(const Update&, const bar_options& o) {
    if constexpr (Update::mass_type::full)
        return tamis::boundary_method::chosen{o.boundary};
    else
        return tamis::boundary_method::incremental{};
}
template <class F> bar_result with_stress_order(const bar_options& o, F f) {
    if (o.stress == "usf") return f(tamis::usf{});
    if (o.stress == "usl-") return f(tamis::usl_minus{});
    if (o.stress == "usl+") return f(tamis::usl_plus{});
    if (o.stress == "usavg-") return f(tamis::usavg_minus{});
    if (o.stress == "usavg+") return f(tamis::usavg_plus{});
    return f(tamis::euler{});
}

}  // namespace compose

template <class Shape, class Motion, class Real> bar_result run_bar_with(const bar_scene& scene, const bar_options& o) {
    const tamis::uniform_grid<1, Real> grid{
        {Real(0)}, {Real(bar_scene::length)}, Real(bar_scene::length) / Real(o.cells)};
    return compose::with_update(o, [&](auto update) {
        return compose::with_stress_order(o, [&](auto order) {
            const auto boundary = compose::boundary_method_for(update, o);
            tamis::solver mpm{grid,
                              Shape{},
                              update,
                              order,
                              scene.ends(o.amplitude),
                              boundary,
                              Motion{},
                              compose::execution(o.threads)};
            return compose::run(mpm, scene, o);
        });
    });
}
