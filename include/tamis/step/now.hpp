#pragma once
#include <tamis/contact/contact_to_nodes.hpp>
#include <tamis/step/mass_operator.hpp>
#include <tamis/step/workspace.hpp>

#include <array>
#include <tuple>

namespace tamis::detail {

/// A step under way: what stages see of it.
template <class Composition, class... Body> struct step_now {
    using C = Composition;
    using S = typename C::S;
    using T = typename S::scalar;
    using real = typename S::real;
    using held_type = typename workspace<C>::held_type;

    workspace<C>& work;
    policies<C>& by;
    std::tuple<Body&...>& bodies;
    real dt;
    double time, held_start = time, held_end = time;  // now, and the times whose values conditions take
    real inverse_dt = real(1) / dt;

    T lanes_dt() const { return T(dt); }
    const auto& update() const { return by.transfer.particle; }
    template <class Load> const Load& load_as() const {
        static constexpr unloaded none{};
        if constexpr (std::same_as<Load, typename C::load>)
            return by.load;
        else
            return none;
    }

    /// f(body, sweeps of its velocity field).
    template <class F> void each_body(F f) const {
        work.each_body(bodies, [&](auto& body, auto& field) { f(body, field.sweeps); });
    }
    /// f(sweeps) of all velocity fields.
    template <class F> void each_sweeps(F f) const {
        for (auto& field : work.fields) f(field.sweeps);
    }
    /// The held nodes of a velocity field, by its sweeps.
    auto& held_of(const auto& sweeps) const {
        std::size_t k = 0;
        while (&work.fields[k].sweeps != &sweeps) ++k;
        return work.fields[k].held;
    }
    /// f(held), which looks at no node.
    template <class F> void each_holder(F f) const {
        for (auto& field : work.fields) f(field.held);
    }
    /// f(held, nodes, range), which looks at the nodes of a range only.
    template <class F> void each_held_in(F f) const {
        if constexpr (held_type::any)
            for (auto& field : work.fields)
                field.sweeps.runner().over_nodes([f, &field](std::size_t first, std::size_t last) {
                    f(field.held, field.sweeps.nodes_of_pass(), node_range{first, last});
                });
    }
    /// Where conditions hold the same direction of a node, they must agree once its mass is there.
    void check_held_values() const {
        if constexpr (held_type::any)
            for (auto& field : work.fields)
                if (field.held.may_disagree()) {
                    field.sweeps.runner().run_waiting();
                    field.held.check_values();
                }
    }
    template <class... F> void set_zero(fields<F...>) const {
        for (auto& field : work.fields) field.sweeps.template set_zero<F...>();
    }
    template <class... F> void exchange(fields<F...> sums) const {
        for (auto& field : work.fields) field.exchange(work.lattice, sums);
    }
    /// The passes are done: work of the conditions is counted, and what waited is run.
    void end() const {
        if constexpr (held_type::any)
            for (auto& field : work.fields)
                field.sweeps.runner().at_end([&held = field.held, dt = dt] { held.finish(dt); });
        for (auto& field : work.fields) field.sweeps.runner().run_waiting();
    }
    template <class Use> void mass_operator(const Use& use) {
        tamis::detail::mass_operator<step_now> op{*this};
        use(op);
    }

    /// The node tables of all velocity fields, in the order of the bodies.
    auto tables() const {
        std::array<const typename workspace<C>::nodes_type*, sizeof...(Body)> all;
        for (std::size_t k = 0; k < sizeof...(Body); ++k) all[k] = &work.field_of(k).sweeps.nodes();
        return all;
    }
    /// Nodes that bodies share, their normals and distances.
    void find_contact() const {
        using touch = typename C::touch;
        const auto fields_of = tables();
        work.contact.find(fields_of, [&](std::size_t k, std::size_t at) -> real {
            if constexpr (C::moves)
                return fields_of[k]->template at<field::mass>(at);
            else {
                const real inverse = fields_of[k]->template at<field::inverse_mass>(at);
                return inverse > real(0) ? real(1) / inverse : real(0);
            }
        });
        if (!work.contact.any()) return;
        if constexpr (touch::by_mass || touch::by_place) {
            set_zero(on_nodes_t<touch>{});
            const contact_to_nodes<S, typename C::shape, touch::by_mass, touch::by_place> kernel{};
            each_body([&](auto& body, auto& sweeps) { sweeps.scatter(body, kernel); });
        }
        if constexpr (touch::by_particles || touch::by_given)
            if (work.contact.looks_at_particles()) gather_contact();
        work.contact.measure(fields_of, by.run);
    }

  private:
    /// The particles around nodes that bodies share.
    void gather_contact() const {
        work.contact.gather(sizeof...(Body), [this](const auto& f) {
            this->each_body([&](auto& body, auto& sweeps) {
                sweeps.runner().run_waiting();
                f(body.store());
            });
        });
    }
};

}  // namespace tamis::detail
