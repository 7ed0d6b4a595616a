#pragma once
#include <tamis/engine/waves.hpp>
#include <tamis/step/now.hpp>
#include <tamis/step/run_schedule.hpp>

#include <cstddef>
#include <tuple>
#include <vector>

namespace tamis::detail {

/// A step under way, with what the engine does ahead of time in passes over particles: sums that the step before made,
/// and the entries of the full mass matrix, summed by the way.
template <class C, class... Body> struct step_passes : step_now<C, Body...> {
    using base = step_now<C, Body...>;
    using plan = schedule_of<C>;
    using typename base::S;
    bool sums_are_made = false;

    step_passes(const base& now, bool made) : base(now), sums_are_made(made) {}

    void run() {
        schedule_runner<plan, step_passes>::run(*this);
        this->end();
    }
    template <int Pass, class... Stage, class Sums> void over_particles(stages<Stage...> all, Sums sums) {
        constexpr bool opens = Pass == 0;
        if constexpr (opens && C::sums_ahead)
            if (sums_are_made) return;
        // What throws while particles move must not leave a matrix of where they were.
        if constexpr ((std::same_as<Stage, move> || ...)) this->work.weights_change();
        if constexpr (C::assembles && (std::same_as<Stage, p2g<field::mass>> || ...)) {
            if (matrix_type::is_due(this->by.transfer.mass)) return sum_and_assemble(all, sums);
        }
        if constexpr (makes_sums_ahead && Pass == last_over_particles)
            this->each_body([&](auto& body, auto& sweeps) {
                update_and_sum_ahead(body, sweeps, all, typename plan::template stages_of_pass<0>{});
            });
        else
            run_particle_pass(*this, all, sums);
    }

  private:
    using matrix_type = assembled_matrix<C>;
    static constexpr bool makes_sums_ahead = C::sums_ahead && sizeof...(Body) == 1 && !(Body::needs_flow || ...);
    static constexpr int last_over_particles = [] {
        int last = 0;
        for (int k = 0; k < plan::count; ++k)
            if (plan::plan.kind[static_cast<std::size_t>(k)] == over::particles) last = k;
        return last;
    }();

    /// The pass with the masses, and the entries of the full mass matrix: until it is done there is no matrix.
    template <class... Stage, class... F> void sum_and_assemble(stages<Stage...>, fields<F...> sums) {
        this->work.matrix.begin();
        this->set_zero(fields<F..., field::mass_entries<C::shape::support>>{});
        this->each_body([&](auto& body, auto& sweeps) {
            sweeps.scatter_and_assemble(body, kernel_of_parts<S>(Stage::bind(*this, body, sweeps)...));
        });
        this->work.matrix.made();
        this->exchange(sums);
    }
    /// The last pass, and the sums that the next step begins with.
    template <class B, class Sweeps, class... Stage, class... Opening>
    void update_and_sum_ahead(B& body, Sweeps& sweeps, stages<Stage...>, stages<Opening...>) {
        auto& ahead = this->work.ahead;
        ahead.made = sweeps.gather_and_scatter(body, kernel_of_parts<S>(Stage::bind(*this, body, sweeps)...),
                                               kernel_of_parts<S>(Opening::bind(*this, body, sweeps)...), ahead.pays);
    }
};

/// Runs a step, its passes together in waves where that pays. What throws meanwhile leaves no pass to be run, and no
/// sums that were not finished.
template <class C, class... Body> void run_step(const step_now<C, Body...>& now) {
    constexpr bool one = sizeof...(Body) == 1;
    auto& work = now.work;
    auto& first = std::get<0>(now.bodies);
    bool sums_are_made = false;
    if constexpr (C::sums_ahead && one && !(Body::needs_flow || ...))
        sums_are_made = work.sums_are_made(first.store());
    else
        work.ahead.made = false;
    if constexpr (one && !C::own_velocities) {
        waves_of_step waves(work.waiting, work.fields[0].sweeps, first, now.by.run);
        if (waves.runs()) ++work.steps_in_waves;
        step_passes<C, Body...>(now, sums_are_made).run();
    } else
        step_passes<C, Body...>(now, sums_are_made).run();
    if constexpr (C::sums_ahead) work.ahead.updates = first.store().updates;
}

/// Column of the full mass matrix's inverse at a node's storage place, where the particles are now and without
/// conditions (1/kg), per node of the grid.
template <class C, class... Body> auto inverse_column(step_now<C, Body...> now, std::size_t place) {
    auto& work = now.work;
    if constexpr (C::moves) {
        work.weights_change();  // another solver may have moved the particles
        work.sum_masses(now.bodies);
        work.fields[0].sweeps.each_node(invert_mass{});
    }
    const auto places = mass_operator<step_now<C, Body...>>(now).inverse_column(place);
    std::vector<typename C::real> column;
    work.lattice.grid().each_node([&](const auto& index) { column.push_back(places[work.lattice.node_place(index)]); });
    return column;
}

}  // namespace tamis::detail
