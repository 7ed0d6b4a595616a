#pragma once
#include <tamis/leaving/settle.hpp>
#include <tamis/run/look.hpp>
#include <tamis/run/seeding.hpp>
#include <tamis/run/warnings.hpp>
#include <tamis/step/passes.hpp>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tamis {

/// One composed step. Policies come in any order after the grid; those left out take their defaults (quadratic_spline,
/// flip, usl_plus, unbounded, unloaded, moving, serial, native_lanes, leaving_stops, checked).
///
///     solver mpm{uniform_grid{{0.}, {1.}, 0.02}, linear{}, fmpm<2>{}, usl_plus{}, ends};
///     auto bar = mpm.make_body(law, everywhere, per_cell{2});
///     mpm.step(bodies(bar), dt);
template <class Grid, class... Policies> class solver : public warning_channel {
  public:
    /// The composition, its types and dimension.
    /// @{
    using C = detail::composition<Grid, Policies...>;
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename C::real;
    using composition_type = C;
    static constexpr int dim = C::dim, width = S::width;
    template <class L, class... Extra> using body_for =
        body<S, typename C::shape, L, merge<typename C::step_fields, on_particles_t<L>, fields<Extra...>>>;
    /// @}
    /// Policies are copied. Throws `error` if they do not go together, or if memory for the nodes is missing.
    explicit solver(const Grid& grid, const Policies&... policies)
        : solver(grid, std::tuple<const Policies&...>(policies...)) {}
    solver(const solver&) = delete;
    solver& operator=(const solver&) = delete;
    /// The grid.
    const Grid& grid() const { return work_.lattice.grid(); }
    /// Time at the end of the last step (s).
    double time() const { return time_; }
    /// Steps done since the run began.
    long steps() const { return steps_; }
    /// A run begins at time t (s), and counts anew; at the time where the solver stands it goes on.
    void start_at(double t) {
        if (steps_ > 0 && t == time_) return;
        previous_ = time_ = t;
        steps_ = 0;
        crossings_ = 0;
        work_.restart();
        detail::restart_loads(by_.load);
    }
    /// Bytes a node takes.
    static constexpr std::size_t bytes_per_node() {
        return sizeof(real) * static_cast<std::size_t>(workspace_type::nodes_type::components);
    }
    /// Nodes that conditions hold: `at` (m), `reaction` (N, mean over the last step), `velocity` (m/s, held part).
    auto reactions() const { return work_.reactions(); }
    /// Work of the conditions since the start (J).
    double boundary_work() const { return work_.boundary_work(); }
    /// Nodes where bodies with velocities of their own touched in the last step (`touching_node`).
    auto touching() const requires C::own_velocities { return work_.contact.nodes(); }
    /// Work that friction between bodies has turned into heat since the start (J).
    double friction_heat() const requires C::own_velocities { return work_.contact.heat(); }
    /// Particles that went to another cell, since the start.
    std::size_t crossings() const { return crossings_; }
    /// Does `on_node` give this field?
    template <class F> static constexpr bool keeps(F) {
        return detail::schedule_of<C>::template kept<F> && !contains<fields<field::increment, field::image>, F> &&
               F::template components<S> == dim;
    }
    /// A vector field of node (i, j, k) after a step, of the first body where each has its own; 0 beyond their reach.
    /// `read_out<F...>{}` keeps it, `keeps` tells. Throws `error` for a node that the grid has not.
    template <class F> point<dim, real> on_node(F, const std::array<int, 3>& node) const {
        static_assert(!contains<fields<field::increment, field::image>, F>,
                      "tamis: the increment and its image are working memory of the mass matrix's series, and hold "
                      "nothing of meaning after a step; ask for inverse_column or read_out<field::full_acceleration>");
        static_assert(keeps(F{}) || contains<fields<field::increment, field::image>, F>,
                      "tamis: the composition keeps no such vector field on its nodes; ask for it by read_out<F>{}");
        if constexpr (keeps(F{}))
            return work_.fields[0].sweeps.nodes().template get<F>(work_.lattice.place_of_node(node));
        else
            return {};
    }
    /// Column of node (i, j, k) of the full mass matrix's inverse by the composed number of terms, without conditions
    /// (1/kg); per node of the grid, i fastest.
    template <class... Body>
    std::vector<real> inverse_column(std::tuple<Body&...> all, const std::array<int, 3>& node) requires C::mass::full {
        static_assert(!C::own_velocities && !C::exact,
                      "tamis: columns of the inverse are those of one velocity field and a series of terms");
        const std::size_t place = work_.lattice.place_of_node(node);
        prepare(all);
        return detail::inverse_column(detail::step_now<C, Body...>{work_, by_, all, real(1), time_}, place);
    }
    /// Steps that found their sums made by the step before, in the pass that updated the particles (docs/storage.md).
    long steps_in_one_pass() const { return work_.ahead.used; }
    /// Steps whose passes were run together, slab by slab (docs/storage.md, Waves).
    long steps_in_waves() const { return work_.steps_in_waves; }
    /// Mass of the lightest node that particles reach now and no condition holds (kg); infinity if there is none.
    template <class... Body> double lightest_free_node(std::tuple<Body&...> all) {
        prepare(all);
        if constexpr (C::moves) work_.sum_masses(all);
        return work_.lightest_free_node();
    }
    /// A sentence about loads on particles or faces that have found none in the bodies so far; empty if all have.
    std::string idle_loads() const { return targets_.missing(by_.load); }
    /// Terms of the series in the last step, and the last one's size; 0 unless it looks (`adaptive_fmpm`).
    const series_report& series() const { return work_.series; }
    /// The policies as they are now, and where nodes lie.
    /// @{
    const typename C::transfer& scheme() const { return by_.transfer; }
    const typename C::shape& functions() const { return by_.shape; }
    const typename C::load& load() const { return by_.load; }
    const auto& lattice() const { return work_.lattice; }
    /// @}

    /// A body of a law: of `count` particles per cell and axis those where region(place in m) is true; it is asked of
    /// places beyond the grid too, to warn where it ends there. Fields named in `fields<...>{}` are stored besides
    /// those the policies ask for. Throws `error` if there is no particle, or if a parameter of the law makes no sense.
    template <class L, class Region, class... Extra>
    auto make_body(const L& law, const Region& region, per_cell count, fields<Extra...> = {}) const {
        constexpr bool exchanged = HasDensity<Region> && !HasDensity<L>;
        static_assert(!exchanged,
                      "tamis: make_body(law, region, per_cell{n}) has its arguments exchanged; give the law first and "
                      "the region, a function of the place, after it");
        if constexpr (!exchanged) {
            const auto points = detail::points_in(grid(), region, count.count);
            warn_if_any(warning_kind::cut_region, [&] { return detail::region_beyond(grid(), region, count.count); });
            const real side = grid().spacing() / real(count.count);
            real volume(1);
            for (int d = 0; d < dim; ++d) volume *= side;
            return make_body_at(law, points, volume, fields<Extra...>{});
        }
    }
    /// A body with a particle at each point (m). Volumes (m^Dim), and densities if they are not the law's, are one
    /// number or a vector with one for each point. Throws `error` for a point outside the grid.
    ///
    ///     auto drop = mpm.make_body_at(water, {{0.1, 0.2}, {0.1, 0.21}}, 1e-4, fields<field::id>{});
    template <class L, class... Extra> auto make_body_at(const L& law, const std::vector<point<dim, real>>& points,
                                                         const detail::for_points<real>& volume,
                                                         fields<Extra...> = {}) const {
        return new_body<Extra...>(law, points, volume);
    }
    /// The same, with densities (kg/m^Dim) in place of the law's.
    template <class L, class... Extra>
    auto make_body_at(const L& law, const std::vector<point<dim, real>>& points, const detail::for_points<real>& volume,
                      const detail::for_points<real>& density, fields<Extra...> = {}) const {
        return new_body<Extra...>(law, points, volume, density);
    }

    /// One step of dt (s) for the bodies. Throws `error` if a stress or load is not a number (`checked`): the step is
    /// not done then; or if a particle's place is none, or leaves the grid where that is not allowed: the step is done,
    /// and the particle put back into the grid, to be looked at.
    template <class... Body> void step(std::tuple<Body&...> all, const real& dt) {
        step(all, dt, time_ + detail::to_double(dt));
    }
    /// Refused: the bodies go in one bundle.
    template <class NotBodies> void step(NotBodies&&, const real&) {
        static_assert(sizeof(NotBodies) == 0,
                      "tamis: step is called with the bodies in one bundle: mpm.step(bodies(a, b), dt)");
    }
    /// The same, to the given time, which `integrate` says without the round-off of adding up. `extern template` names
    /// it to keep it out of a file.
    template <class... Body> void step(std::tuple<Body&...> all, const real& dt, double end);

  private:
    using workspace_type = detail::workspace<C>;
    template <class Body> static constexpr bool serves =
        std::same_as<typename Body::lattice_type, typename workspace_type::lattice_type>&&
            std::same_as<merge<typename Body::field_list, typename C::step_fields>, typename Body::field_list>;
    detail::policies<C> by_;
    workspace_type work_;
    double previous_ = 0, time_ = 0;  // the last step's start, now
    long steps_ = 0;
    std::size_t crossings_ = 0;
    detail::load_targets<typename C::load, point<dim, real>> targets_;

    template <detail::role R, class Default> using by_role = typename C::template by_role<R, Default>;
    solver(const Grid& grid, const std::tuple<const Policies&...>& all)
        : by_{by_role<detail::role::shape, quadratic_spline>::of(all),
              by_role<detail::role::transfer, flip>::of(all),
              by_role<detail::role::load, unloaded>::of(all),
              by_role<detail::role::execution, serial>::of(all),
              by_role<detail::role::boundary, unbounded>::of(all),
              picked_method(all)},
          work_(by_, by_role<detail::role::contact, one_velocity>::of(all), grid) {
        if ((workspace_type::held_type::any || C::own_velocities || C::exact) && detail::any_axis_wraps(work_.lattice))
            throw error(
                "solver: a periodic grid goes with bodies that nothing holds, in one velocity field, and no exact mass "
                "matrix; leave the conditions or the contact out, or do not wrap the grid");
    }
    static auto picked_method(const std::tuple<const Policies&...>& all) {
        if constexpr (C::exact)
            return typename C::method{};
        else
            return by_role<detail::role::boundary_method, boundary_method::incremental>::of(all);
    }

    template <class... Extra, class L, class... Numbers>
    auto new_body(const L& law, const std::vector<point<dim, real>>& points, const Numbers&... numbers) const {
        auto b = detail::new_body<body_for<L, Extra...>, typename C::motion>(law, work_.lattice, by_.shape, by_.run,
                                                                             points, numbers...);
        detail::load_body(b, by_.load);
        return b;
    }
    template <class... Body> void prepare(std::tuple<Body&...>& all) {
        work_.prepare(all, [&] {
            detail::look_at_bodies(all, grid(), by_.load, targets_, *this, {steps_, time_, 0});
            if (steps_ == 0) warn_if_any(warning_kind::idle_condition, [&] { return work_.fields[0].held.idle(); });
        });
    }
    /// A step was broken off: particles go to the cells where they are by now, and nothing that is half made is used.
    template <class... Body> TAMIS_SELDOM void recover(std::tuple<Body&...>& all, double dt) {
        work_.forget();
        std::string ignored;  // what broke the step off is told
        work_.each_body(all, [&](auto& b, auto& field) {
            detail::collect_strays<C::moves>(b.store(), work_.lattice);
            if constexpr (C::moves) deliver(b, field, dt, ignored);
        });
    }
    template <class B, class Field> void deliver(B& b, Field& field, double dt, std::string& failure) {
        crossings_ += detail::sort_mail(b.store(), work_.lattice, C::leaving::when_leaving, {steps_, time_, dt},
                                        failure, by_.run, field.held);
        b.store().tidy(work_.lattice, by_.run);
    }
};

template <class Grid, class... Policies> template <class... Body>
void solver<Grid, Policies...>::step(std::tuple<Body&...> all, const real& dt, double end) {
    static_assert(sizeof...(Body) > 0, "tamis: step and integrate need a body; give bodies(a, ...)");
    static_assert((serves<Body> && ...),
                  "tamis: a body was made by a solver of other policies, and lacks fields that "
                  "this one steps; make it with this solver's make_body");
    detail::check_step(detail::to_double(dt), time_, end);
    prepare(all);
    if constexpr (requires { by_.transfer.begin_step(steps_); }) by_.transfer.begin_step(steps_);
    constexpr bool euler = C::order::explicit_euler;
    detail::step_now<C, Body...> now{work_, by_, all, dt, time_, euler ? previous_ : time_, euler ? time_ : end};
    try {
        detail::run_step(now);
    } catch (...) {
        recover(all, detail::to_double(dt));
        detail::tell_of_broken_step(std::as_const(all), {steps_, time_, detail::to_double(dt)});
    }
    previous_ = time_;
    time_ = end;
    ++steps_;
    if constexpr (C::moves) {
        if (work_.ahead.made) return;  // nobody left its cell
        std::string failure;
        work_.each_body(all, [&](auto& b, auto& field) { deliver(b, field, detail::to_double(dt), failure); });
        if (!failure.empty()) throw error(failure);
    }
}

template <class Grid, class... Policies> solver(const Grid&, const Policies&...) -> solver<Grid, Policies...>;

}  // namespace tamis
