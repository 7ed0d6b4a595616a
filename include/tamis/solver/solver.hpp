#pragma once
#include <tamis/boundary/held_nodes.hpp>
#include <tamis/solver/checks.hpp>
#include <tamis/solver/kernels.hpp>
#include <tamis/solver/leaving.hpp>
#include <tamis/solver/seeding.hpp>
#include <tamis/solver/sweeps.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace tamis {

/// How far the series of the full mass matrix went: its terms, and sqrt(sum m dv^2 / sum m) of the last one (m/s).
struct series_report {
    int terms = 0;
    double last_increment = 0;
};

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
        : solver(grid, std::tuple<Policies...>(policies...), 0) {}
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
        held_.restart();
    }
    /// Bytes a node takes.
    static constexpr std::size_t bytes_per_node() {
        return sizeof(real) * static_cast<std::size_t>(sweeps_type::nodes_type::components);
    }
    /// Nodes that conditions hold, with the reactions of the last step.
    auto reactions() const { return held_.reactions(); }
    /// Work of the conditions since the start (J).
    double boundary_work() const { return held_.work(); }
    /// Particles that went to another cell, since the start.
    std::size_t crossings() const { return crossings_; }
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
        detail::add_particles<C::moves>(b, shape_, points, volume);
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
        auto& nodes = sweeps_.nodes();
        const real inverse_dt = real(1) / dt;
        stage<Body...> now{*this, all, dt, inverse_dt};
        const double held_start = order::explicit_euler ? previous_ : time_;
        const double held_end = order::explicit_euler ? time_ : end;
        const double share = transfer_.particle.start_share();

        if constexpr (C::moves) nodes.template set_zero<field::mass>();
        nodes.template set_zero<field::momentum>();
        if constexpr (order::before > 0) {
            now.template extrapolate<true, false>();
            held_.start(nodes, held_start, C::moves, inverse_dt, share);
            now.velocity_of_momentum();
            if constexpr (C::filters_first) now.template full_velocity<field::strain_velocity>(false);
            now.template strain<typename C::strains_before, false>(real(order::before) * dt);
            nodes.template set_zero<field::force>();
            now.template extrapolate<false, true>();
            held_.template forces<true>(nodes, held_end, inverse_dt);
            now.template accelerate<false>();
        } else {
            nodes.template set_zero<field::force>();
            now.template extrapolate<true, true>();
            held_.start(nodes, held_start, C::moves, inverse_dt, share);
            if constexpr (C::filters_first) {
                now.velocity_of_momentum();
                now.template full_velocity<field::strain_velocity>(false);
                held_.template forces<true>(nodes, held_end, inverse_dt);
                now.template accelerate<false>();
            } else {
                held_.template forces<false>(nodes, held_end, inverse_dt);
                now.template accelerate<true>();
            }
        }
        if constexpr (C::mass::full)
            now.template full_velocity<field::velocity>(true);
        else
            transfer_.mass.solve(now);
        held_.finish(dt);
        now.update_particles();
        if constexpr (C::remaps) {
            nodes.template set_zero<field::momentum>();
            now.template extrapolate<true, false, false>();
            held_.extrapolated(nodes, held_end);
            now.velocity_of_extrapolated();
            if constexpr (C::mass::full) now.template full_velocity<field::velocity>(false);
            now.template strain<field::velocity, C::moves>(real(order::after) * dt);
        }
        previous_ = time_;
        time_ = end;
        ++steps_;
        if constexpr (C::moves) {
            weights_.renew();
            std::string failure;
            std::apply([&](auto&... b) { (deliver(b, detail::to_double(dt), failure), ...); }, all);
            if (!failure.empty()) throw error(failure);
        }
    }

  private:
    using sweeps_type = detail::sweeps<S, typename C::shape, typename C::node_fields, typename C::execution, C::moves>;
    using lattice_type = typename sweeps_type::lattice_type;
    template <class Body> static constexpr bool serves = std::same_as<typename Body::lattice_type, lattice_type>&&
        std::same_as<merge<typename Body::field_list, typename C::step_fields>, typename Body::field_list>;
    typename C::shape shape_;
    typename C::transfer transfer_;
    typename C::load load_;
    typename C::execution run_;
    lattice_type lattice_;
    sweeps_type sweeps_;
    detail::held_nodes<S, typename C::shape, typename C::boundary, C::how> held_;
    double start_ = 0, previous_ = 0, time_ = 0;  // of the run, of the last step's start, now
    long steps_ = 0;
    std::size_t crossings_ = 0;
    series_report series_;
    detail::stamp weights_;
    std::vector<std::uint64_t> seen_;  // stamps of the bodies as they were prepared

    template <detail::role R, class Default> static auto pick(const std::tuple<Policies...>& all) {
        return C::template by_role<R, Default>::of(all);
    }
    solver(const Grid& grid, const std::tuple<Policies...>& all, int)
        : shape_(pick<detail::role::shape, quadratic_spline>(all)),
          transfer_(pick<detail::role::transfer, flip>(all)),
          load_(pick<detail::role::load, unloaded>(all)),
          run_(pick<detail::role::execution, serial>(all)),
          lattice_(grid),
          sweeps_(shape_, lattice_, run_),
          held_(pick<detail::role::boundary, unbounded>(all), lattice_) {}

    /// What does not change from step to step: which nodes are in use and, for held particles, the nodes' masses.
    template <class... Body> void prepare(std::tuple<Body&...>& all) {
        const auto each = [&](auto f) { std::apply([&](auto&... b) { (f(b), ...); }, all); };
        std::array<std::uint64_t, 2 * sizeof...(Body)> now;
        std::size_t k = 0;
        each([&](auto& b) { now[k++] = b.contents().number(); });
        each([&](auto& b) { now[k++] = b.store().layout.number(); });
        if (std::equal(now.begin(), now.end(), seen_.begin(), seen_.end())) return;

        const bool as_before = seen_.size() == now.size();
        const auto contents_end = now.begin() + static_cast<std::ptrdiff_t>(sizeof...(Body));
        const bool contents_new = !as_before || !std::equal(now.begin(), contents_end, seen_.begin());
        if (contents_new) {
            detail::check_different(
                std::apply([](const auto&... b) { return std::array<const void*, sizeof...(Body)>{&b...}; }, all));
            each([&](auto& b) { detail::check_particles(b, grid(), steps_, time_); });
        }
        each([&](auto& b) { b.store().template arrange<lattice_type::N>(); });
        detail::block_marks on(lattice_.size(), S::width);
        each([&](auto& b) { detail::mark_reached(b.store().tiles, lattice_, on); });
        sweeps_.nodes().set_active(detail::marked(on));
        held_.attend(on.reached);
        if constexpr (!C::moves) {
            sweeps_.nodes().template set_zero<field::mass>();
            each([&](auto& b) {
                sweeps_.template scatter<fields<const field::mass>, fields<field::mass>>(b, detail::mass_to_nodes{});
            });
            held_.take_masses(sweeps_.nodes());
            sweeps_.each_node(detail::invert_mass::list{}, detail::invert_mass{});
        }
        weights_.renew();
        // Last: what threw is looked at again.
        seen_.assign(now.begin(), now.end());
    }

    /// The passes of one step; what mass policies see of it.
    template <class... Body> struct stage {
        solver& mpm;
        std::tuple<Body&...>& all;
        real dt_, inverse_dt;

        template <class F> void each_body(F f) {
            std::apply([&](auto&... b) { (f(b), ...); }, all);
        }
        T dt() const { return T(dt_); }
        template <class... F, class Kernel> void nodes(fields<F...> list, Kernel kernel) {
            mpm.sweeps_.each_node(list, kernel);
        }
        /// The same with the kernel's own list.
        template <class Kernel> void nodes(Kernel kernel) { mpm.sweeps_.each_node(typename Kernel::list{}, kernel); }
        /// SdV = S^T M S dv.
        void spread_increment() {
            using list = fields<field::increment>;
            mpm.sweeps_.nodes().template set_zero<field::image>();
            each_body([&](auto& b) {
                mpm.sweeps_.template scatter_gathered<fields<const field::mass>, list, fields<field::image>>(
                    b, detail::spread{});
            });
        }
        template <class Sum> void hold_increment(bool felt) {
            mpm.held_.template increment<field::increment, Sum>(mpm.sweeps_.nodes(), inverse_dt, felt);
        }

        /// The lumped velocity becomes the full one in `To`, conditions by the composed method. `felt`: do particles
        /// take it, so that what conditions do is a reaction?
        template <class To> void full_velocity(bool felt) {
            using detail::held_by;
            constexpr held_by how = C::how;
            const auto& mass = mpm.transfer_.mass;
            if constexpr (how == held_by::increments || how == held_by::lumped || !decltype(mpm.held_)::any)
                mass.template filter<To>(felt, *this);
            else {
                auto& held = mpm.held_;
                auto& nodes_of = mpm.sweeps_.nodes();
                held.remember(nodes_of);
                mass.template filter<To>(felt, *this);
                if constexpr (how == held_by::velocity || how == held_by::combined) {
                    held.template impose_velocity<To>(nodes_of, inverse_dt, felt);
                    return;
                }
                static_assert(
                    requires { mass.template series<To>(felt, *this); },
                    "tamis: this boundary method needs a mass matrix whose inverse has a fixed number of terms; give "
                    "fmpm<k>, or boundary_method::incremental");
                if constexpr (by_columns(how)) find_columns();
                nodes_of.template set_zero<field::increment>();
                held.template correct<field::increment, To>(nodes_of, inverse_dt, felt);
                if constexpr (how == held_by::unlumped1 || how == held_by::unlumped2) {
                    spread_increment();
                    nodes(detail::image_to_increment{});
                }
                nodes(detail::add_increment<To>{});
                mass.template series<To>(felt, *this);
            }
        }
        void find_columns() {
            auto& held = mpm.held_;
            auto& nodes_of = mpm.sweeps_.nodes();
            for (int batch = 0, n = held.batches(); batch < n; ++batch) {
                nodes_of.template set_zero<field::increment>();
                held.template start_columns<field::increment>(nodes_of, batch);
                mpm.transfer_.mass.each_term(*this,
                                             [&] { held.template add_columns<field::increment>(nodes_of, batch); });
            }
        }
        /// For mass policies that assemble the matrix: a number that changes when weights may have changed; the number
        /// of node places; f(i, j, S_pi M_p S_pj) for all particles and places of nodes around them; a field's columns.
        std::uint64_t weights_stamp() const { return mpm.weights_.number(); }
        std::size_t places() const { return mpm.lattice_.size(); }
        template <class F> void each_weight_pair(F f) {
            each_body([&](auto& b) { mpm.sweeps_.each_weight_pair(b, f); });
        }
        template <class Field, class F> void each_column(Field, F f) {
            for (int c = 0; c < Field::template components<S>; ++c) f(mpm.sweeps_.nodes().template column<Field>(c));
        }
        /// sqrt(sum m dv^2 / sum m) over nodes (m/s).
        double increment_size() {
            using kernel = detail::increment_square<S>;
            const auto sums = mpm.sweeps_.template sum_over_nodes<2>(typename kernel::list{}, kernel{});
            return sums[0] > real(0) ? std::sqrt(detail::to_double(sums[1]) / detail::to_double(sums[0])) : 0;
        }
        void report(const series_report& series) { mpm.series_ = series; }

        /// Particles to nodes: mass (where it changes) and momentum; force.
        template <bool Momentum, bool Force, bool Mass = C::moves> void extrapolate() {
            constexpr bool mass = Momentum && Mass;
            using list = typename detail::concatenate<detail::fields_if<mass, field::mass>,
                                                      detail::fields_if<Momentum, field::momentum>,
                                                      detail::fields_if<Force, field::force>>::type;
            using load = std::conditional_t<Force, typename C::load, unloaded>;
            [[maybe_unused]] static constexpr unloaded none{};
            const load* loads = nullptr;
            if constexpr (Force)
                loads = &mpm.load_;
            else
                loads = &none;
            const detail::to_nodes<S, typename C::shape, load, mass, Momentum, Force> kernel{*loads, mpm.time_};
            each_body([&](auto& b) { mpm.sweeps_.template scatter<fields<const field::mass>, list>(b, kernel); });
        }
        /// m and p become 1/m and v.
        void velocity_of_momentum() { nodes(detail::velocity_of_momentum<C::moves>{}); }
        /// p becomes v.
        void velocity_of_extrapolated() { nodes(detail::velocity_of_momentum<false>{}); }
        /// f and v (or p) become a and v+.
        template <bool FromMomentum> void accelerate() {
            constexpr bool keep = stores<typename C::node_fields, field::start_velocity>;
            nodes(detail::accelerate < T, FromMomentum && C::moves, FromMomentum, keep > {dt()});
        }

        /// Gradient of the velocity in G strains the particles over `part` (s), which then move if they are to.
        template <class G, bool Move> void strain(const real& part) {
            each_body([&](auto& b) {
                using law = typename std::remove_reference_t<decltype(b)>::law_type;
                mpm.sweeps_.template gather_each<fields<>, G>(b,
                                                              detail::strain_particles<S, law, Move>{b.law, T(part)});
            });
        }
        /// Nodes to particles: V', X', and the strain where it uses the same velocities.
        void update_particles() {
            using order = typename C::order;
            using gathers = typename C::gathers;
            constexpr bool strains = order::after > 0 && !C::remaps;
            using gradient = std::conditional_t<strains, typename C::strains_after, detail::no_field>;
            each_body([&](auto& b) { update<gathers, gradient, strains>(b, T(real(order::after) * dt_)); });
        }
        template <class Gathers, class Gradient, bool Strains, class B> void update(B& b, const T& strain_dt) {
            using kernel = detail::update_particles<S, typename B::law_type, typename C::update, Gathers, Strains,
                                                    C::particles_go>;
            mpm.sweeps_.template gather_each<Gathers, Gradient>(b,
                                                                kernel{b.law, mpm.transfer_.particle, dt(), strain_dt});
        }
    };

    template <class B> void deliver(B& b, double dt, std::string& failure) {
        crossings_ += detail::sort_mail(b.store(), lattice_, C::leaving::when_leaving, {steps_, time_, dt}, failure);
        b.store().tidy(lattice_);
    }
};

template <class Grid, class... Policies> solver(const Grid&, const Policies&...) -> solver<Grid, Policies...>;

}  // namespace tamis
