#pragma once
#include <tamis/boundary/conditions.hpp>
#include <tamis/boundary/held_entry.hpp>
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/engine/node_range.hpp>
#include <tamis/grid/lattice.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace tamis::detail {

/// The nodes that conditions hold, and the values they are held to. Conditions at one node are made orthonormal once;
/// values follow by the same triangular map (docs/method.md, Several directions at a node).
template <class S, class Shape, class Boundary> class held_entries {
  public:
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    static constexpr int D = S::dim;
    static constexpr bool any = !requires { requires Boundary::never; };
    using entry = held_entry<D, real>;

    held_entries(const Boundary& boundary, const lattice_type& lattice) : boundary_(boundary) {
        if constexpr (any) find(lattice);
    }

    /// All held nodes; those that no particle reaches have zeros.
    const std::vector<entry>& all() const { return entries_; }
    entry& at_number(std::size_t k) { return entries_[k]; }
    /// f(entry) for those that particles reach.
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
    /// Which blocks of nodes particles reach: the others take no part.
    void attend(std::span<const char> reached) {
        active_.clear();
        forget_values();
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

    /// Values of time t. The end of one step is the start of the next: they are made once. Are they new?
    bool set_values(double t) {
        if (t == values_at_) return false;
        forget_values();  // a condition may throw
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
        values_at_ = t;
        return true;
    }
    /// A sentence about conditions that hold no node; empty if all do.
    std::string idle() const {
        std::string which;
        for (std::size_t k = 0; k < holds_any_.size(); ++k)
            if (!holds_any_[k]) which += sentence(which.empty() ? "" : ", ", k);
        if (which.empty()) return {};
        return sentence("boundary conditions that hold no node of the grid: ", which,
                        " (counted from 0); check their regions against the places of nodes, and leave room for "
                        "round-off");
    }
    /// Values are asked for anew, whatever their time.
    void forget_values() { values_at_ = std::numeric_limits<double>::quiet_NaN(); }
    /// Are there conditions that hold the same direction of a node?
    bool may_disagree() const { return !repeated_.empty(); }
    /// Throws `error` where they do not agree about it.
    void check_values() const {
        for (const repeated& r : repeated_) check_repeated(r, values_at_);
    }

  private:
    using vector = point<D, real>;
    struct given {
        int condition;
        vector normal;
    };
    /// A direction that other conditions hold already: it must say the same as they.
    struct repeated {
        std::uint32_t entry;
        given by;
    };
    Boundary boundary_;
    std::vector<entry> entries_;
    std::vector<given> given_;
    std::vector<repeated> repeated_;
    std::vector<bool> holds_any_;        // of conditions
    std::vector<std::uint32_t> active_;  // of entries_
    double values_at_ = std::numeric_limits<double>::quiet_NaN();

    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    vector velocity_of(int condition, const vector& where, double t) const {
        vector u = vector::Zero();
        int c = 0;
        each_of(each_condition(boundary_), [&](const auto& each) {
            if (c++ == condition) u = as_point<D, real>(each.velocity(where, constant<real>(t)));
        });
        return u;
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
        each_of(each_condition(boundary_), [&](const auto&) { holds_any_.push_back(false); });
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
        holds_any_[at(index)] = true;
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

}  // namespace tamis::detail
