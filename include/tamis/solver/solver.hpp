#pragma once
#include <tamis/boundary/held_nodes.hpp>
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
    const typename C::transfer& scheme() const { return transfer_; }
    const typename C::shape& functions() const { return shape_; }
    const typename C::load& load() const { return load_; }
    const auto& lattice() const { return lattice_; }

    /// A body of a law: particles in every cell where region(place) is true. Fields named in `fields<...>{}` are stored
    /// and kept besides those the policies ask for. Throws `error` if there are none, or if a parameter makes no sense.
    template <class L, class Region, class... Extra>
    auto make_body(const L& law, const Region& region, per_cell count, fields<Extra...> = {}) const {
        if (count.count < 1)
            throw error(detail::sentence("make_body: ", count.count, " particles per cell; give per_cell{1} or more"));
        const auto points = detail::points_in(grid(), region, count.count);
        if (points.empty())
            throw error("make_body: the region holds no particle; check it against the grid's corners and the spacing");
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
        detail::check_law(law);
        if (points.empty()) throw error("make_body: the body has no particle; give at least one point");
        if (!(volume > real(0)))
            throw error(detail::sentence("make_body: the particles' volume is ", volume, "; give a positive number"));
        body_for<L, Extra...> b(law, lattice_);
        for (const auto& where : points) detail::add_particle<C>(b, shape_, where, volume, real(law.density));
        b.store().sort(lattice_, 0);
        if constexpr (requires(typename body_for<L, Extra...>::template iterator<false> p) { law.start(*p); })
            for (auto p : b) law.start(p);
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
        if (!(dt > real(0))) throw error(detail::sentence("step: the time step is ", dt, "; give a positive number"));
        if (!(end > time_))
            throw error(detail::sentence("step: it would end at t = ", end, ", and the time is ", time_,
                                         " already; give a later end, or a longer step"));
        prepare(all);
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
            if constexpr (C::filters_first) transfer_.mass.template filter<field::strain_velocity>(false, now);
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
                transfer_.mass.template filter<field::strain_velocity>(false, now);
                held_.template forces<true>(nodes, held_end, inverse_dt);
                now.template accelerate<false>();
            } else {
                held_.template forces<false>(nodes, held_end, inverse_dt);
                now.template accelerate<true>();
            }
        }
        transfer_.mass.solve(now);
        held_.finish(dt);
        now.update_particles();
        if constexpr (C::remaps) {
            nodes.template set_zero<field::momentum>();
            now.template extrapolate<true, false, false>();
            held_.extrapolated(nodes, held_end);
            now.velocity_of_extrapolated();
            if constexpr (C::mass::full) transfer_.mass.template filter<field::velocity>(false, now);
            now.template strain<field::velocity, C::moves>(real(order::after) * dt);
        }
        previous_ = time_;
        time_ = end;
        ++steps_;
        if constexpr (C::moves) {
            std::string failure;
            std::apply([&](auto&... b) { (deliver(b, detail::to_double(dt), failure), ...); }, all);
            if (!failure.empty()) throw error(failure);
        }
    }

  private:
    using sweeps_type = detail::sweeps<C>;
    using lattice_type = typename sweeps_type::lattice_type;
    template <class Body> static constexpr bool serves = std::same_as<typename Body::lattice_type, lattice_type>&&
        std::same_as<merge<typename Body::field_list, typename C::step_fields>, typename Body::field_list>;
    typename C::shape shape_;
    typename C::transfer transfer_;
    typename C::load load_;
    typename C::execution run_;
    lattice_type lattice_;
    sweeps_type sweeps_;
    detail::held_nodes<S, typename C::shape, typename C::boundary> held_;
    double start_ = 0, previous_ = 0, time_ = 0;  // of the run, of the last step's start, now
    long steps_ = 0;
    std::size_t crossings_ = 0;
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
            check_different(all);
            each([&](auto& b) { check(b); });
        }
        each([&](auto& b) { b.store().template arrange<lattice_type::N>(); });
        find_active(all);
        if constexpr (!C::moves) {
            using namespace symbols;
            sweeps_.nodes().template set_zero<field::mass>();
            each([&](auto& b) {
                sweeps_.template scatter<fields<const field::mass>, fields<field::mass>>(
                    b, nothing_to_make, [](auto p, auto near, auto) {
                        for (const auto& [i, w, dw] : near) i[m] += w * p[m];
                    });
            });
            held_.take_masses(sweeps_.nodes());
            sweeps_.each_node(fields<const field::mass, field::inverse_mass>{}, [](auto i) { i[im] = inverse(i[m]); });
        }
        // Last: what threw is looked at again.
        seen_.assign(now.begin(), now.end());
    }
    template <class... Body> static void check_different(const std::tuple<Body&...>& all) {
        const std::array<const void*, sizeof...(Body)> places =
            std::apply([](const auto&... b) { return std::array<const void*, sizeof...(Body)>{&b...}; }, all);
        for (std::size_t i = 0; i < places.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (places[i] == places[j]) throw error("step: the same body is given twice; name each body once");
    }
    template <class... Body> void find_active(std::tuple<Body&...>& all) {
        constexpr auto W = static_cast<std::size_t>(S::width);
        std::vector<char> on(lattice_.size() / W + 2, 0);
        std::apply(
            [&](auto&... b) {
                const auto mark = [&](auto& one) {
                    for (const auto& t : one.store().tiles)
                        for (int r = 0; r < lattice_type::rows; ++r) {
                            const std::size_t first = (t.node + lattice_.row_offset(r)) / W;
                            for (std::size_t k = 0; k <= (W + lattice_type::N - 2) / W; ++k) on[first + k] = 1;
                        }
                };
                (mark(b), ...);
            },
            all);
        std::vector<std::uint32_t> blocks;
        for (std::size_t k = 0; k < on.size(); ++k)
            if (on[k]) blocks.push_back(static_cast<std::uint32_t>(k));
        sweeps_.nodes().set_active(std::move(blocks));
        held_.attend(on);
    }
    /// Particles that a user could have changed must still make sense.
    template <class Body> void check(const Body& b) const {
        using namespace symbols;
        const auto& other = b.lattice().grid();
        bool same = other.lower() == grid().lower() && other.upper() == grid().upper();
        for (int d = 0; d < dim; ++d) same = same && other.cells(d) == grid().cells(d);
        if (!same) throw error("step: a body was made on another grid; make it with this solver's make_body");
        long k = 0;
        for (const auto p : b) {
            const auto bad = [&](const auto&... why) {
                return error(detail::sentence("particle ", k, " at (", p[x].transpose(), "), step ", steps_,
                                              ", t = ", time_, ": ", why...));
            };
            if (!(p[m] > real(0)) || p[m] - p[m] != real(0))
                throw bad("its mass is ", p[m], "; give a positive density");
            if (!(p[V] > real(0))) throw bad("its volume is ", p[V], "; give a positive number");
            for (int d = 0; d < dim; ++d)
                if (p[v][d] - p[v][d] != real(0)) throw bad("its velocity is not finite; check the initial velocity");
            if constexpr (requires { b.law.check(p); }) {
                try {
                    b.law.check(p);
                } catch (const error& e) {
                    throw bad(e.what());
                }
            }
            ++k;
        }
    }

    struct nothing {};
    static constexpr auto nothing_to_make = [](const auto&, const auto&, const auto&) { return nothing{}; };
    /// 1/m, and 0 where there is no mass, or so little that its inverse is no number.
    static TAMIS_INLINE T inverse(const T& mass) {
        const T one(real(1));
        const auto enough = mass >= T(detail::least_mass<real>());
        const T inverse_of = one / select(enough, mass, one);
        return select(enough, inverse_of, T(real(0)));
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
        /// SdV = S^T M S dv.
        void spread_increment() {
            mpm.sweeps_.nodes().template set_zero<field::image>();
            each_body([&](auto& b) { mpm.sweeps_.spread_increment(b); });
        }
        template <class Sum> void hold_increment(bool felt) {
            mpm.held_.template increment<field::increment, Sum>(mpm.sweeps_.nodes(), inverse_dt, felt);
        }

        /// What is the same for every node around a particle: M V, V0 tau and M b.
        struct carried {
            typename S::vector momentum;
            symmetric_field::value<S> stress;
            typename S::vector load;
        };
        /// Particles to nodes: mass (where it changes) and momentum; force.
        template <bool Momentum, bool Force, bool Mass = C::moves> void extrapolate() {
            using namespace symbols;
            using to_nodes = detail::merge_as_is<std::conditional_t<Momentum && Mass, fields<field::mass>, fields<>>,
                                                 std::conditional_t<Momentum, fields<field::momentum>, fields<>>,
                                                 std::conditional_t<Force, fields<field::force>, fields<>>>;
            const auto make = [&](const auto& slot, const auto&, [[maybe_unused]] const auto& at) TAMIS_INLINE_LAMBDA {
                const auto& mass = slot.template get<field::mass>();
                carried of;
                if constexpr (Momentum) of.momentum = slot.template get<field::velocity>() * mass;
                if constexpr (Force)
                    of.stress = slot.template get<field::stress>() * slot.template get<field::volume>();
                if constexpr (Force && C::loaded)
                    of.load = detail::acceleration_of<S, typename C::shape>(mpm.load_, slot, at, mpm.time_) * mass;
                return of;
            };
            const auto kernel = [](auto p, auto near, const auto& of) TAMIS_INLINE_LAMBDA {
                for (const auto& [i, w, dw] : near) {
                    if constexpr (Momentum && Mass) i[m] += w * p[m];
                    if constexpr (Momentum) i[mv] += w * of.momentum;
                    if constexpr (Force) i[f] -= detail::unpack<S>(of.stress) * dw;
                    if constexpr (Force && C::loaded) i[f] += w * of.load;
                }
            };
            each_body([&](auto& body) {
                mpm.sweeps_.template scatter<fields<const field::mass>, to_nodes>(body, make, kernel);
            });
        }
        /// m and p become 1/m and v.
        void velocity_of_momentum() {
            using namespace symbols;
            if constexpr (C::moves)
                nodes(fields<const field::mass, const field::momentum, field::inverse_mass, field::velocity>{},
                      [](auto i) TAMIS_INLINE_LAMBDA {
                          i[im] = inverse(i[m]);
                          i[v] = i[mv] * i[im];
                      });
            else
                velocity_of_extrapolated();
        }
        /// p becomes v.
        void velocity_of_extrapolated() {
            using namespace symbols;
            nodes(fields<const field::inverse_mass, const field::momentum, field::velocity>{},
                  [](auto i) TAMIS_INLINE_LAMBDA { i[v] = i[mv] * i[im]; });
        }
        /// f and v (or p) become a and v+.
        template <bool FromMomentum> void accelerate() {
            using namespace symbols;
            using C_nodes = typename C::node_fields;
            constexpr bool keep = stores<C_nodes, field::start_velocity>;
            constexpr bool make_inverse = FromMomentum && C::moves;
            using list = detail::merge_as_is<std::conditional_t<make_inverse, fields<field::mass>, fields<>>,
                                             std::conditional_t<FromMomentum, fields<field::momentum>, fields<>>,
                                             std::conditional_t<keep, fields<field::start_velocity>, fields<>>>;
            const T h = dt();
            nodes(accelerated(list{}), [h](auto i) TAMIS_INLINE_LAMBDA {
                if constexpr (make_inverse) i[im] = inverse(i[m]);
                if constexpr (FromMomentum) i[v] = i[mv] * i[im];
                if constexpr (keep) i[v_start] = i[v];
                i[a] = i[f] * i[im];
                i[v] += h * i[a];
            });
        }
        /// Read-only and written lists for `accelerate`: mass, momentum and force are read, what takes their columns is
        /// written.
        template <class... F> static auto accelerated(fields<F...>) {
            return fields<
                std::conditional_t<std::same_as<F, field::start_velocity>, F, const F>..., const field::force,
                std::conditional_t<contains<fields<F...>, field::mass>, field::inverse_mass, const field::inverse_mass>,
                field::acceleration, field::velocity>{};
        }

        /// Gradient of the velocity in G strains the particles over `part` (s), which then move if they are to.
        template <class G, bool Move> void strain(const real& part) {
            const T h(part);
            each_body([&](auto& b) {
                const auto& law = b.law;
                mpm.sweeps_.template gather_each<fields<>, G>(
                    b,
                    [&law, h](auto& slot, std::uint32_t occupied, const auto& at, const auto& g) TAMIS_INLINE_LAMBDA {
                        detail::strain_slot<S>(law, slot, occupied, at, g.gradient, h);
                        if constexpr (Move)
                            slot.template get<field::position>() +=
                                T(at.inverse_spacing) * slot.template get<field::displacement>();
                    });
            });
        }
        /// Nodes to particles: V', X', and the strain where it uses the same velocities.
        void update_particles() {
            using order = typename C::order;
            constexpr bool strains = order::after > 0 && !C::remaps;
            using gradient = std::conditional_t<strains, typename C::strains_after, detail::no_field>;
            using shown_to_update = on_particles_t<typename C::update>;
            const T h = dt();
            [[maybe_unused]] const T part(real(order::after) * dt_);
            const auto& update = mpm.transfer_.particle;
            each_body([&](auto& b) {
                [[maybe_unused]] const auto& law = b.law;
                using slot_type = typename std::remove_reference_t<decltype(b)>::store_type::slot;
                mpm.sweeps_.template gather_each<typename C::gathers, gradient>(
                    b, [&](auto& slot, [[maybe_unused]] std::uint32_t occupied, const auto& at, const auto& g)
                           TAMIS_INLINE_LAMBDA {
                               using near_type = detail::gathered_nodes<S, decltype(g.sums), typename C::gathers>;
                               const near_type near{g.sums};
                               const typename S::vector before = slot.template get<field::velocity>();
                               const typename S::vector after =
                                   update.velocity(detail::slot_row<S, slot_type, shown_to_update>{slot, at}, near, h);
                               slot.template get<field::velocity>() = after;
                               if constexpr (strains) detail::strain_slot<S>(law, slot, occupied, at, g.gradient, part);
                               if constexpr (C::moves) {
                                   const typename S::vector moved = update.displacement(before, after, near, h);
                                   if constexpr (C::remaps)
                                       slot.template get<field::displacement>() = moved;
                                   else
                                       slot.template get<field::position>() += T(at.inverse_spacing) * moved;
                               }
                           });
            });
        }
    };

    template <class B> void deliver(B& b, double dt, std::string& failure) {
        crossings_ += b.store().sort_mail(lattice_, [&](auto& letter) {
            return left(std::type_identity<typename B::store_type::slot>{}, letter, dt, failure);
        });
        b.store().tidy(lattice_);
    }
    /// A particle left the grid, or its place is not a number. True: it has a cell again; false: it is removed.
    template <class Slot, class Letter>
    TAMIS_NOINLINE bool left(std::type_identity<Slot>, Letter& letter, double dt, std::string& failure) const {
        constexpr int px = Slot::template first<field::position>(), pv = Slot::template first<field::velocity>();
        using choice = leaving_stops::choice;
        constexpr choice what = C::leaving::when_leaving;
        point<dim, real> where, speed, inside, local;
        bool finite = true;
        for (int d = 0; d < dim; ++d) {
            const real& r = letter.value[px + d];
            const real low = grid().lower()[d], high = grid().upper()[d];
            finite = finite && r - r == real(0);
            const real cell = real(letter.from[static_cast<std::size_t>(d)]) - constant<real>(C::shape::shift);
            where[d] = low + grid().spacing() * (cell + r);
            speed[d] = letter.value[pv + d];
            inside[d] = where[d] >= low ? (where[d] <= high ? where[d] : high) : low;
        }
        if (finite && what == choice::remove) return false;
        lattice_.locate(inside, letter.cell, local);
        for (int d = 0; d < dim; ++d) letter.value[px + d] = local[d];
        if ((finite && what == choice::clamp) || !failure.empty()) return true;
        failure =
            detail::sentence("particle ", letter.origin, " (place in storage), step ", steps_, ", t = ", time_, ": ");
        const double cells = detail::to_double(speed.norm()) * dt / detail::to_double(grid().spacing());
        if (!finite)
            failure += detail::sentence("its place is not a number (velocity ", speed.transpose(),
                                        "). Likely causes: a time step above the stability limit (dt = ", dt,
                                        "), or a law, load or condition that gave one");
        else
            failure += detail::sentence(
                "it left the grid, to (", where.transpose(), ") with velocity (", speed.transpose(),
                "). Likely cause: ",
                cells > 0.5 ? "a time step above the stability limit, for it moves more than half a cell a step"
                            : "no condition keeps the body from that wall; enlarge the grid, hold the wall, or choose "
                              "leaving_clamps or leaving_removes");
        return true;
    }
};

template <class Grid, class... Policies> solver(const Grid&, const Policies&...) -> solver<Grid, Policies...>;

}  // namespace tamis
