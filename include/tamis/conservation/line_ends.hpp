#pragma once
#include <tamis/conservation/ends.hpp>
#include <tamis/conservation/kernels.hpp>
#include <tamis/engine/wrap.hpp>
#include <tamis/run/reach.hpp>

#include <vector>

namespace tamis::detail {

/// What the two ends of a line do to the unknowns at their nodes, and what came in through them.
template <class S, class Law, class Ends> class line_ends {
  public:
    using real = typename S::real;
    static constexpr int count = Law::unknowns;
    using state_type = conservation::state<count, real>;

    explicit line_ends(const Ends& ends) : ends_(ends) {}

    /// Throws `error` if the ends do not go with the grid, or if no particle reaches one. `nodes` have 1/m.
    template <class Shape, class Nodes>
    void find(const lattice<S, Shape>& lattice, const Shape& functions, const Nodes& nodes) {
        const auto& grid = lattice.grid();
        bool open = false;
        for (int d = 0; d < S::dim; ++d) open = open || !grid.wraps(d);
        if constexpr (S::dim > 1) {
            if (open)
                throw error(
                    "taylor_galerkin: in two and three dimensions the grid must be periodic; wrap all its axes, "
                    "grid.wrapped(0).wrapped(1)");
        } else if (open) {
            for (const int node : {0, grid.cells(0)}) {
                wall w{lattice.node_place({node, 0, 0}), {}, {}, {}};
                if (!(inverse_mass(nodes, w.node) > real(0)))
                    throw error(sentence("taylor_galerkin: no particle reaches the end at ", grid.node({node, 0, 0})[0],
                                         "; place particles up to both ends"));
                each_near_node(lattice, functions, grid.node({node, 0, 0}), [&](const auto& near) {
                    w.places.push_back(lattice.node_place(near.index));
                    w.weights.push_back(near.weight);
                    w.slopes.push_back(near.slope[0]);
                });
                walls_.push_back(w);
            }
        }
    }
    /// The flux through the ends at time t, of the states half a step after those at the nodes.
    template <class Nodes> void flow(const Law& law, const Nodes& nodes, const real& dt, double t) {
        const real half = dt / real(2);
        for (std::size_t k = 0; k < walls_.size(); ++k) {
            const wall& w = walls_[k];
            state_type inside = state_type::Zero();
            for (std::size_t j = 0; j < w.places.size(); ++j) {
                inside += w.weights[j] * get<unknowns>(nodes, w.places[j]);
                for (int c = 0; c < count; ++c)
                    inside[c] -= half * w.slopes[j] * nodes.template at<field::fluxes<count>>(w.places[j], c);
            }
            state_type in = law.flux(state_at(k, inside, t), 0);
            if (k == 1) in = -in;
            put<rate>(nodes, w.node, get<rate>(nodes, w.node) + in);
            gain_ += dt * in;
        }
    }
    /// The unknowns take what the ends hold.
    template <class Nodes> void hold(const Nodes& nodes, double t) {
        for (std::size_t k = 0; k < walls_.size(); ++k) {
            const std::size_t node = walls_[k].node;
            const state_type u = get<unknowns>(nodes, node), held_u = state_at(k, u, t);
            gain_ += (held_u - u) / inverse_mass(nodes, node);
            put<unknowns>(nodes, node, held_u);
        }
    }
    /// The term at hand, which `change` has already, takes what the ends hold.
    template <class Nodes> void hold_change(const Nodes& nodes, double t) {
        for (std::size_t k = 0; k < walls_.size(); ++k) {
            const std::size_t node = walls_[k].node;
            const state_type u = get<unknowns>(nodes, node) + get<change>(nodes, node), more = state_at(k, u, t) - u;
            gain_ += more / inverse_mass(nodes, node);
            put<change>(nodes, node, get<change>(nodes, node) + more);
            put<term>(nodes, node, get<term>(nodes, node) + more);
        }
    }
    /// What has come in: fluxes, and what held unknowns were given.
    const state_type& gain() const { return gain_; }
    void restart() { gain_.setZero(); }

  private:
    using unknowns = field::unknowns<count>;
    using change = field::change<count>;
    using term = field::change_term<count>;
    using rate = field::rate<count>;
    /// An end of a line: its node, and the functions there.
    struct wall {
        std::size_t node;
        std::vector<std::size_t> places;
        std::vector<real> weights, slopes;
    };
    Ends ends_;
    std::vector<wall> walls_;
    state_type gain_ = state_type::Zero();

    template <class Nodes> static real inverse_mass(const Nodes& nodes, std::size_t place) {
        return nodes.template at<field::inverse_mass>(place);
    }
    template <class F, class Nodes> static state_type get(const Nodes& nodes, std::size_t place) {
        state_type u;
        for (int c = 0; c < count; ++c) u[c] = nodes.template at<F>(place, c);
        return u;
    }
    template <class F, class Nodes> static void put(const Nodes& nodes, std::size_t place, const state_type& u) {
        for (int c = 0; c < count; ++c) nodes.template at<F>(place, c) = u[c];
    }
    /// The state at end k, of what the inside brings to it.
    state_type state_at(std::size_t k, const state_type& inside, double t) const {
        return k == 0 ? as_state<state_type>(ends_.low(inside, t)) : as_state<state_type>(ends_.high(inside, t));
    }
};

}  // namespace tamis::detail
