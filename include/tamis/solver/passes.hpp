#pragma once
#include <tamis/contact/policies.hpp>
#include <tamis/core/each_of.hpp>
#include <tamis/grid/wrap.hpp>
#include <tamis/solver/assembled_matrix.hpp>
#include <tamis/solver/composition.hpp>
#include <tamis/solver/damping.hpp>
#include <tamis/solver/kernels.hpp>
#include <tamis/solver/sweeps.hpp>

#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

namespace tamis {

/// How far the series of the full mass matrix went: its terms, and sqrt(sum m dv^2 / sum m) of the last one (m/s).
struct series_report {
    int terms = 0;
    double last_increment = 0;
};

namespace detail {

/// The passes of one step of a solver; what mass policies see of it.
template <class Solver, class... Body> struct passes {
    using C = typename Solver::C;
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename S::real;

    Solver& mpm;
    std::tuple<Body&...>& all;
    real dt_, inverse_dt = real(1) / dt_;
    bool first_increment = true;  // of a series: the one beyond the lumped velocity is next

    /// Are the next step's sums made while the particles are updated?
    static constexpr bool one_pass = C::sums_ahead && sizeof...(Body) == 1 && !(Body::needs_flow || ...);

    T dt() const { return T(dt_); }
    /// f(body, sweeps of its velocity field).
    template <class F> void each_body(F f) {
        std::size_t k = 0;
        each_of(all, [&](auto& b) { f(b, mpm.field_of(k++).sweeps); });
    }
    template <class F> void each_held(F f) {
        if constexpr (Solver::held_type::any) {
            run_waiting();
            for (auto& field : mpm.fields_) f(field.held, field.sweeps.nodes());
        }
    }
    /// f(held, nodes, range), which looks at the nodes of a range only.
    template <class F> void each_held_in(F f) {
        if constexpr (Solver::held_type::any)
            for (auto& field : mpm.fields_)
                field.sweeps.runner().over_nodes([f, &field](std::size_t first, std::size_t last) {
                    f(field.held, field.sweeps.nodes(), node_range{first, last});
                });
    }
    /// f(held), which looks at no node.
    template <class F> void each_holder(F f) {
        for (auto& field : mpm.fields_) f(field.held);
    }
    /// What was to be run together is run: somebody is about to look at its results.
    void run_waiting() {
        for (auto& field : mpm.fields_) field.sweeps.runner().run_waiting();
    }
    /// f(), whose passes do not wait: between them it looks at nodes itself.
    template <class F> auto at_once(F f) {
        run_waiting();
        auto& runner = mpm.fields_[0].sweeps.runner();
        const struct pause {
            decltype(runner)& of;
            wavefront* where;
            ~pause() { of.wait_in(where); }
        } ends{runner, runner.wait_in(nullptr)};
        return f();
    }
    template <class... F, class Kernel> void nodes(fields<F...> list, Kernel kernel) {
        for (auto& field : mpm.fields_) field.sweeps.each_node(list, kernel);
    }
    /// The same with the kernel's own list.
    template <class Kernel> void nodes(Kernel kernel) { nodes(typename Kernel::list{}, kernel); }
    template <class... F> void set_zero() {
        for (auto& field : mpm.fields_) field.sweeps.template set_zero<F...>();
    }

    // Momentum, force and velocity, with what conditions and contact do to them.

    /// Particles to nodes: mass (where it changes) and momentum; force.
    template <bool Momentum, bool Force, bool Mass = C::moves> void extrapolate() {
        constexpr bool mass = Momentum && Mass;
        constexpr bool loaded = Force && C::kinds::on_particles;
        using load = std::conditional_t<loaded, typename C::load, unloaded>;
        [[maybe_unused]] static constexpr unloaded none{};
        const load* loads = nullptr;
        if constexpr (loaded)
            loads = &mpm.load_;
        else
            loads = &none;
        using kernel = to_nodes<S, typename C::shape, load, typename C::sums, mass, Momentum, Force>;
        const kernel sum{*loads, mpm.time_};
        using shown = fields<const field::mass>;
        const bool assembles = mass && matrix_is_due();
        each_body([&](auto& b, auto& sweeps) {
            if constexpr (mass && C::assembles)
                if (assembles) return sweeps.template scatter_and_assemble<shown, typename kernel::list>(b, sum);
            if constexpr (!(mass && matrix_type::every_step))
                sweeps.template scatter<shown, typename kernel::list>(b, sum);
        });
        if (assembles) mpm.matrix_.made();
        wrap(typename kernel::list{});
    }
    /// What `extrapolate` is about to add to becomes zero; so do the entries of the full mass matrix, if they are
    /// assembled by the way: until that is done there is no matrix.
    template <class... F> void clear_sums() {
        if constexpr (C::assembles)
            if (matrix_is_due()) {
                mpm.matrix_.begin();
                return set_zero<F..., field::mass_entries<C::shape::support>>();
            }
        set_zero<F...>();
    }
    /// Sums of particles at the two places of a node at a periodic wall are one.
    template <class... F> void wrap(fields<F...> list) {
        for (auto& field : mpm.fields_) detail::wrap(mpm.lattice_, field.sweeps.nodes(), list);
    }
    /// Masses alone, where the particles are now.
    void sum_masses() {
        set_zero<field::mass>();
        each_body([](auto& b, auto& sweeps) {
            sweeps.template scatter<fields<const field::mass>, fields<field::mass>>(b, mass_to_nodes{});
        });
        wrap(fields<field::mass>{});
    }
    /// The momentum of the step's start.
    void start(double t) {
        const double share = mpm.transfer_.particle.start_share();
        if constexpr (C::own_velocities) {
            find_contact();
            mpm.contact_.momentum(tables(), constant<real>(share), inverse_dt);
        }
        each_holder([&](auto& held) { held.start_values(t); });
        each_held_in([share, per_dt = inverse_dt](auto& held, auto& table, const node_range& range) {
            held.start(table, C::moves, per_dt, share, range);
        });
    }
    /// The forces, which carry the momentum to what it may be at the end.
    template <bool HoldsVelocity> void constrain_forces(double t) {
        if constexpr (C::kinds::on_nodes)
            damp<T, node_state<HoldsVelocity, C::moves>>(mpm.load_, mpm.time_, to_double(dt_), [&](auto f) {
                for (auto& field : mpm.fields_) f(field.sweeps);
            });
        if constexpr (C::own_velocities)
            if (acts_on_momentum) mpm.contact_.template forces<HoldsVelocity>(tables(), dt_);
        each_holder([&](auto& held) { held.end_values(t); });
        each_held_in([per_dt = inverse_dt](auto& held, auto& table, const node_range& range) {
            held.template forces<HoldsVelocity>(table, per_dt, range);
        });
        if constexpr (Solver::held_type::any)
            for (auto& field : mpm.fields_)
                if (field.held.may_disagree()) {
                    run_waiting();
                    field.held.check_values();
                }
    }
    /// A momentum extrapolated after the update.
    void extrapolated(double t) {
        if constexpr (C::own_velocities)
            if (acts_on_momentum) mpm.contact_.momentum(tables());
        each_held([&](auto& held, auto& table) { held.extrapolated(table, t); });
    }
    void finish() {
        if constexpr (Solver::held_type::any)
            for (auto& field : mpm.fields_)
                field.sweeps.runner().at_end([&held = field.held, dt = dt_] { held.finish(dt); });
    }
    /// m and p become 1/m and v.
    void velocity_of_momentum() { nodes(detail::velocity_of_momentum<C::moves>{}); }
    /// p becomes v.
    void velocity_of_extrapolated() { nodes(detail::velocity_of_momentum<false>{}); }
    /// f and v (or p) become a and v+.
    template <bool FromMomentum> void accelerate() {
        constexpr bool keep = stores<typename C::node_fields, field::start_velocity>;
        using kernel = detail::accelerate<T, typename C::sums, FromMomentum && C::moves, FromMomentum, keep>;
        nodes(kernel{dt()});
    }

    // What mass policies use.

    /// The lumped velocity becomes the full one in `To`, conditions by the composed method. `felt`: do particles take
    /// it, so that what conditions do is a reaction?
    template <class To> void full_velocity(bool felt) {
        using method = typename C::method;
        const auto& mass = mpm.transfer_.mass;
        first_increment = true;
        if constexpr (C::incremental || is_always<method, held_by::lumped>() || !Solver::held_type::any) {
            mass.template filter<To>(felt, *this);
            if constexpr (C::own_velocities)
                if (!acts_on_momentum) {
                    mpm.contact_.template velocity<To>(tables(), dt_, felt);
                    each_held(
                        [&](auto& held, auto& table) { held.template impose_velocity<To>(table, inverse_dt, felt); });
                }
        } else {
            const held_by how = mpm.fields_[0].held.how();
            if (on_lumped(how)) each_held([](auto& held, auto& table) { held.remember(table); });
            mass.template filter<To>(felt, *this);
            if (how == held_by::increments || how == held_by::lumped) return;
            if (how == held_by::velocity || how == held_by::combined) {
                each_held([&](auto& held, auto& table) { held.template impose_velocity<To>(table, inverse_dt, felt); });
                return;
            }
            if constexpr (!is_always<method, held_by::velocity>() && !is_always<method, held_by::combined>())
                correct<To>(how, felt);
        }
    }
    /// SdV = S^T M S dv; dv, or what else `From` names.
    template <class From = field::increment> void spread_increment() {
        if (matrix_pays()) {
            multiply<From>(store_product<field::image>{});
        } else if constexpr (!matrix_type::always) {
            if (!clears_image || !std::exchange(mpm.image_is_zero_, false)) set_zero<field::image>();
            each_body([](auto& b, auto& sweeps) {
                sweeps.template scatter_gathered<fields<const field::mass>, fields<From>, fields<field::image>>(
                    b, spread<From>{});
            });
        }
        wrap(fields<field::image>{});
    }
    /// Is a term of a series made in one pass over nodes, by the assembled matrix?
    static constexpr bool may_multiply = C::assembles;
    bool multiplies() const { return matrix_pays() && !any_axis_wraps(mpm.lattice_); }
    /// Term = A From, added to `To`; not written if nobody is to read it.
    template <class From, class To, class Term> void add_product(bool keeps) {
        multiply<From>(add_product_as_term<From, To, Term>{keeps});
    }
    /// Should whoever uses SdV set it to zero? Not where the assembled matrix always writes it whole.
    static constexpr bool clears_image = !assembled_matrix<C>::always;
    void image_is_zero() { mpm.image_is_zero_ = true; }
    /// Does anybody look at the last increment of a series, beyond its sum?
    static constexpr bool reads_last_increment = Solver::held_type::any || C::own_velocities;
    template <class Sum, class Increment = field::increment> void hold_increment(bool felt) {
        if constexpr (C::own_velocities)
            if constexpr (C::touch::method_type::terms != contact_terms::untouched)
                mpm.contact_.template increment<Increment, Sum>(tables(), inverse_dt, felt,
                                                                std::exchange(first_increment, false));
        if constexpr (Solver::held_type::any)
            each_held_in([felt, per_dt = inverse_dt](auto& held, auto& table, const node_range& range) {
                held.template increment<Increment, Sum>(table, per_dt, felt, range);
            });
    }
    /// sqrt(sum m dv^2 / sum m) over nodes (m/s).
    double increment_size() {
        using kernel = increment_square<S>;
        std::array<double, 2> sums{};
        for (auto& field : mpm.fields_) {
            const auto part = field.sweeps.template sum_over_nodes<2>(typename kernel::list{}, kernel{});
            for (std::size_t k = 0; k < 2; ++k) sums[k] += to_double(part[k]);
        }
        return sums[0] > 0 ? std::sqrt(sums[1] / sums[0]) : 0;
    }
    void report(const series_report& series) { mpm.series_ = series; }
    /// For policies that assemble the matrix: a number that changes when weights may have changed; the number of node
    /// places; f(i, j, S_pi M_p S_pj) for all particles and places of nodes around them; a field's columns.
    std::uint64_t weights_stamp() const { return mpm.matrix_.weights(); }
    std::size_t places() const { return mpm.lattice_.size(); }
    template <class F> void each_weight_pair(F f) {
        run_waiting();
        each_body([&](auto& b, auto& sweeps) { sweeps.each_weight_pair(b, f); });
    }
    template <class Field, class F> void each_column(Field, F f) {
        run_waiting();
        for (auto& field : mpm.fields_)
            for (int c = 0; c < Field::template components<S>; ++c)
                field.sweeps.nodes().template with_column<Field>(c, f);
    }

    // Nodes to particles.

    /// Gradient of the velocity in G strains the particles over `part` (s), which then move if they are to.
    template <class G, bool Move> void strain(const real& part) {
        each_body([&](auto& b, auto& sweeps) {
            using law = typename std::remove_reference_t<decltype(b)>::law_type;
            const auto look = this->template look_for<G>(b, sweeps);
            using kernel = strain_particles<S, law, Move, std::remove_const_t<decltype(look)>>;
            sweeps.template gather_each<fields<>, G>(b, kernel{b.law, T(part), look});
        });
    }
    /// V', X', and the strain where it uses the same velocities.
    void update_particles() {
        using order = typename C::order;
        constexpr bool strains = order::after > 0 && !C::remaps;
        using gradient = std::conditional_t<strains, typename C::strains_after, no_field>;
        each_body([&](auto& b, auto& sweeps) {
            this->template update<gradient, strains>(b, sweeps, T(real(order::after) * dt_));
        });
    }

    /// M~_k^-1 f for whoever reads it: by linearity what v+ gains over v, per dt.
    void full_acceleration() {
        if constexpr (contains<typename C::read, field::full_acceleration>) {
            nodes(copy_field<field::acceleration, field::increment>{});
            set_zero<field::full_acceleration>();
            static_assert(
                requires { mpm.transfer_.mass.template series<field::full_acceleration>(false, *this); },
                "tamis: field::full_acceleration needs a mass matrix whose inverse has a fixed number of terms; give "
                "fmpm<k>");
            first_increment = false;
            mpm.transfer_.mass.template series<field::full_acceleration>(false, *this);
        }
    }
    /// sum A^l m^-1 of the unit vector of the node at a place, per place.
    std::vector<real> inverse_column(std::size_t at) {
        auto& table = mpm.fields_[0].sweeps.nodes();
        std::vector<real> sum(mpm.lattice_.size(), real(0));
        set_zero<field::increment>();
        table.template at<field::increment>(at) = table.template at<field::inverse_mass>(at);
        wrap(fields<field::increment>{});
        mpm.transfer_.mass.each_term(*this, [&] {
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += table.template at<field::increment>(k);
        });
        return sum;
    }

  private:
    static constexpr bool acts_on_momentum = [] {
        if constexpr (C::own_velocities)
            return C::touch::method_type::on_momentum;
        else
            return true;
    }();

    using matrix_type = assembled_matrix<C>;
    bool matrix_pays() const { return matrix_type::pays(mpm.transfer_.mass); }
    bool matrix_is_due() const { return matrix_type::is_due(mpm.transfer_.mass); }
    /// use(..., Mf From) for all nodes; Mf is made anew when weights have changed.
    template <class From, class Use> void multiply(const Use& use) {
        if constexpr (C::assembles) {
            if (!mpm.matrix_.is_made()) {
                mpm.matrix_.begin();
                set_zero<field::mass_entries<C::shape::support>>();
                each_body([](auto& b, auto& sweeps) { sweeps.assemble_matrix(b); });
                mpm.matrix_.made();
            }
            mpm.image_is_zero_ = false;
            for (auto& field : mpm.fields_) field.sweeps.template multiply_by_matrix<From>(use);
        }
    }
    template <class Gradient, bool Strains, class B, class Sweeps>
    void update(B& b, Sweeps& sweeps, const T& strain_dt) {
        using gathers = typename C::gathers;
        const auto look = this->template look_for<Gradient>(b, sweeps);
        using update_kernel = detail::update_particles<S, typename B::law_type, typename C::update, gathers, Strains,
                                                       C::particles_go, std::remove_const_t<decltype(look)>>;
        const update_kernel kernel{b.law, mpm.transfer_.particle, dt(), strain_dt, look};
        if constexpr (one_pass) {
            static constexpr unloaded none{};
            using sum_kernel = to_nodes<S, typename C::shape, unloaded, typename C::sums, C::moves, true, true>;
            mpm.ahead_.made = sweeps.template gather_and_scatter<gathers, Gradient, fields<const field::mass>,
                                                                 typename sum_kernel::list>(
                b, kernel, sum_kernel{none, 0}, mpm.ahead_.pays);
        } else
            sweeps.template gather_each<gathers, Gradient>(b, kernel);
    }
    /// For a law that wants to know the flow past its particles: the nodes' means of what it carries.
    template <class Velocity, class B, class Sweeps> auto look_for(B& b, Sweeps& sweeps) {
        if constexpr (!B::needs_flow || std::same_as<Velocity, no_field>)
            return no_flow{};
        else {
            using carries = typename B::law_type::carries;
            auto& own = b.carried_nodes().table;
            if (!own)
                own = std::make_unique<typename std::remove_reference_t<decltype(own)>::element_type>(
                    mpm.lattice_.size());
            if (own->active() != sweeps.nodes().active()) own->set_active(sweeps.nodes().active());
            at_once([&] {
                own->template set_zero<carried, carried_volume>();
                sweeps.template scatter_onto<fields<>, fields<carried, carried_volume>>(*own, b,
                                                                                        carried_to_nodes<carries>{});
                using L = lane<T>;
                for (const std::uint32_t block : own->active()) {
                    const std::size_t place = block * static_cast<std::size_t>(S::width);
                    real* const mean = own->template block<carried>(place);
                    const T c = L::load(mean) * inverse_or_zero(L::load(own->template block<carried_volume>(place)));
                    L::store(mean, c);
                    for (int d = 0; d < S::dim; ++d)
                        L::store(own->template block<carried_flow>(place, d),
                                 c * L::load(sweeps.nodes().template block<Velocity>(place, d)));
                }
            });
            return look_at_flow<S, typename C::shape, Velocity>{*own};
        }
    }

    /// What the conditions add to a full velocity that did not know of them.
    template <class To> void correct(held_by how, bool felt) {
        const auto& mass = mpm.transfer_.mass;
        static_assert(
            requires { mass.template series<To>(felt, *this); },
            "tamis: this boundary method needs a mass matrix whose inverse has a fixed number of terms; give fmpm<k>, "
            "or boundary_method::incremental");
        if (by_columns(how)) find_columns();
        set_zero<field::increment>();
        each_held(
            [&](auto& held, auto& table) { held.template correct<field::increment, To>(table, inverse_dt, felt); });
        if (how == held_by::unlumped1 || how == held_by::unlumped2) {
            if constexpr (stores<typename C::node_fields, field::image>) {
                spread_increment();
                nodes(image_to_increment{});
            }
        }
        mass.template series<To>(felt, *this);
    }
    void find_columns() {
        at_once([&] {
            auto& held = mpm.fields_[0].held;
            auto& table = mpm.fields_[0].sweeps.nodes();
            for (int batch = 0, n = held.batches(); batch < n; ++batch) {
                set_zero<field::increment>();
                held.template start_columns<field::increment>(table, batch);
                mpm.transfer_.mass.each_term(*this, [&] { held.template add_columns<field::increment>(table, batch); });
            }
        });
    }
    /// The node tables of all velocity fields, in the order of the bodies.
    auto tables() {
        std::array<const typename Solver::sweeps_type::nodes_type*, sizeof...(Body)> all_tables;
        for (std::size_t k = 0; k < sizeof...(Body); ++k) all_tables[k] = &mpm.field_of(k).sweeps.nodes();
        return all_tables;
    }
    void find_contact() {
        using touch = typename C::touch;
        const auto fields_of = tables();
        mpm.contact_.find(fields_of, [&](std::size_t k, std::size_t at) -> real {
            const real m = fields_of[k]->template at<field::mass>(at);
            if constexpr (C::moves) return m;
            return m > real(0) ? real(1) / m : real(0);
        });
        if (!mpm.contact_.any()) return;
        if constexpr (touch::by_mass || touch::by_place) {
            using list = on_nodes_t<touch>;
            if constexpr (touch::by_mass) set_zero<field::mass_gradient>();
            if constexpr (touch::by_place) set_zero<field::mass_place>();
            const contact_to_nodes<S, typename C::shape, touch::by_mass, touch::by_place> kernel{};
            each_body(
                [&](auto& b, auto& sweeps) { sweeps.template scatter<fields<const field::mass>, list>(b, kernel); });
        }
        mpm.contact_.measure(fields_of);
    }
};

}  // namespace detail
}  // namespace tamis
