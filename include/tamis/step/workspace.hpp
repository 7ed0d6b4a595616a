#pragma once
#include <tamis/contact/touching_nodes.hpp>
#include <tamis/core/each_of.hpp>
#include <tamis/step/assembled_matrix.hpp>
#include <tamis/step/velocity_field.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tamis {

/// How far the series of the full mass matrix went: its terms, and sqrt(sum m dv^2 / sum m) of the last one (m/s).
struct series_report {
    int terms = 0;              ///< How many.
    double last_increment = 0;  ///< Size of the last one (m/s).
};

namespace detail {

/// The policies of a composition that have something to say at run time.
template <class C> struct policies {
    typename C::shape shape;
    typename C::transfer transfer;
    typename C::load load;
    typename C::execution run;
    typename C::boundary boundary;
    [[no_unique_address]] typename C::method method;
};

/// What a composition works with from step to step besides the particles: the nodes, what holds them, contact, and what
/// the engine has made ahead.
template <class C> struct workspace {
    using velocity_field = detail::velocity_field<C>;
    using lattice_type = typename velocity_field::lattice_type;
    using held_type = typename velocity_field::held_type;
    using nodes_type = typename velocity_field::sweeps_type::nodes_type;
    using fields_type =
        std::conditional_t<C::own_velocities, std::deque<velocity_field>, std::array<velocity_field, 1>>;

    const policies<C>& by;
    lattice_type lattice;
    fields_type fields;  // one for all bodies, or one for each
    typename contact_of<typename C::S, typename C::shape, typename C::touch>::type contact;
    assembled_matrix<C> matrix;
    bool image_is_zero = false;  // on all nodes, so that the next sum can begin
    wavefront waiting;
    long steps_in_waves = 0;
    series_report series;
    /// The sums that a step begins with, made by the step before (`composition::sums_ahead`): are they there, of which
    /// state of the body, and is it worth while to make them?
    struct {
        bool made = false, pays = false;
        int pause = 0, next_pause = 1;
        std::uint64_t updates = 0;
        long used = 0;
    } ahead;

    workspace(const policies<C>& all, const typename C::touch& touch, const typename C::grid_type& grid)
        : by(all), lattice(grid), fields(first_field()), contact(touch, lattice) {}
    workspace(const workspace&) = delete;
    workspace& operator=(const workspace&) = delete;

    double boundary_work() const {
        double work = 0;
        for (const auto& field : fields) work += field.held.work();
        return work;
    }
    double lightest_free_node() const {
        double lightest = std::numeric_limits<double>::infinity();
        for (const auto& field : fields) lightest = std::min(lightest, field.lightest_free_node());
        return lightest;
    }
    /// Held nodes, with the reactions of all velocity fields.
    auto reactions() const {
        auto all = fields[0].held.reactions();
        for (std::size_t f = 1; f < fields.size(); ++f) {
            const auto more = fields[f].held.reactions();
            for (std::size_t k = 0; k < all.size(); ++k) all[k].reaction += more[k].reaction;
        }
        return all;
    }
    /// A run begins, and counts anew.
    void restart() {
        ahead.used = 0;
        steps_in_waves = 0;
        for (auto& field : fields) field.held.restart();
        if constexpr (C::own_velocities) contact.restart();
    }
    velocity_field& field_of(std::size_t body) { return fields[C::own_velocities ? body : 0]; }
    /// f(body, its velocity field).
    template <class... Body, class F> void each_body(std::tuple<Body&...>& all, F f) {
        std::size_t k = 0;
        each_of(all, [&](auto& b) { f(b, field_of(k++)); });
    }
    /// Passes of a step were not run: there is no matrix, no image that is known, and values of conditions are asked
    /// for anew.
    void forget() {
        matrix.weights_change();
        image_is_zero = ahead.made = false;
        for (auto& field : fields) field.held.forget_values();
    }
    /// Particles are about to move, if they do: what throws then must not leave a matrix of where they were.
    void weights_change() {
        if constexpr (C::moves && (C::assembles || requires { requires C::mass::exact; })) matrix.weights_change();
    }
    /// Masses of nodes where the particles are now.
    template <class... Body> void sum_masses(std::tuple<Body&...>& all) {
        each_field_of(all, [&](auto& field, const auto& each_body_of_field) {
            field.template sum_masses<field::mass>(lattice, each_body_of_field);
        });
    }
    /// What does not change from step to step: which nodes are in use and, for held particles, the nodes' masses.
    /// `look()` looks at bodies that a user may have changed.
    template <class... Body, class Look> void prepare(std::tuple<Body&...>& all, const Look& look) {
        prepare_bodies(all, look);
        for (auto& field : fields) field.sweeps.runner().begin_step();
    }
    /// Were the step's sums over particles made by the step before, and are they still those of the body?
    template <class Store> bool sums_are_made(const Store& store) {
        const bool made = std::exchange(ahead.made, false) && ahead.updates == store.updates;
        // Where they were of no use, as after particles went to other cells, some steps go without: ever more while it
        // happens again and again.
        if (made) {
            ahead.next_pause = 1;
            ++ahead.used;
        } else if (ahead.pays) {
            ahead.pause = ahead.next_pause;
            ahead.next_pause = std::min(2 * ahead.next_pause, 64);
        }
        ahead.pays = ahead.pause == 0 && !any_axis_wraps(lattice);
        if (ahead.pause > 0) --ahead.pause;
        return made;
    }

  private:
    std::vector<std::uint64_t> seen_;  // stamps of the bodies as they were prepared

    void add_field(std::deque<velocity_field>& to) const {
        to.emplace_back(by.shape, lattice, by.run, by.boundary, by.method);
    }
    fields_type first_field() const {
        if constexpr (C::own_velocities) {
            fields_type all;
            add_field(all);
            return all;
        } else
            return {velocity_field(by.shape, lattice, by.run, by.boundary, by.method)};
    }
    /// f(field, each), each(g) calls g for the bodies of that field.
    template <class... Body, class F> void each_field_of(std::tuple<Body&...>& all, const F& f) {
        for (std::size_t k = 0; k < fields.size(); ++k)
            f(fields[k], [&](auto g) {
                std::size_t body = 0;
                each_of(all, [&](auto& b) {
                    if (!C::own_velocities || body++ == k) g(b);
                });
            });
    }
    template <class... Body, class Look> void prepare_bodies(std::tuple<Body&...>& all, const Look& look) {
        constexpr std::size_t count = sizeof...(Body);
        std::array<std::uint64_t, 2 * count> now;
        std::size_t k = 0;
        each_of(all, [&](auto& b) { now[k++] = b.contents().number(); });
        each_of(all, [&](auto& b) { now[k++] = b.store().layout.number(); });
        if (std::equal(now.begin(), now.end(), seen_.begin(), seen_.end())) return;
        ahead.made = false;
        const bool as_before = seen_.size() == now.size();
        const auto contents_end = now.begin() + static_cast<std::ptrdiff_t>(count);
        if (!as_before || !std::equal(now.begin(), contents_end, seen_.begin())) look();
        seen_.clear();  // what throws is looked at again
        each_of(all, [&](auto& b) { b.store().template arrange<lattice_type::N>(); });
        if constexpr (C::own_velocities)
            while (fields.size() < count) add_field(fields);
        each_field_of(all, [&](auto& field, const auto& each_body_of_field) {
            std::vector<placed_tiles> tiles;
            each_body_of_field([&](auto& b) { tiles.push_back(tiles_of(b.store())); });
            field.attend(tiles, lattice);
        });
        if constexpr (!C::moves) {
            for (auto& field : fields) field.sweeps.runner().begin_step();
            each_field_of(all, [&](auto& field, const auto& each_body_of_field) {
                field.template sum_masses<field::inverse_mass>(lattice, each_body_of_field);
                field.invert_held_masses();
            });
        }
        matrix.weights_change();
        seen_.assign(now.begin(), now.end());
    }
};

}  // namespace detail
}  // namespace tamis
