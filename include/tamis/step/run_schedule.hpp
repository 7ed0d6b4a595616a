#pragma once
#include <tamis/step/node_stages.hpp>
#include <tamis/step/particle_kernel.hpp>

#include <utility>

namespace tamis::detail {

/// A pass over the particles of all bodies: what its stages make of them, and what they add to nodes.
template <class Now, class Sums, class... Stage> void run_particle_pass(Now& now, stages<Stage...>, Sums sums) {
    constexpr bool gives = !std::same_as<Sums, fields<>>;
    if constexpr (gives) now.set_zero(sums);
    now.each_body([&](auto& body, auto& sweeps) {
        const auto kernel = kernel_of_parts<typename Now::S>(Stage::bind(now, body, sweeps)...);
        if constexpr (gives)
            sweeps.scatter(body, kernel);
        else
            sweeps.gather_each(body, kernel);
    });
    if constexpr (gives) now.exchange(sums);
}

/// Runs the passes of a schedule. `now` offers `each_sweeps(f)`, `each_body(f(body, sweeps))`, `set_zero(fields)`,
/// `exchange(fields)`, and `over_particles<Pass>(stages, sums)`, for which `run_particle_pass` will mostly do.
template <class Plan, class Now> class schedule_runner {
  public:
    static void run(Now& now) {
        [&]<int... Pass>(std::integer_sequence<int, Pass...>) {
            (run_pass<Pass>(now, typename Plan::template stages_of_pass<Pass>{}), ...);
        }
        (std::make_integer_sequence<int, Plan::count>{});
    }

  private:
    template <int Pass, class... Stage> static void run_pass(Now& now, stages<Stage...> all) {
        constexpr over kind = Plan::template kind<Pass>;
        if constexpr (kind == over::nodes) {
            using loads = typename Plan::template loads<Pass>;
            using saves = typename Plan::template saves<Pass>;
            const auto kernel = node_kernel_of(all, now);
            now.each_sweeps([&](auto& sweeps) { sweeps.template each_node<loads, saves>(kernel); });
        } else if constexpr (kind == over::particles)
            now.template over_particles<Pass>(all, typename Plan::template sums<Pass>{});
        else if constexpr (kind != over::storage)
            (Stage::run(now), ...);
    }
};

}  // namespace tamis::detail
