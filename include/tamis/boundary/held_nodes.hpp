#pragma once
#include <tamis/boundary/conditions.hpp>
#include <tamis/boundary/held_inverse.hpp>
#include <tamis/boundary/methods.hpp>
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/grid/node_range.hpp>
#include <tamis/grid/node_table.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tamis {

/// A node that conditions hold, with what they added in the last step.
template <int Dim, class Real> struct held_node {
    point<Dim, Real> at;
    /// Force of the conditions on the node (N), mean over the step: the sum over nodes balances the particles'
    /// momentum.
    point<Dim, Real> reaction;
    /// Held velocity at the end of the step (free directions: 0).
    point<Dim, Real> velocity;
};

namespace detail {

/// The nodes that conditions hold, and how they are held (docs/method.md, Boundary conditions). By the default,
/// incremental: held components of p/m take their values of t at once, those of p+/m the values of t + dt, and those of
/// every further increment of the full mass matrix's series are zero.
///
/// Conditions at one node are made orthonormal once; values follow by the same triangular map. `Sums`: the columns of
/// mass, momentum and force.
template <class S, class Shape, class Boundary, class Method = boundary_method::incremental, class Sums = sums_in_place>
class held_nodes {
  public:
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    static constexpr int D = S::dim;
    static constexpr bool any = !requires { requires Boundary::never; };

    held_nodes(const Boundary& boundary, const lattice_type& lattice, const Method& method = {})
        : boundary_(boundary), method_(method) {
        if constexpr (any) find(lattice);
    }

    held_by how() const { return method_.how; }

    // What is done to nodes is done to those of a range; the values of all of them are made before. In a step: values
    // of the start, values of the end, then `start` and `forces`, range by range or for all nodes at once.

    /// Values of time t, the step's start.
    void start_values(double t) {
        if constexpr (any) {
            if (set_values(t)) check_values();
            each([](entry& e) {
                e.before = e.node.velocity;
                e.start_value = e.value;
            });
        }
    }
    /// ... and its end. Where conditions may disagree `check_values` is to follow, once the nodes' masses are there.
    void end_values(double t) {
        if constexpr (any) set_values(t);
    }
    /// Are there conditions that hold the same direction of a node?
    bool may_disagree() const { return !repeated_.empty(); }
    /// Throws `error` where they do not agree about it.
    void check_values() const {
        if constexpr (any)
            for (const repeated& r : repeated_) check_repeated(r, values_at_);
    }
    /// Momentum p takes its held values of the start. `share` is the part of that change that reaches the particles.
    template <class Nodes> void start(const Nodes& nodes, bool masses_are_new, const real& inverse_dt, double share,
                                      const node_range& range = {}) {
        if constexpr (any) {
            each(range, [&](entry& e) {
                if (masses_are_new) take_mass<typename Sums::mass>(nodes, e);
                if (on_momentum(how()))
                    e.node.reaction = impose(nodes, e, e.start_value) * (constant<real>(share) * inverse_dt);
                else
                    e.node.reaction.setZero();
            });
        }
    }
    /// Force f becomes the one that carries p (with its values of the start) to the held values of the end. The
    /// momentum's column holds the momentum itself, or already the velocity.
    template <bool HoldsVelocity, class Nodes>
    void forces(const Nodes& nodes, const real& inverse_dt, const node_range& range = {}) {
        if constexpr (any) {
            if (!on_momentum(how())) return;
            each(range, [&](entry& e) {
                if (!(e.mass > real(0))) return;
                const vector p =
                    nodes.template get<typename Sums::momentum>(e.place) * (HoldsVelocity ? e.mass : real(1));
                const vector f = nodes.template get<typename Sums::force>(e.place);
                vector held = vector::Zero();
                for (int k = 0; k < D && k < e.directions; ++k) {
                    const vector& n = e.normal[at(k)];
                    held += ((e.mass * e.value[at(k)] - n.dot(p)) * inverse_dt - n.dot(f)) * n;
                }
                nodes.template put<typename Sums::force>(e.place, vector(f + held));
                e.node.reaction += held;
            });
        }
    }
    /// Momentum p takes its held values of time t; no reaction (particles do not see p).
    template <class Nodes> void extrapolated(const Nodes& nodes, double t) {
        if constexpr (any) {
            if (set_values(t)) check_values();
            if (on_momentum(how())) each([&](entry& e) { impose(nodes, e, e.value); });
        }
    }
    /// Held components of an increment become zero, in it and in the sum it was already added to.
    template <class Increment, class Sum, class Nodes>
    void increment(const Nodes& nodes, const real& inverse_dt, bool counts, const node_range& range = {}) {
        if constexpr (any) {
            if (how() != held_by::increments) return;
            each(range, [&](entry& e) {
                const vector dv = nodes.template get<Increment>(e.place), sum = nodes.template get<Sum>(e.place);
                vector gone = vector::Zero();
                for (int k = 0; k < D && k < e.directions; ++k) gone += e.normal[at(k)].dot(dv) * e.normal[at(k)];
                nodes.template put<Increment>(e.place, vector(dv - gone));
                nodes.template put<Sum>(e.place, vector(sum - gone));
                if (counts) e.node.reaction -= gone * (e.mass * inverse_dt);
            });
        }
    }

    /// Keeps the nodes' lumped velocities, which the full mass matrix is about to change.
    template <class Nodes> void remember(const Nodes& nodes) {
        each([&](entry& e) { e.lumped = nodes.template get<field::velocity>(e.place); });
    }
    /// Held components of a velocity take their values.
    template <class To, class Nodes> void impose_velocity(const Nodes& nodes, const real& inverse_dt, bool counts) {
        each([&](entry& e) {
            if (!(e.mass > real(0))) return;
            const vector u = nodes.template get<To>(e.place), change = missing(e, u);
            nodes.template put<To>(e.place, vector(u + change));
            if (counts) e.node.reaction += change * (e.mass * inverse_dt);
        });
    }
    /// Puts into `Increment` (zero until now) the velocity that, by the method, the conditions add to held nodes; `To`
    /// holds the full mass matrix's result.
    template <class Increment, class To, class Nodes>
    void correct(const Nodes& nodes, const real& inverse_dt, bool counts) {
        if (how() == held_by::collected) solve_collected<To>(nodes);
        each([&](entry& e) {
            if (!(e.mass > real(0))) return;
            vector change;
            if (how() == held_by::unlumped1)
                change = missing(e, e.lumped);
            else if (how() == held_by::unlumped2)
                change = missing(e, nodes.template get<To>(e.place));
            else if (how() == held_by::partial)
                change = missing(e, e.lumped) / (e.mass * inverse_.diagonal(e.row));
            else
                change = e.lumped;
            nodes.template put<Increment>(e.place, change);
            if (counts) e.node.reaction += change * (e.mass * inverse_dt);
        });
    }
    /// Columns of M~_k^-1 at the held nodes, D of them at a time, one per component of `Increment`: first m^-1 e_i ...
    int batches() {
        int rows = 0;
        each([&](entry& e) { e.row = e.mass > real(0) ? rows++ : -1; });
        inverse_.start(rows);
        return (rows + D - 1) / D;
    }
    template <class Increment, class Nodes> void start_columns(const Nodes& nodes, int batch) {
        each([&](entry& e) {
            if (e.row >= 0 && e.row / D == batch) nodes.template at<Increment>(e.place, e.row % D) = real(1) / e.mass;
        });
    }
    /// ... then, term by term, what the series adds.
    template <class Increment, class Nodes> void add_columns(const Nodes& nodes, int batch) {
        each([&](entry& e) {
            for (int d = 0; d < D && e.row >= 0 && batch * D + d < inverse_.rows(); ++d)
                inverse_.add(e.row, batch * D + d, nodes.template at<Increment>(e.place, d));
        });
    }

    /// Masses of held nodes, where they do not change from step to step.
    template <class Nodes> void take_masses(const Nodes& nodes) {
        if constexpr (any) each([&](entry& e) { take_mass<field::mass>(nodes, e); });
    }
    /// Adds the step's work: reaction times the mean held velocity.
    void finish(const real& dt) {
        if constexpr (any)
            each([&](entry& e) {
                work_ += static_cast<sum_type>(e.node.reaction.dot(e.before + e.node.velocity) * dt / real(2));
            });
    }

    /// Work of the conditions since the start of the run (J).
    double work() const { return to_double(work_); }
    /// A run begins: no work was done, and values are asked for anew.
    void restart() {
        work_ = sum_type(0);
        values_at_ = std::numeric_limits<double>::quiet_NaN();
    }
    /// Which blocks of nodes particles reach: the others take no part.
    void attend(std::span<const char> reached) {
        if constexpr (any) {
            active_.clear();
            values_at_ = std::numeric_limits<double>::quiet_NaN();
            for (std::uint32_t k = 0; k < entries_.size(); ++k) {
                entry& e = entries_[k];
                if (reached[e.place / static_cast<std::size_t>(S::width)]) {
                    active_.push_back(k);
                    continue;
                }
                e.mass = real(0);
                e.node.reaction.setZero();
                e.node.velocity.setZero();
            }
        }
    }
    /// All held nodes; those that no particle reaches have zeros.
    /// Storage places of the nodes, in the order of storage.
    std::vector<std::size_t> places() const {
        std::vector<std::size_t> all;
        for (const entry& e : entries_) all.push_back(e.place);
        std::sort(all.begin(), all.end());
        return all;
    }
    auto reactions() const {
        std::vector<held_node<D, real>> all;
        for (const entry& e : entries_) all.push_back(e.node);
        return all;
    }

  private:
    using vector = point<D, real>;
    struct entry {
        std::size_t place;
        int directions = 0;
        std::array<vector, static_cast<std::size_t>(D)> normal{};  // orthonormal
        std::array<std::array<real, static_cast<std::size_t>(D)>, static_cast<std::size_t>(D)>
            map{};                                              // normal = map * given
        std::array<int, static_cast<std::size_t>(D)> source{};  // index into given_
        std::array<real, static_cast<std::size_t>(D)> value{}, start_value{};
        real mass{};
        vector before = vector::Zero(), lumped = vector::Zero();
        int row = -1;  // of inverse_
        held_node<D, real> node;
    };
    struct given {
        int condition;
        vector normal;
    };
    /// A direction that other conditions hold already: it must say the same as they.
    struct repeated {
        std::uint32_t entry;
        given by;
    };
    using sum_type = std::conditional_t<std::is_same_v<real, float>, double, real>;
    Boundary boundary_;
    [[no_unique_address]] Method method_;
    std::vector<entry> entries_;
    std::vector<given> given_;
    std::vector<repeated> repeated_;
    std::vector<std::uint32_t> active_;  // of entries_
    double values_at_ = std::numeric_limits<double>::quiet_NaN();
    sum_type work_{0};
    held_inverse<D, real> inverse_;

    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    template <class F> void each(F f) {
        for (const std::uint32_t k : active_) f(entries_[k]);
    }
    /// ... those of a range; entries are in the order of their places.
    template <class F> void each(const node_range& range, F f) {
        auto k = active_.begin();
        if (range.first > 0)
            k = std::lower_bound(k, active_.end(), range.first,
                                 [&](std::uint32_t e, std::size_t place) { return entries_[e].place < place; });
        for (; k != active_.end() && entries_[*k].place < range.last; ++k) f(entries_[*k]);
    }
    template <class Mass, class Nodes> static void take_mass(const Nodes& nodes, entry& e) {
        e.mass = nodes.template at<Mass>(e.place);
        if (!(e.mass > real(0)) || e.mass < least_mass<real>()) e.mass = real(0);
    }
    /// Held components of the momentum take their values: the change.
    template <class Nodes> static vector impose(const Nodes& nodes, const entry& e,
                                                const std::array<real, static_cast<std::size_t>(D)>& value) {
        const vector before = nodes.template get<typename Sums::momentum>(e.place);
        vector change = vector::Zero();
        for (int k = 0; k < D && k < e.directions; ++k)
            change += (e.mass * value[at(k)] - e.normal[at(k)].dot(before)) * e.normal[at(k)];
        nodes.template put<typename Sums::momentum>(e.place, vector(before + change));
        return change;
    }
    /// What a velocity's held components lack.
    static vector missing(const entry& e, const vector& u) {
        vector change = vector::Zero();
        for (int k = 0; k < D && k < e.directions; ++k)
            change += (e.value[at(k)] - e.normal[at(k)].dot(u)) * e.normal[at(k)];
        return change;
    }
    /// Impulses j of all held nodes with [M~_k^-1] j = b - v on held components; leaves j/m in `lumped`.
    template <class To, class Nodes> void solve_collected(const Nodes& nodes) {
        std::vector<typename held_inverse<D, real>::direction> all;
        each([&](const entry& e) {
            const vector u = nodes.template get<To>(e.place);
            for (int k = 0; k < e.directions && e.row >= 0; ++k)
                all.push_back({e.row, e.normal[at(k)], e.value[at(k)] - e.normal[at(k)].dot(u)});
        });
        const std::vector<real> impulse = inverse_.impulses(all);
        std::size_t next = 0;
        each([&](entry& e) {
            e.lumped.setZero();
            for (int k = 0; k < e.directions && e.row >= 0; ++k) e.lumped += impulse[next++] / e.mass * e.normal[at(k)];
        });
    }
    vector velocity_of(int condition, const vector& where, double t) const {
        vector u = vector::Zero();
        int c = 0;
        each_of(each_condition(boundary_), [&](const auto& each) {
            if (c++ == condition) u = as_point<D, real>(each.velocity(where, constant<real>(t)));
        });
        return u;
    }
    /// Values of time t. The end of one step is the start of the next: they are made once. Are they new?
    bool set_values(double t) {
        if (t == values_at_) return false;
        values_at_ = t;
        each([&](entry& e) {
            e.node.velocity.setZero();
            std::array<real, static_cast<std::size_t>(D)> raw{};
            for (int k = 0; k < D && k < e.directions; ++k) {
                const given& g = given_[at(e.source[at(k)])];
                raw[at(k)] = g.normal.dot(velocity_of(g.condition, e.node.at, t));
                real value(0);
                for (int j = 0; j <= k; ++j) value += e.map[at(k)][at(j)] * raw[at(j)];
                e.value[at(k)] = value;
                e.node.velocity += value * e.normal[at(k)];
            }
        });
        return true;
    }
    void check_repeated(const repeated& r, double t) const {
        using std::abs;
        const entry& e = entries_[r.entry];
        if (!(e.mass > real(0))) return;
        const vector u = velocity_of(r.by.condition, e.node.at, t);
        const real difference = r.by.normal.dot(e.node.velocity) - r.by.normal.dot(u);
        const real scale = std::max<real>(u.norm(), e.node.velocity.norm());
        if (abs(difference) > constant<real>(1e-6) * scale)
            throw error(sentence("boundary conditions disagree at the node at (", list_of(e.node.at), "), t = ", t,
                                 ": two of them hold the same direction with values that differ by ", difference,
                                 "; make their regions disjoint or their values equal"));
    }

    void find(const lattice_type& lattice) {
        lattice.grid().each_node([&](const std::array<int, 3>& index) {
            const vector where = lattice.grid().node(index);
            entry e;
            e.place = lattice.node_place(index);
            e.node = {where, vector::Zero(), vector::Zero()};
            int c = 0;
            each_of(each_condition(boundary_), [&](const auto& each) { add(e, c++, each, where); });
            if (e.directions > 0) entries_.push_back(e);
        });
    }
    template <class Condition> void add(entry& e, int index, const Condition& condition, const vector& where) {
        if (!condition.holds(where)) return;
        if constexpr (requires { condition.normal(where); }) {
            const vector n = as_point<D, real>(condition.normal(where));
            const real length = n.norm();
            if (!(length > constant<real>(0.999999) && length < constant<real>(1.000001)))
                throw error(sentence("boundary condition ", index, ": its normal at (", list_of(where), ") has length ",
                                     length, "; give a unit vector"));
            hold(e, index, n / length);
        } else
            for (int d = 0; d < D; ++d) hold(e, index, vector::Unit(d));
    }
    void hold(entry& e, int index, const vector& n) {
        vector rest = n;
        std::array<real, static_cast<std::size_t>(D)> row{};
        for (int k = 0; k < D && k < e.directions; ++k) {
            const real along = e.normal[at(k)].dot(n);
            rest -= along * e.normal[at(k)];
            for (int j = 0; j <= k; ++j) row[at(j)] -= along * e.map[at(k)][at(j)];
        }
        const real length = rest.norm();
        if (!(length > constant<real>(1e-6))) {
            repeated_.push_back({static_cast<std::uint32_t>(entries_.size()), {index, n}});
            return;
        }
        const int k = e.directions++;
        e.normal[at(k)] = rest / length;
        row[at(k)] = real(1);
        for (int j = 0; j <= k; ++j) row[at(j)] /= length;
        e.map[at(k)] = row;
        e.source[at(k)] = static_cast<int>(given_.size());
        given_.push_back({index, n});
    }
};

}  // namespace detail
}  // namespace tamis
