#pragma once
#include <tamis/boundary/held_nodes.hpp>
#include <tamis/contact/touching_nodes.hpp>
#include <tamis/core/each_of.hpp>
#include <tamis/solver/checks.hpp>
#include <tamis/solver/kernels.hpp>
#include <tamis/solver/leaving.hpp>
#include <tamis/solver/loading.hpp>
#include <tamis/solver/passes.hpp>
#include <tamis/solver/seeding.hpp>
#include <tamis/solver/sweeps.hpp>
#include <tamis/solver/velocity_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tamis {

/// One composed step. Policies come in any order after the grid; those left out take their defaults (quadratic_spline,
/// flip, usl_minus, unbounded, unloaded, moving, serial, native_lanes, leaving_stops).
///
///     solver mpm{uniform_grid{{0.}, {1.}, 0.02}, linear{}, fmpm<2>{}, usl_minus{}, ends};
///     auto bar = mpm.make_body(law, everywhere, per_cell{2});
///     mpm.step(bodies(bar), dt);
template <class Grid, class... Policies> class solver {
  public:
    using C = detail::composition<Grid, Policies...>;
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename C::real;
    using composition_type = C;
    static constexpr int dim = C::dim, width = S::width;
    template <class L, class... Extra> using body_for =
        body<S, typename C::shape, L, merge<typename C::step_fields, on_particles_t<L>, fields<Extra...>>>;

    explicit solver(const Grid& grid, const Policies&... policies)
        : solver(grid, std::tuple<const Policies&...>(policies...)) {}
    solver(const solver&) = delete;
    solver& operator=(const solver&) = delete;

    const Grid& grid() const { return lattice_.grid(); }
    /// Time at the end of the last step (s), and number of steps done.
    double time() const { return time_; }
    long steps() const { return steps_; }
    /// A run begins at time t: steps, crossings and work are counted from here. At the time where the solver stands the
    /// run goes on.
    void start_at(double t) {
        if (steps_ > 0 && t == time_) return;
        start_ = previous_ = time_ = t;
        steps_ = 0;
        crossings_ = 0;
        ahead_.used = 0;
        steps_in_waves_ = 0;
        for (auto& field : fields_) field.held.restart();
        if constexpr (C::own_velocities) contact_.restart();
        detail::restart_loads(load_);
    }
    /// Bytes a node takes.
    static constexpr std::size_t bytes_per_node() {
        return sizeof(real) * static_cast<std::size_t>(sweeps_type::nodes_type::components);
    }
    /// Nodes that conditions hold, with the reactions of the last step.
    auto reactions() const {
        auto all = fields_[0].held.reactions();
        for (std::size_t f = 1; f < fields_.size(); ++f) {
            const auto more = fields_[f].held.reactions();
            for (std::size_t k = 0; k < all.size(); ++k) all[k].reaction += more[k].reaction;
        }
        return all;
    }
    /// Work of the conditions since the start (J).
    double boundary_work() const {
        double work = 0;
        for (const auto& field : fields_) work += field.held.work();
        return work;
    }
    /// Nodes where bodies with velocities of their own touched in the last step.
    auto touching() const requires C::own_velocities { return contact_.nodes(); }
    /// Work that friction between bodies has turned into heat since the start (J).
    double friction_heat() const requires C::own_velocities { return contact_.heat(); }
    /// Particles that went to another cell, since the start.
    std::size_t crossings() const { return crossings_; }
    /// A node field as the last step left it, at node (i, j, k): a vector. Nodes outside the bodies' reach have 0.
    /// Where bodies have velocities of their own it is the first one's. Throws `error` for a node that the grid has
    /// not.
    template <class F> point<dim, real> on_node(F, const std::array<int, 3>& node) const {
        static_assert(stores<typename C::node_fields, F> && F::template components<S> == dim,
                      "tamis: the composition has no such vector field on its nodes; ask for it by read_out<F>{}");
        static_assert(!contains<fields<field::increment, field::image>, F>,
                      "tamis: the increment and its image are working memory of the mass matrix's series, and hold "
                      "nothing of meaning after a step; inverse_column, or read_out<field::full_acceleration>, tell of "
                      "the matrix");
        return fields_[0].sweeps.nodes().template get<F>(lattice_.place_of_node(node));
    }
    /// Column of the full mass matrix's inverse by the composed number of terms, that of node (i, j, k), where the
    /// particles are now and without conditions (1/kg); per node of the grid, i fastest. Its sum over columns times m
    /// is 1 in every row.
    template <class... Body>
    std::vector<real> inverse_column(std::tuple<Body&...> all, const std::array<int, 3>& node) requires C::mass::full {
        static_assert(!C::own_velocities && !C::exact,
                      "tamis: columns of the inverse are those of one velocity field and a series of terms");
        const std::size_t place = lattice_.place_of_node(node);
        prepare(all);
        detail::passes<solver, Body...> now{*this, all, real(1)};
        if constexpr (C::moves) {
            weights_change();  // another solver may have moved the particles
            now.sum_masses();
            now.nodes(detail::invert_mass{});
        }
        const std::vector<real> places = now.inverse_column(place);
        std::vector<real> column;
        grid().each_node([&](const auto& index) { column.push_back(places[lattice_.node_place(index)]); });
        return column;
    }
    /// Steps that found their sums over the particles made by the step before, in the pass that updated them. Always 0
    /// where the composition cannot do so: in 2D and 3D, under loads, with a full mass matrix, ...
    long steps_in_one_pass() const { return ahead_.used; }
    /// Steps whose passes were run together, slab by slab (docs/storage.md, Waves): those of one body of more
    /// than four megabytes, in 2D and 3D.
    long steps_in_waves() const { return steps_in_waves_; }
    /// Mass of the lightest node that particles reach and no condition holds, where the particles are now (kg);
    /// infinity if there is none. Such nodes bound the time step at free ends (docs/stability.md).
    template <class... Body> double lightest_free_node(std::tuple<Body&...> all) {
        prepare(all);
        if constexpr (C::moves) detail::passes<solver, Body...>{*this, all, real(1)}.sum_masses();
        double lightest = std::numeric_limits<double>::infinity();
        for (const auto& field : fields_) lightest = std::min(lightest, field.lightest_free_node());
        return lightest;
    }
    /// What `integrate` warned of, each once.
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Keeps a warning. Is it the first of its cause?
    bool warn(std::string sentence) {
        if (!warnings_.empty()) return false;
        warnings_.push_back(std::move(sentence));
        return true;
    }
    /// Terms of the full mass matrix's series that the last step took, and the size of the last one; 0 unless the
    /// scheme looks (`adaptive_fmpm`).
    const series_report& series() const { return series_; }
    const typename C::transfer& scheme() const { return transfer_; }
    const typename C::shape& functions() const { return shape_; }
    const typename C::load& load() const { return load_; }
    const auto& lattice() const { return lattice_; }

    /// A body of a law: particles in every cell where region(place) is true. Fields named in `fields<...>{}` are stored
    /// and kept besides those the policies ask for. Throws `error` if there are none, or if a parameter makes no sense.
    template <class L, class Region, class... Extra>
    auto make_body(const L& law, const Region& region, per_cell count, fields<Extra...> = {}) const {
        const auto points = detail::points_in(grid(), region, count.count);
        const real side = grid().spacing() / real(count.count);
        real volume(1);
        for (int d = 0; d < dim; ++d) volume *= side;
        return make_body_at(law, points, volume, fields<Extra...>{});
    }
    /// A body with a particle of the given volume at each point.
    template <class L, class... Extra> auto make_body_at(const L& law, const std::vector<point<dim, real>>& points,
                                                         const real& volume, fields<Extra...> = {}) const {
        // Here, not in check_law: clang names the user's line only for functions whose return type it must deduce.
        static_assert(HasDensity<L>, "tamis: the law has no density; give it a member `double density`");
        static_assert(HasWaveSpeed<L>,
                      "tamis: the law has no wave speed, from which time steps are chosen; give it a "
                      "member function `double wave_speed() const`");
        body_for<L, Extra...> b(law, lattice_);
        detail::add_particles<C::moves>(b, shape_, run_, points, volume);
        detail::load_body(b, load_);
        return b;
    }

    /// One step of dt (s) for the bodies, which move in one velocity field. Throws `error` if a particle's place is not
    /// a number, or leaves the grid where that is not allowed: the step is then done, and the particle put back into
    /// the grid, to be looked at. (`integrate` also looks for velocities and stresses that are not numbers.)
    template <class... Body> void step(std::tuple<Body&...> all, const real& dt) {
        step(all, dt, time_ + detail::to_double(dt));
    }
    template <class NotBodies> void step(NotBodies&&, const real&) {
        static_assert(sizeof(NotBodies) == 0,
                      "tamis: step is called with the bodies in one bundle: "
                      "mpm.step(bodies(a, b), dt)");
    }
    /// The same, for a step that ends at the given time: `integrate` says it without the round-off of adding up.
    template <class... Body> void step(std::tuple<Body&...> all, const real& dt, double end) {
        using namespace symbols;
        using order = typename C::order;
        static_assert(sizeof...(Body) > 0, "tamis: step and integrate need a body; give bodies(a, ...)");
        static_assert((serves<Body> && ...),
                      "tamis: a body was made by a solver of other policies, and lacks fields that "
                      "this one steps; make it with this solver's make_body");
        detail::check_step(detail::to_double(dt), time_, end);
        prepare(all);
        if constexpr (requires { transfer_.begin_step(steps_); }) transfer_.begin_step(steps_);
        const together run_together(*this, all);
        detail::passes<solver, Body...> now{*this, all, dt};
        const double held_start = order::explicit_euler ? previous_ : time_;
        const double held_end = order::explicit_euler ? time_ : end;

        using sums = typename C::sums;
        const bool made = sums_are_made(all);
        if constexpr (order::before > 0) {
            if constexpr (C::moves)
                now.template clear_sums<field::mass, field::momentum>();
            else
                now.template set_zero<field::momentum>();
            now.template extrapolate<true, false>();
            now.start(held_start);
            now.velocity_of_momentum();
            if constexpr (C::filters_first) now.template full_velocity<field::strain_velocity>(false);
            now.template strain<typename C::strains_before, false>(real(order::before) * dt);
            now.template set_zero<field::force>();
            now.template extrapolate<false, true>();
            now.template constrain_forces<true>(held_end);
            now.template accelerate<false>();
        } else {
            if (!made) {
                if constexpr (C::moves)
                    now.template clear_sums<typename sums::mass, typename sums::momentum, typename sums::force>();
                else
                    now.template set_zero<typename sums::momentum, typename sums::force>();
                now.template extrapolate<true, true>();
            }
            now.start(held_start);
            if constexpr (C::filters_first) {
                now.velocity_of_momentum();
                now.template full_velocity<field::strain_velocity>(false);
                now.template constrain_forces<true>(held_end);
                now.template accelerate<false>();
            } else {
                now.template constrain_forces<false>(held_end);
                now.template accelerate<true>();
            }
        }
        now.full_acceleration();
        if constexpr (C::mass::full)
            now.template full_velocity<field::velocity>(true);
        else
            transfer_.mass.solve(now);
        now.finish();
        if constexpr (!C::remaps) weights_change();
        now.update_particles();
        if constexpr (C::remaps) {
            now.template set_zero<field::momentum>();
            now.template extrapolate<true, false, false>();
            now.extrapolated(held_end);
            now.velocity_of_extrapolated();
            if constexpr (C::mass::full) now.template full_velocity<field::velocity>(false);
            weights_change();
            now.template strain<field::velocity, C::moves>(real(order::after) * dt);
        }
        now.run_waiting();
        previous_ = time_;
        time_ = end;
        ++steps_;
        if constexpr (C::sums_ahead) ahead_.updates = std::get<0>(all).store().updates;
        if constexpr (C::moves) {
            if (ahead_.made) return;  // nobody left its cell
            std::string failure;
            detail::each_of(all, [&](auto& b) { deliver(b, detail::to_double(dt), failure); });
            if (!failure.empty()) throw error(failure);
        }
    }

  private:
    using velocity_field = detail::velocity_field<C>;
    using sweeps_type = typename velocity_field::sweeps_type;
    using lattice_type = typename velocity_field::lattice_type;
    using held_type = typename velocity_field::held_type;
    using fields_type =
        std::conditional_t<C::own_velocities, std::deque<velocity_field>, std::array<velocity_field, 1>>;
    using contact_type = typename detail::contact_of<S, typename C::shape, typename C::touch>::type;
    template <class, class...> friend struct detail::passes;
    template <class Body> static constexpr bool serves = std::same_as<typename Body::lattice_type, lattice_type>&&
        std::same_as<merge<typename Body::field_list, typename C::step_fields>, typename Body::field_list>;
    typename C::shape shape_;
    typename C::transfer transfer_;
    typename C::load load_;
    typename C::execution run_;
    lattice_type lattice_;
    typename C::boundary boundary_;
    [[no_unique_address]] typename C::method method_;
    fields_type fields_;  // one for all bodies, or one for each
    contact_type contact_;
    double start_ = 0, previous_ = 0, time_ = 0;  // of the run, of the last step's start, now
    long steps_ = 0, steps_in_waves_ = 0;
    std::size_t crossings_ = 0;
    series_report series_;
    std::vector<std::string> warnings_;
    bool image_is_zero_ = false;  // on all nodes, so that the next sum can begin
    detail::assembled_matrix<C> matrix_;
    detail::wavefront waiting_;
    std::vector<std::uint64_t> seen_;  // stamps of the bodies as they were prepared
    /// The next step's sums over the particles (`composition::sums_ahead`): are they there, of which state of the body,
    /// and is it worth while to make them?
    struct {
        bool made = false, pays = false;
        int pause = 0, next_pause = 1;
        std::uint64_t updates = 0;
        long used = 0;
    } ahead_;

    template <detail::role R, class Default> using by_role = typename C::template by_role<R, Default>;
    solver(const Grid& grid, const std::tuple<const Policies&...>& all)
        : shape_(by_role<detail::role::shape, quadratic_spline>::of(all)),
          transfer_(by_role<detail::role::transfer, flip>::of(all)),
          load_(by_role<detail::role::load, unloaded>::of(all)),
          run_(by_role<detail::role::execution, serial>::of(all)),
          lattice_(grid),
          boundary_(by_role<detail::role::boundary, unbounded>::of(all)),
          method_(picked_method(all)),
          fields_(first_field()),
          contact_(by_role<detail::role::contact, one_velocity>::of(all), lattice_) {
        if ((held_type::any || C::own_velocities || C::exact) && detail::any_axis_wraps(lattice_))
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
    void add_field(std::deque<velocity_field>& to) const {
        to.emplace_back(shape_, lattice_, run_, boundary_, method_);
    }
    fields_type first_field() const {
        if constexpr (C::own_velocities) {
            fields_type all;
            add_field(all);
            return all;
        } else
            return {velocity_field(shape_, lattice_, run_, boundary_, method_)};
    }
    velocity_field& field_of(std::size_t body) { return fields_[C::own_velocities ? body : 0]; }

    /// The passes of a step of one body are run together, slab by slab, where that many particles are beyond what
    /// caches hold. What throws meanwhile leaves no pass to be run, and no matrix of sums that were not finished.
    class together {
      public:
        template <class... Body> together(solver& mpm, std::tuple<Body&...>& all) : mpm_(mpm) {
            if constexpr (sweeps_type::runner_type::may_wait && sizeof...(Body) == 1 && !C::own_velocities) {
                const auto& store = std::get<0>(all).store();
                const std::size_t bytes = store.slots.size() * sizeof(store.slots.front());
                if (store.slabs() < 8 || bytes < wait_from || detail::any_axis_wraps(mpm.lattice_)) return;
                std::vector<std::size_t> tiles;
                for (std::size_t k = 0; k < store.slabs(); ++k) tiles.push_back(store.row(k).size());
                mpm_.waiting_.start(store.first_nodes(mpm_.lattice_), tiles, mpm_.run_.count());
                mpm_.fields_[0].sweeps.runner().wait_in(&mpm_.waiting_);
                waits_ = true;
                ++mpm_.steps_in_waves_;
            }
        }
        ~together() {
            if (!waits_) return;
            mpm_.fields_[0].sweeps.runner().wait_in(nullptr);
            if (mpm_.waiting_.empty()) return;
            mpm_.waiting_.clear();
            mpm_.matrix_.weights_change();
            mpm_.image_is_zero_ = false;
        }
        together(const together&) = delete;
        together& operator=(const together&) = delete;

      private:
        // Blocks of 56^2 to 96^2 cells in 2D, 16^3 and 20^3 in 3D were as fast or faster by passes one by one.
        static constexpr std::size_t wait_from = std::size_t(4) << 20;
        solver& mpm_;
        bool waits_ = false;
    };

    /// Particles are about to move, if they do: what throws then must not leave a matrix of where they were.
    void weights_change() {
        if constexpr (C::moves && (C::assembles || C::exact)) matrix_.weights_change();
    }
    /// Were the step's sums over particles made by the step before, and are they still those of the body?
    template <class... Body> bool sums_are_made(std::tuple<Body&...>& all) {
        if constexpr (detail::passes<solver, Body...>::one_pass) {
            const bool made = std::exchange(ahead_.made, false) && ahead_.updates == std::get<0>(all).store().updates;
            // Where they were of no use, as after particles went to other cells, some steps go without: ever more
            // while it happens again and again.
            if (made) {
                ahead_.next_pause = 1;
                ++ahead_.used;
            } else if (ahead_.pays) {
                ahead_.pause = ahead_.next_pause;
                ahead_.next_pause = std::min(2 * ahead_.next_pause, 64);
            }
            ahead_.pays = ahead_.pause == 0 && !detail::any_axis_wraps(lattice_);
            if (ahead_.pause > 0) --ahead_.pause;
            return made;
        } else {
            ahead_.made = false;
            return false;
        }
    }
    /// What does not change from step to step: which nodes are in use and, for held particles, the nodes' masses.
    template <class... Body> void prepare(std::tuple<Body&...>& all) {
        prepare_fields(all);
        for (auto& field : fields_) field.sweeps.runner().begin_step();
    }
    template <class... Body> void prepare_fields(std::tuple<Body&...>& all) {
        const auto each = [&](auto&& f) { detail::each_of(all, f); };
        std::array<std::uint64_t, 2 * sizeof...(Body)> now;
        std::size_t k = 0;
        each([&](auto& b) { now[k++] = b.contents().number(); });
        each([&](auto& b) { now[k++] = b.store().layout.number(); });
        if (std::equal(now.begin(), now.end(), seen_.begin(), seen_.end())) return;
        ahead_.made = false;

        const bool as_before = seen_.size() == now.size();
        const auto contents_end = now.begin() + static_cast<std::ptrdiff_t>(sizeof...(Body));
        const bool contents_new = !as_before || !std::equal(now.begin(), contents_end, seen_.begin());
        if (contents_new) {
            detail::check_different(
                std::apply([](const auto&... b) { return std::array<const void*, sizeof...(Body)>{&b...}; }, all));
            each([&](auto& b) { detail::check_particles(b, grid(), steps_, time_); });
            if (!as_before) detail::check_loaded(load_, all);
        }
        seen_.clear();  // what throws is looked at again
        each([&](auto& b) { b.store().template arrange<lattice_type::N>(); });
        if constexpr (C::own_velocities)
            while (fields_.size() < sizeof...(Body)) add_field(fields_);
        for (std::size_t f = 0; f < fields_.size(); ++f) {
            std::vector<detail::placed_tiles> tiles;
            std::size_t body = 0;
            each([&](auto& b) {
                if (!C::own_velocities || body++ == f) tiles.push_back(detail::tiles_of(b.store()));
            });
            fields_[f].attend(tiles, lattice_);
        }
        if constexpr (!C::moves) {
            for (auto& field : fields_) field.sweeps.runner().begin_step();
            std::size_t body = 0;
            each([&](auto& b) {
                field_of(body++).sweeps.template scatter<fields<const field::mass>, fields<field::mass>>(
                    b, detail::mass_to_nodes{});
            });
            for (auto& field : fields_) field.keep_masses(lattice_);
        }
        matrix_.weights_change();
        seen_.assign(now.begin(), now.end());
    }

    template <class B> void deliver(B& b, double dt, std::string& failure) {
        crossings_ +=
            detail::sort_mail(b.store(), lattice_, C::leaving::when_leaving, {steps_, time_, dt}, failure, run_);
        b.store().tidy(lattice_, run_);
    }
};

template <class Grid, class... Policies> solver(const Grid&, const Policies&...) -> solver<Grid, Policies...>;

}  // namespace tamis
