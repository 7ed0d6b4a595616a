#pragma once
#include <tamis/contact/policies.hpp>
#include <tamis/mass/mass.hpp>
#include <tamis/step/workspace.hpp>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Sdv = S^T M S dv, dv in `From`: a kernel of `sweeps`.
template <class S, class From> struct spread_kernel {
    using gathers = tamis::detail::gathers<fields<From>>;
    using sums = fields<field::image>;
    using reads = fields<field::mass>;
    static constexpr bool sums_by_slopes = false, sums_by_offsets = false, updates = false, moves = false;
    TAMIS_INLINE auto make(const auto& slot, const auto&, const auto& dv_p) const {
        return plain_term<field::image, typename S::vector>{dv_p.template sum<From>() *
                                                            slot.template get<field::mass>()};
    }
    static no_look look() { return {}; }
};

/// The full mass matrix M~ = S^T M S in a step under way: what mass policies make their series of (docs/method.md, Mass
/// policies), and where conditions and contact come in.
template <class Now> class mass_operator {
    using C = typename Now::C;
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename S::real;
    using matrix_type = assembled_matrix<C>;

  public:
    explicit mass_operator(Now& now) : now_(now) {}

    /// The lumped velocity in `From` becomes the full one in `To`, conditions by the composed method. `felt`: do
    /// particles take it, so that what conditions do is a reaction?
    template <class From, class To> void full_velocity(bool felt) {
        using method = typename C::method;
        first_increment_ = true;
        if constexpr (C::incremental || is_always<method, held_by::lumped>() || !held_any) {
            mass().template filter<From, To>(felt, *this);
            if constexpr (C::own_velocities)
                if constexpr (!C::touch::method_type::on_momentum) {
                    now_.work.contact.template velocity<To>(now_.tables(), now_.dt, felt);
                    impose<To>(felt);
                }
        } else {
            const held_by how = now_.work.fields[0].held.how();
            if (on_lumped(how)) each_held([](auto& held, auto& table) { held.template remember<From>(table); });
            mass().template filter<From, To>(felt, *this);
            if (how == held_by::increments || how == held_by::lumped) return;
            if (how == held_by::velocity || how == held_by::combined) return impose<To>(felt);
            if constexpr (!is_always<method, held_by::velocity>() && !is_always<method, held_by::combined>())
                correct<To>(how, felt);
        }
    }
    /// Terms beyond the first of the velocity in `From` are added to `To`: XPIC(k).
    template <class From, class To> void further_terms() { add_series<To, From>(mass().terms(), true, *this); }
    /// M~_k^-1 f: by linearity what v+ gains over v, per dt.
    void full_acceleration() {
        nodes(copy_field<field::acceleration, field::increment>{});
        now_.set_zero(fields<field::full_acceleration>{});
        static_assert(
            requires { mass().template series<field::full_acceleration>(false, *this); },
            "tamis: field::full_acceleration needs a mass matrix whose inverse has a fixed number of terms; give "
            "fmpm<k>");
        first_increment_ = false;
        mass().template series<field::full_acceleration>(false, *this);
    }
    /// sum A^l m^-1 of the unit vector of the node at a place, per place.
    std::vector<real> inverse_column(std::size_t at) {
        auto& sweeps = now_.work.fields[0].sweeps;
        std::vector<real> sum(now_.work.lattice.size(), real(0));
        now_.set_zero(fields<field::increment>{});
        sweeps.nodes().template at<field::increment>(at) = sweeps.nodes().template at<field::inverse_mass>(at);
        now_.exchange(fields<field::increment>{});
        mass().each_term(*this, [&] {
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += sweeps.nodes().template at<field::increment>(k);
        });
        return sum;
    }

    // What mass policies use.

    /// A kernel over all nodes, by its own list of fields.
    template <class Kernel> void nodes(Kernel kernel) {
        for (auto& field : now_.work.fields) field.sweeps.each_node(kernel);
    }
    /// Sdv = S^T M S dv, dv in `From`.
    template <class From> void spread() {
        if (matrix_type::pays(mass())) {
            multiply<From>(store_product<field::image>{});
        } else if constexpr (!matrix_type::always) {
            if (!clears_image || !std::exchange(now_.work.image_is_zero, false)) now_.set_zero(fields<field::image>{});
            now_.each_body([](auto& body, auto& sweeps) { sweeps.scatter(body, spread_kernel<S, From>{}); });
        }
        now_.exchange(fields<field::image>{});
    }
    /// Is a term of a series made in one pass over nodes, by the assembled matrix?
    static constexpr bool may_multiply = C::assembles;
    bool multiplies() const { return matrix_type::pays(mass()) && !any_axis_wraps(now_.work.lattice); }
    /// Term = A From, added to `To`; not written if nobody is to read it.
    template <class From, class To, class Term> void add_product(bool keeps) {
        multiply<From>(add_product_as_term<From, To, Term>{keeps});
    }
    /// Should whoever uses Sdv set it to zero? Not where the assembled matrix always writes it whole.
    static constexpr bool clears_image = !matrix_type::always;
    void image_is_zero() { now_.work.image_is_zero = true; }
    /// Does anybody look at the last increment of a series, beyond its sum?
    static constexpr bool reads_last_increment = Now::held_type::any || C::own_velocities;
    /// What contact and conditions make of an increment that was just added to `Sum`.
    template <class Sum, class Increment = field::increment> void hold_increment(bool felt) {
        if constexpr (C::own_velocities)
            if constexpr (C::touch::method_type::terms != contact_terms::untouched)
                now_.work.contact.template increment<Increment, Sum>(now_.tables(), now_.inverse_dt, felt,
                                                                     std::exchange(first_increment_, false));
        now_.each_held_in([felt, per_dt = now_.inverse_dt](auto& held, auto& table, const node_range& range) {
            held.template increment<Increment, Sum>(table, per_dt, felt, range);
        });
    }
    /// sqrt(sum m dv^2 / sum m) over nodes (m/s).
    double increment_size() {
        std::array<double, 2> sums{};
        for (auto& field : now_.work.fields) {
            const auto part = field.sweeps.template sum_over_nodes<2>(increment_square<S>{});
            for (std::size_t k = 0; k < 2; ++k) sums[k] += to_double(part[k]);
        }
        return sums[0] > 0 ? std::sqrt(sums[1] / sums[0]) : 0;
    }
    void report(const series_report& series) { now_.work.series = series; }
    /// For policies that assemble the matrix: a number that changes when weights may have changed; the number of node
    /// places; f(i, j, S_pi M_p S_pj) for all particles and places of nodes around them; a field's columns.
    std::uint64_t weights_stamp() const { return now_.work.matrix.weights(); }
    std::size_t places() const { return now_.work.lattice.size(); }
    template <class F> void each_weight_pair(F f) {
        now_.each_body([&](auto& body, auto& sweeps) {
            sweeps.runner().run_waiting();
            sweeps.each_weight_pair(body, f);
        });
    }
    template <class Field, class F> void each_column(Field, F f) {
        for (auto& field : now_.work.fields)
            for (int c = 0; c < Field::template components<S>; ++c)
                field.sweeps.nodes().template with_column<Field>(c, f);
    }

  private:
    static constexpr bool held_any = Now::held_type::any;
    Now& now_;
    bool first_increment_ = true;  // of a series: the one beyond the lumped velocity is next

    const typename C::mass& mass() const { return now_.by.transfer.mass; }
    template <class F> void each_held(F f) {
        if constexpr (held_any)
            for (auto& field : now_.work.fields) f(field.held, field.sweeps.nodes());
    }
    template <class To> void impose(bool felt) {
        each_held([&](auto& held, auto& table) { held.template impose_velocity<To>(table, now_.inverse_dt, felt); });
    }
    /// use(..., M~ From) for all nodes; M~ is made anew when weights have changed.
    template <class From, class Use> void multiply(const Use& use) {
        if constexpr (C::assembles) {
            if (!now_.work.matrix.is_made()) {
                now_.work.matrix.begin();
                now_.set_zero(fields<field::mass_entries<C::shape::support>>{});
                now_.each_body([](auto& body, auto& sweeps) { sweeps.assemble_matrix(body); });
                now_.work.matrix.made();
            }
            now_.work.image_is_zero = false;
            for (auto& field : now_.work.fields) field.sweeps.template multiply_by_matrix<From>(use);
        }
    }
    /// What the conditions add to a full velocity that did not know of them.
    template <class To> void correct(held_by how, bool felt) {
        static_assert(
            requires { mass().template series<To>(felt, *this); },
            "tamis: this boundary method needs a mass matrix whose inverse has a fixed number of terms; give fmpm<k>, "
            "or boundary_method::incremental");
        if (by_columns(how)) find_columns();
        now_.set_zero(fields<field::increment>{});
        each_held([&](auto& held, auto& table) {
            held.template correct<field::increment, To>(table, now_.inverse_dt, felt);
        });
        if (how == held_by::unlumped1 || how == held_by::unlumped2)
            if constexpr (contains<on_nodes_t<typename C::mass>, field::image>) {
                spread<field::increment>();
                nodes(image_to_increment{});
            }
        mass().template series<To>(felt, *this);
    }
    void find_columns() {
        auto& field = now_.work.fields[0];
        field.sweeps.runner().at_once([&] {
            for (int batch = 0, n = field.held.batches(); batch < n; ++batch) {
                now_.set_zero(fields<field::increment>{});
                auto& table = field.sweeps.nodes();
                field.held.template start_columns<field::increment>(table, batch);
                mass().each_term(*this, [&] { field.held.template add_columns<field::increment>(table, batch); });
            }
        });
    }
};

}  // namespace tamis::detail
