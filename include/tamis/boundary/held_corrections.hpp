#pragma once
#include <tamis/boundary/held_entry.hpp>
#include <tamis/boundary/held_inverse.hpp>
#include <tamis/boundary/methods.hpp>
#include <tamis/core/names.hpp>

#include <cstddef>
#include <vector>

namespace tamis::detail {

/// What a full mass matrix's velocity lacks at held nodes, by the methods that ask for it after the matrix has acted
/// (docs/method.md, Other methods). `Entries`: the held nodes.
template <class Entries> class held_corrections {
  public:
    static constexpr int D = Entries::D;
    using real = typename Entries::real;
    using entry = typename Entries::entry;

    /// Keeps the nodes' lumped velocities, which the full mass matrix is about to change.
    template <class From, class Nodes> void remember(Entries& entries, const Nodes& nodes) {
        entries.each([&](entry& e) { e.lumped = nodes.template get<From>(e.place); });
    }
    /// Held components of a velocity take their values.
    template <class To, class Nodes>
    void impose_velocity(Entries& entries, const Nodes& nodes, const real& inverse_dt, bool counts) {
        entries.each([&](entry& e) {
            if (!(e.mass > real(0))) return;
            const vector u = nodes.template get<To>(e.place), change = e.missing(u);
            nodes.template put<To>(e.place, vector(u + change));
            if (counts) e.node.reaction += change * (e.mass * inverse_dt);
        });
    }
    /// Puts into `Increment` (zero until now) the velocity that, by the method, the conditions add to held nodes; `To`
    /// holds the full mass matrix's result.
    template <class Increment, class To, class Nodes>
    void correct(held_by how, Entries& entries, const Nodes& nodes, const real& inverse_dt, bool counts) {
        if (how == held_by::collected) solve_collected<To>(entries, nodes);
        entries.each([&](entry& e) {
            if (!(e.mass > real(0))) return;
            vector change;
            if (how == held_by::unlumped1)
                change = e.missing(e.lumped);
            else if (how == held_by::unlumped2)
                change = e.missing(nodes.template get<To>(e.place));
            else if (how == held_by::partial)
                change = e.missing(e.lumped) / (e.mass * inverse_.diagonal(e.row));
            else
                change = e.lumped;
            nodes.template put<Increment>(e.place, change);
            if (counts) e.node.reaction += change * (e.mass * inverse_dt);
        });
    }
    /// Columns of M~_k^-1 at the held nodes, D of them at a time, one per component of `Increment`: first m^-1 e_i ...
    int batches(Entries& entries) {
        int rows = 0;
        entries.each([&](entry& e) { e.row = e.mass > real(0) ? rows++ : -1; });
        inverse_.start(rows);
        return (rows + D - 1) / D;
    }
    template <class Increment, class Nodes> void start_columns(Entries& entries, const Nodes& nodes, int batch) {
        entries.each([&](entry& e) {
            if (e.row >= 0 && e.row / D == batch) nodes.template at<Increment>(e.place, e.row % D) = real(1) / e.mass;
        });
    }
    /// ... then, term by term, what the series adds.
    template <class Increment, class Nodes> void add_columns(Entries& entries, const Nodes& nodes, int batch) {
        entries.each([&](entry& e) {
            for (int d = 0; d < D && e.row >= 0 && batch * D + d < inverse_.rows(); ++d)
                inverse_.add(e.row, batch * D + d, nodes.template at<Increment>(e.place, d));
        });
    }

  private:
    using vector = typename entry::vector;
    held_inverse<D, real> inverse_;

    static constexpr std::size_t at(int k) { return static_cast<std::size_t>(k); }
    /// Impulses j of all held nodes with [M~_k^-1] j = b - v on held components; leaves j/m in `lumped`.
    template <class To, class Nodes> void solve_collected(Entries& entries, const Nodes& nodes) {
        std::vector<typename held_inverse<D, real>::direction> all;
        entries.each([&](const entry& e) {
            const vector u = nodes.template get<To>(e.place);
            for (int k = 0; k < e.directions && e.row >= 0; ++k)
                all.push_back({e.row, e.normal[at(k)], e.value[at(k)] - e.normal[at(k)].dot(u)});
        });
        const std::vector<real> impulse = inverse_.impulses(all);
        std::size_t next = 0;
        entries.each([&](entry& e) {
            e.lumped.setZero();
            for (int k = 0; k < e.directions && e.row >= 0; ++k) e.lumped += impulse[next++] / e.mass * e.normal[at(k)];
        });
    }
};

}  // namespace tamis::detail
