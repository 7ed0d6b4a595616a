#pragma once
// Not part of tamis.hpp: a scheme of its own beside the solver.
#include <tamis/conservation/galerkin_now.hpp>
#include <tamis/conservation/line_ends.hpp>
#include <tamis/engine/reached_blocks.hpp>
#include <tamis/engine/sweeps.hpp>
#include <tamis/run/checks.hpp>
#include <tamis/run/seeding.hpp>
#include <tamis/step/particle_stages.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace tamis {

/// The two-step Taylor-Galerkin scheme for a conservation law u_t + div F(u) = 0, with particles as the quadrature
/// points (Molinos 2019; docs/taylor-galerkin.md). The unknowns are those of the nodes; particles stay where they are.
///
///     u_p = S u - dt/2 div_p F(u),    M (u' - u) = dt (sum V_p G_p F(u_p) - boundary flux)
///
/// M is the mass matrix of the volumes, S^T V S: `lumped_mass`, or `full_mass<k>` by k terms as in FMPM(k). Second
/// order. In one dimension with an `end` at each wall, or periodic (`grid.wrapped(0)`); in two and three dimensions
/// periodic only.
///
///     const conservation::advection<> law{{1.}};
///     taylor_galerkin scheme{uniform_grid{{0.}, {1.}, 0.01}.wrapped(0), law, per_cell{2}, linear{}, full_mass<4>{}};
///     scheme.set([](const auto& at) { return std::sin(2 * std::numbers::pi * at[0]); });
///     integrate(scheme, interval{0, 1}, courant{0.4});
template <class Grid, class Law, ShapeFunction Shape = linear, class Mass = lumped_mass,
          class Ends = conservation::ends<>, ExecutionPolicy Execution = serial, class Lanes = native_lanes>
class taylor_galerkin {
    static_assert(ConservationLaw<Law>,
                  "tamis: the law of taylor_galerkin is no conservation law; give it `static constexpr int unknowns`, "
                  "`flux(u, axis)`, which returns what u is, and `wave_speed()`");
    static_assert(
        std::same_as<Mass, lumped_mass> || detail::is_full_mass<Mass>,
        "tamis: the mass matrix of taylor_galerkin is lumped_mass{}, full_mass<k>{} or full_mass<dynamic>{k}");

  public:
    /// Types of places, of states, and of what kernels compute with.
    /// @{
    using real = typename Grid::real;
    using S = space<Grid::dim, typename Lanes::template type<real>>;
    using T = typename S::scalar;
    static constexpr int dim = Grid::dim, count = Law::unknowns;
    using place_type = point<dim, real>;
    using state_type = conservation::state<count, real>;
    /// @}

    /// Throws `error` if there is no particle, or if the ends do not go with the grid.
    taylor_galerkin(const Grid& grid, const Law& law, per_cell particles, const Shape& shape = {},
                    const Mass& mass = {}, const Ends& ends = {}, const Execution& run = {}, const Lanes& = {})
        : taylor_galerkin(grid, law, detail::points_in(grid, everywhere, particles.count),
                          volume_of(grid, particles.count), shape, mass, ends, run) {}
    /// Particles of the given volume at each point.
    taylor_galerkin(const Grid& grid, const Law& law, const std::vector<place_type>& points, const real& volume,
                    const Shape& shape = {}, const Mass& mass = {}, const Ends& ends = {}, const Execution& run = {},
                    const Lanes& = {})
        : law_(law),
          shape_(shape),
          mass_(mass),
          ends_(ends),
          run_(run),
          lattice_(grid),
          particles_({}, lattice_),
          sweeps_(shape_, lattice_, run_) {
        if constexpr (requires { law.check(); }) law.check();
        detail::add_particles(particles_, shape_, run_, points, volume, real(particles_.law.density));
        particles_.store().template arrange<lattice_type::N>();
        activate_nodes();
        weigh_nodes();
        ends_.find(lattice_, shape_, sweeps_.nodes());
    }
    taylor_galerkin(const taylor_galerkin&) = delete;
    taylor_galerkin& operator=(const taylor_galerkin&) = delete;

    /// The grid.
    const Grid& grid() const { return lattice_.grid(); }
    /// The law.
    const Law& law() const { return law_; }
    /// Time at the end of the last step (s).
    double time() const { return time_; }
    /// Steps done since the run began.
    long steps() const { return steps_; }
    /// Number of particles.
    std::size_t size() const { return particles_.size(); }
    /// Bytes a particle takes.
    static constexpr std::size_t bytes_per_particle() { return body_type::bytes_per_particle(); }
    /// Bytes a node takes.
    static constexpr std::size_t bytes_per_node() {
        return sizeof(real) * static_cast<std::size_t>(sweeps_type::nodes_type::components);
    }

    /// A run begins at time t: steps and gains are counted from here. At the time where the scheme stands it goes on.
    void start_at(double t) {
        if (steps_ > 0 && t == time_) return;
        time_ = t;
        steps_ = 0;
        ends_.restart();
    }
    /// Unknowns of the nodes, f(place): a vector, or a number where there is one unknown.
    template <class F> void set(const F& f) {
        std::array<int, 3> first{0, 0, 0}, end{1, 1, 1};
        for (int d = 0; d < dim; ++d) {
            first[at(d)] = -detail::ghosts<Shape>;
            end[at(d)] = lattice_.places_along(d) - detail::ghosts<Shape>;
        }
        std::array<int, 3> node;
        for (node[2] = first[2]; node[2] < end[2]; ++node[2])
            for (node[1] = first[1]; node[1] < end[1]; ++node[1])
                for (node[0] = first[0]; node[0] < end[0]; ++node[0]) {
                    const std::size_t place = lattice_.node_place(node);
                    if (!(inverse_mass(place) > real(0))) continue;
                    std::array<int, 3> here = node;
                    for (int d = 0; d < dim; ++d)
                        if (grid().wraps(d)) here[at(d)] = (node[at(d)] + grid().cells(d)) % grid().cells(d);
                    put<unknowns>(place, detail::as_state<state_type>(f(grid().node(here))));
                }
        start_at(time_);
        ends_.hold(sweeps_.nodes(), time_);
        ends_.restart();
    }

    /// One step of dt (s).
    void step(const real& dt) { step(dt, time_ + detail::to_double(dt)); }
    /// The same, for a step that ends at the given time.
    void step(const real& dt, double end) {
        detail::check_step(detail::to_double(dt), time_, end);
        using now_type = detail::galerkin_now<S, decltype(sweeps_), body_type, decltype(ends_), Law, Mass, real>;
        now_type now{sweeps_, particles_, ends_, law_, mass_, dt, time_, end};
        detail::schedule_runner<plan, now_type>::run(now);
        time_ = end;
        ++steps_;
    }

    /// The unknowns of node (i, j, k).
    state_type on_node(const std::array<int, 3>& node) const { return get<unknowns>(lattice_.node_place(node)); }
    /// The volume of node (i, j, k), its row of the mass matrix added up (m^dim).
    real mass_of_node(const std::array<int, 3>& node) const {
        const real inverse = inverse_mass(lattice_.node_place(node));
        return inverse > real(0) ? real(1) / inverse : real(0);
    }
    /// f(place, u) for every particle, u = S u there.
    template <class F> void each_particle(F f) const {
        for (const auto p : particles_) {
            const place_type where = p[symbols::x];
            state_type u = state_type::Zero();
            each_near_node(lattice_, shape_, where, [&](const auto& node) {
                u += node.weight * get<unknowns>(lattice_.node_place(node.index));
            });
            f(where, std::as_const(u));
        }
    }
    /// Integral of the unknowns, sum m u over nodes.
    state_type total() const {
        state_type sum = state_type::Zero();
        each_own_node([&](const auto& node) { sum += mass_of_node(node) * on_node(node); });
        return sum;
    }
    /// What has come in through the ends since the start: fluxes, and what held unknowns were given. `total()` grows by
    /// it, to round-off.
    const state_type& gain() const { return ends_.gain(); }
    /// The fastest disturbance at the nodes (m/s).
    double wave_speed() const {
        if constexpr (requires { law_.wave_speed(); }) return static_cast<double>(law_.wave_speed());
        double most = 0;
        each_own_node([&](const auto& node) {
            if (mass_of_node(node) > real(0)) most = std::max(most, detail::wave_speed_at(law_, on_node(node)));
        });
        return most;
    }
    /// Throws `error` if an unknown is not a number.
    void check_finite(double dt) const {
        each_own_node([&](const auto& node) {
            const state_type u = on_node(node);
            if (!std::isfinite(detail::to_double(u.sum())))
                throw error(detail::sentence(
                    "node at (", detail::list_of(grid().node(node)), "), step ", steps_, ", t = ", time_, ": (",
                    detail::list_of(u), ") is no state. Likely causes: a time step above the stability limit (dt = ",
                    dt, "), or a law that gave what is not a number"));
        });
    }

  private:
    /// Mass is volume.
    struct volumes {
        double density = 1;
    };
    using unknowns = field::unknowns<count>;
    using fluxes = field::fluxes<count>;
    using change = field::change<count>;
    using term = field::change_term<count>;
    using rate = field::rate<count>;
    using plan = detail::schedule<S, typename detail::taylor_galerkin_text<S, Law, Mass>::type, fields<unknowns>>;
    using sweeps_type = detail::sweeps<S, Shape, typename plan::layout, Execution, false>;
    using lattice_type = typename sweeps_type::lattice_type;
    using body_type = body<S, Shape, volumes, fields<detail::held_weights<Shape>, field::mass>>;
    Law law_;
    Shape shape_;
    Mass mass_;
    detail::line_ends<S, Law, Ends> ends_;
    Execution run_;
    lattice_type lattice_;
    body_type particles_;
    sweeps_type sweeps_;
    double time_ = 0;
    long steps_ = 0;

    static constexpr std::size_t at(int d) { return static_cast<std::size_t>(d); }
    static real volume_of(const Grid& grid, int particles) {
        real volume(1);
        for (int d = 0; d < dim; ++d) volume *= grid.spacing() / real(particles);
        return volume;
    }
    /// Nodes of the grid, those of a periodic axis once.
    template <class F> void each_own_node(F f) const {
        grid().each_node([&](const std::array<int, 3>& node) {
            for (int d = 0; d < dim; ++d)
                if (grid().wraps(d) && node[at(d)] == grid().cells(d)) return;
            f(node);
        });
    }
    real inverse_mass(std::size_t place) const { return sweeps_.nodes().template at<field::inverse_mass>(place); }
    template <class F> state_type get(std::size_t place) const {
        state_type u;
        for (int c = 0; c < count; ++c) u[c] = sweeps_.nodes().template at<F>(place, c);
        return u;
    }
    template <class F> void put(std::size_t place, const state_type& u) {
        for (int c = 0; c < count; ++c) sweeps_.nodes().template at<F>(place, c) = u[c];
    }

    void activate_nodes() {
        detail::reached_blocks reached;
        reached.mark({detail::tiles_of(particles_.store())}, lattice_);
        sweeps_.nodes().set_active(reached.blocks());
    }
    void weigh_nodes() {
        sweeps_.scatter(particles_, detail::kernel_of_parts<S>(typename detail::p2g<field::inverse_mass>::part{}));
        detail::wrap(lattice_, sweeps_.nodes(), fields<field::inverse_mass>{});
        sweeps_.each_node(detail::invert_in_place{});
    }
};

template <class Grid, class Law, class... Rest> taylor_galerkin(const Grid&, const Law&, per_cell, const Rest&...)
    -> taylor_galerkin<Grid, Law, Rest...>;
template <class Grid, class Law, class Points, class Volume, class... Rest>
taylor_galerkin(const Grid&, const Law&, const Points&, const Volume&, const Rest&...)
    -> taylor_galerkin<Grid, Law, Rest...>;

}  // namespace tamis
