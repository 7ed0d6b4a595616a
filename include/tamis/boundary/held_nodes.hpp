#pragma once
#include <tamis/boundary/held_corrections.hpp>
#include <tamis/boundary/held_entries.hpp>
#include <tamis/boundary/held_walls.hpp>
#include <tamis/boundary/methods.hpp>
#include <tamis/boundary/stopped_particles.hpp>
#include <tamis/engine/node_range.hpp>
#include <tamis/engine/node_table.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tamis::detail {

/// What is done in a step to the nodes that conditions hold (docs/method.md, Boundary conditions). By the default,
/// incremental: held components of p/m take their values of t at once, those of p+/m the values of t + dt, and those of
/// every further increment of the full mass matrix's series are zero.
template <class S, class Shape, class Boundary, class Method = boundary_method::incremental> class held_nodes {
    using entries_type = held_entries<S, Shape, Boundary>;
    using walls_type = held_walls<S, Shape, entries_type>;

  public:
    using real = typename S::real;
    using lattice_type = typename entries_type::lattice_type;
    static constexpr int D = S::dim;
    static constexpr bool any = entries_type::any;

    held_nodes(const Boundary& boundary, const lattice_type& lattice, const Method& method = {})
        : entries_(boundary, lattice), method_(method), walls_(entries_, lattice), stopped_(walls_) {}
    held_nodes(const held_nodes&) = delete;
    held_nodes& operator=(const held_nodes&) = delete;

    held_by how() const { return method_.how; }

    // What is done to nodes is done to those of a range; the values of all of them are made before. In a step: values
    // of the start, values of the end, then `start` and `forces`, range by range or for all nodes at once.

    /// Values of time t, the step's start.
    void start_values(double t) {
        if constexpr (any) {
            for (const std::size_t k : pushed_) entries_.at_number(k).node.reaction.setZero();
            pushed_.clear();
            if (entries_.set_values(t)) check_values();
            entries_.each([](entry& e) {
                e.before = e.node.velocity;
                e.start_value = e.value;
            });
        }
    }
    /// ... and its end. Where conditions may disagree `check_values` is to follow, once the nodes' masses are there.
    void end_values(double t) {
        if constexpr (any) entries_.set_values(t);
    }
    /// Are there conditions that hold the same direction of a node?
    bool may_disagree() const { return entries_.may_disagree(); }
    /// Throws `error` where they do not agree about it.
    void check_values() const {
        if constexpr (any) entries_.check_values();
    }
    /// Momentum p takes its held values of the start. `share` is the part of that change that reaches the particles.
    template <class Nodes>
    void start(const Nodes& nodes, const real& inverse_dt, double share, const node_range& range = {}) {
        if constexpr (any) {
            entries_.each(range, [&](entry& e) {
                if (!on_momentum(how())) {
                    e.node.reaction.setZero();
                    return;
                }
                e.node.reaction =
                    impose<field::momentum>(nodes, e, e.start_value) * (constant<real>(share) * inverse_dt);
                e.momentum = nodes.template get<field::momentum>(e.place);
            });
        }
    }
    /// Force f becomes the one that carries p, as `start` left it, to the held values of the end. That p is remembered:
    /// its column may hold the velocity by now, and m v is p only up to round-off.
    template <class Nodes> void forces(const Nodes& nodes, const real& inverse_dt, const node_range& range = {}) {
        if constexpr (any) {
            if (!on_momentum(how())) return;
            entries_.each(range, [&](entry& e) {
                if (!(e.mass > real(0))) return;
                const vector f = nodes.template get<field::force>(e.place);
                vector held = vector::Zero();
                for (int k = 0; k < D && k < e.directions; ++k) {
                    const vector& n = e.normal[at(k)];
                    held += ((e.mass * e.value[at(k)] - n.dot(e.momentum)) * inverse_dt - n.dot(f)) * n;
                }
                nodes.template put<field::force>(e.place, vector(f + held));
                e.node.reaction += held;
            });
        }
    }
    /// A momentum that was extrapolated after the particles' update takes the values that were set last; no reaction,
    /// for particles do not see it.
    template <class Momentum, class Nodes> void extrapolated(const Nodes& nodes, const node_range& range = {}) {
        if constexpr (any)
            if (on_momentum(how())) entries_.each(range, [&](entry& e) { impose<Momentum>(nodes, e, e.value); });
    }
    /// Held components of an increment become zero, in it and in the sum it was already added to.
    template <class Increment, class Sum, class Nodes>
    void increment(const Nodes& nodes, const real& inverse_dt, bool counts, const node_range& range = {}) {
        if constexpr (any) {
            if (how() != held_by::increments) return;
            entries_.each(range, [&](entry& e) {
                const vector dv = nodes.template get<Increment>(e.place), sum = nodes.template get<Sum>(e.place);
                vector gone = vector::Zero();
                for (int k = 0; k < D && k < e.directions; ++k) gone += e.normal[at(k)].dot(dv) * e.normal[at(k)];
                nodes.template put<Increment>(e.place, vector(dv - gone));
                nodes.template put<Sum>(e.place, vector(sum - gone));
                if (counts) e.node.reaction -= gone * (e.mass * inverse_dt);
            });
        }
    }

    // Full mass matrices: what `held_corrections` does, by the method of these nodes.

    template <class From, class Nodes> void remember(const Nodes& nodes) {
        corrections_.template remember<From>(entries_, nodes);
    }
    template <class To, class Nodes> void impose_velocity(const Nodes& nodes, const real& inverse_dt, bool counts) {
        corrections_.template impose_velocity<To>(entries_, nodes, inverse_dt, counts);
    }
    template <class Increment, class To, class Nodes>
    void correct(const Nodes& nodes, const real& inverse_dt, bool counts) {
        corrections_.template correct<Increment, To>(how(), entries_, nodes, inverse_dt, counts);
    }
    int batches() { return corrections_.batches(entries_); }
    template <class Increment, class Nodes> void start_columns(const Nodes& nodes, int batch) {
        corrections_.template start_columns<Increment>(entries_, nodes, batch);
    }
    template <class Increment, class Nodes> void add_columns(const Nodes& nodes, int batch) {
        corrections_.template add_columns<Increment>(entries_, nodes, batch);
    }

    /// Masses of held nodes; for particles that move in every step, before `start`.
    template <class Mass, class Nodes> void take_masses(const Nodes& nodes, const node_range& range = {}) {
        if constexpr (any) entries_.each(range, [&](entry& e) { e.template take_mass<Mass>(nodes); });
    }
    /// What particles may not pass.
    auto& walls() { return stopped_; }
    /// Adds the forces on particles that walls stopped, and the step's work: reaction times the mean held velocity.
    void finish(const real& dt) {
        if constexpr (any) {
            stopped_.take_pushes([&](const auto& push) { take(push); });
            entries_.each([&](entry& e) {
                work_ += static_cast<sum_type>(e.node.reaction.dot(e.before + e.node.velocity) * dt / real(2));
            });
        }
    }
    /// A particle that left the grid in a step of dt (`walls_type::stop`): did a wall stop it after all?
    template <class Vector> bool stop_leaver(const lattice_type& lattice, const std::array<int, 3>& cell,
                                             const Vector& from, Vector& to, Vector& velocity, const real& mass,
                                             const real& dt) {
        if constexpr (any) {
            std::vector<typename walls_type::push> pushes;
            const bool stopped = walls_.stop(lattice, cell, from, to, velocity, mass, real(1) / dt, pushes);
            for (const auto& push : pushes) {
                const entry& e = take(push);
                work_ += static_cast<sum_type>(push.force.dot(e.before + e.node.velocity) * dt / real(2));
            }
            return stopped;
        } else
            return false;
    }

    /// Why a side of the grid did not stop a particle that left it at a place, and what to do.
    std::string_view why_open(const lattice_type& lattice, const point<D, real>& where, int axis) const {
        if constexpr (any)
            return walls_.why_open(lattice, where, axis);
        else
            return walls_type::no_wall;
    }

    /// Work of the conditions since the start of the run (J).
    double work() const { return to_double(work_); }
    /// A run begins: no work was done, and values are asked for anew.
    void restart() {
        work_ = sum_type(0);
        forget_values();
    }
    void forget_values() {
        entries_.forget_values();
        stopped_.take_pushes([](const auto&) {});
    }
    /// Which blocks of nodes particles reach: the others take no part.
    void attend(std::span<const char> reached) {
        if constexpr (any) entries_.attend(reached);
    }
    /// Storage places of the nodes, in the order of storage.
    std::vector<std::size_t> places() const {
        std::vector<std::size_t> all;
        for (const entry& e : entries_.all()) all.push_back(e.place);
        std::sort(all.begin(), all.end());
        return all;
    }
    /// A sentence about conditions that hold no node of the grid; empty if all do.
    std::string idle() const {
        if constexpr (any)
            return entries_.idle();
        else
            return {};
    }
    /// All held nodes; those that no particle reaches have zeros.
    auto reactions() const {
        std::vector<held_node<D, real>> all;
        for (const entry& e : entries_.all()) all.push_back(e.node);
        return all;
    }

  private:
    using entry = typename entries_type::entry;
    using vector = typename entry::vector;
    using sum_type = std::conditional_t<std::is_same_v<real, float>, double, real>;
    entries_type entries_;
    [[no_unique_address]] Method method_;
    held_corrections<entries_type> corrections_;
    walls_type walls_;
    stopped_particles<walls_type> stopped_;
    std::vector<std::size_t> pushed_;  // entries that particles pushed in the last step
    sum_type work_{0};

    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    const entry& take(const typename walls_type::push& push) {
        entry& e = entries_.at_number(push.entry);
        e.node.reaction += push.force;
        pushed_.push_back(push.entry);
        return e;
    }
    /// Held components of the momentum take their values: the change.
    template <class Momentum, class Nodes>
    static vector impose(const Nodes& nodes, const entry& e, const typename entry::values& value) {
        const vector before = nodes.template get<Momentum>(e.place);
        vector change = vector::Zero();
        for (int k = 0; k < D && k < e.directions; ++k)
            change += (e.mass * value[at(k)] - e.normal[at(k)].dot(before)) * e.normal[at(k)];
        nodes.template put<Momentum>(e.place, vector(before + change));
        return change;
    }
};

}  // namespace tamis::detail
