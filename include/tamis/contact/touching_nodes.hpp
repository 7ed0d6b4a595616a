#pragma once
#include <tamis/contact/shared_nodes.hpp>

#include <vector>

namespace tamis {

/// A node where two bodies touch, and what the contact did there in the last step.
template <int Dim, class Real> struct touching_node {
    point<Dim, Real> at;  ///< Place (m).
    /// Which bodies, in the order of bodies(...).
    int first, second;
    point<Dim, Real> normal;  ///< From the first to the second; zero for bonded bodies.
    point<Dim, Real> force;   ///< On the first (N), mean over the step; the second feels the opposite.
    bool slides;              ///< Do they slide?
};

namespace detail {

/// Corrections on nodes that two bodies reach (docs/method.md, Contact; Bardenhagen et al. 2001): with the relative
/// velocity w = v_2 - v_1, the impulse J = m_red w would make them move as one. Its normal part acts where they
/// approach, of its tangential part what the law allows. Momentum is kept exactly.
template <class S, class Shape, class Contact> class touching_nodes : public shared_nodes<S, Shape, Contact> {
    using base = shared_nodes<S, Shape, Contact>;
    using base::nodes_, base::policy_, base::lattice_;
    using typename base::entry;

  public:
    using typename base::real;
    using typename base::vector;
    static constexpr int D = S::dim;
    using base::base;

    /// Momenta p of the step's start, or of an extrapolation after it. `share`: how much of their change reaches the
    /// particles.
    template <class Momentum, class Fields>
    void momentum(const Fields& fields, const real& share = real(0), const real& inverse_dt = real(0)) {
        for (entry& e : nodes_) {
            const vector p[2] = {fields[e.field[0]]->template get<Momentum>(e.place),
                                 fields[e.field[1]]->template get<Momentum>(e.place)};
            const vector j = impulse(e, p[1] / e.mass[1] - p[0] / e.mass[0]);
            e.of_start = {j, share * e.heat};
            heat_ += to_double(e.of_start.heat);
            fields[e.field[0]]->template put<Momentum>(e.place, vector(p[0] + j));
            fields[e.field[1]]->template put<Momentum>(e.place, vector(p[1] - j));
            e.force += j * (share * inverse_dt);
        }
    }
    /// Forces f: those that carry the momenta p to ones that the contact allows.
    template <class Fields> void forces(const Fields& fields, const real& dt) {
        const real inverse_dt = real(1) / dt;
        for (entry& e : nodes_) {
            vector v[2], f[2];
            for (std::size_t k = 0; k < 2; ++k) {
                f[k] = fields[e.field[k]]->template get<field::force>(e.place);
                v[k] = fields[e.field[k]]->template get<field::momentum>(e.place) / e.mass[k];
                v[k] += f[k] * (dt / e.mass[k]);
            }
            const vector j = impulse(e, v[1] - v[0]);
            const vector pushes = j * inverse_dt;
            e.force += pushes;
            heat_ += to_double(e.heat);
            e.told = e.state;
            fields[e.field[0]]->template put<field::force>(e.place, vector(f[0] + pushes));
            fields[e.field[1]]->template put<field::force>(e.place, vector(f[1] - pushes));
        }
    }
    /// A velocity after the series.
    template <class To, class Fields> void velocity(const Fields& fields, const real& dt, bool counts) {
        for (entry& e : nodes_) {
            const vector v[2] = {fields[e.field[0]]->template get<To>(e.place),
                                 fields[e.field[1]]->template get<To>(e.place)};
            const vector j = impulse(e, v[1] - v[0]);
            fields[e.field[0]]->template put<To>(e.place, vector(v[0] + j / e.mass[0]));
            fields[e.field[1]]->template put<To>(e.place, vector(v[1] - j / e.mass[1]));
            if (!counts) continue;
            e.force += j / dt;
            heat_ += to_double(e.heat);
            e.told = e.state;
        }
    }
    /// An increment of the series, and the sum it was added to: the method says what becomes of them. `first`: it is
    /// the first beyond the lumped velocity.
    template <class Increment, class Sum, class Fields>
    void increment(const Fields& fields, const real& inverse_dt, bool counts, bool first) {
        constexpr contact_terms how = Contact::method_type::terms;
        if (how == contact_terms::first && !first) return;
        for (entry& e : nodes_) {
            const auto between = [&](auto field) {
                using F = decltype(field);
                return vector(fields[e.field[1]]->template get<F>(e.place) -
                              fields[e.field[0]]->template get<F>(e.place));
            };
            vector j;
            real heat(0);
            if constexpr (how == contact_terms::first) {
                j = -e.of_start.impulse;
                heat = -e.of_start.heat;
            } else if constexpr (how == contact_terms::net) {
                const vector before = e.given;
                heat = -e.heat;
                j = impulse(e, e.wanted + between(Increment{})) - before;
                heat += e.heat;
                if (counts) e.told = e.state;
            } else {
                j = share_of(e, between(Increment{}));
                if (e.state == contact_state::slides) {
                    const real friction = -j.dot(e.normal) * e.friction;
                    heat = friction * (between(Sum{}).dot(e.tangent) - friction / (real(2) * e.reduced));
                }
            }
            for (std::size_t k = 0; k < 2; ++k) {
                const vector change = j / (k == 0 ? e.mass[k] : -e.mass[k]);
                auto& nodes = *fields[e.field[k]];
                nodes.template put<Increment>(e.place, vector(nodes.template get<Increment>(e.place) + change));
                nodes.template put<Sum>(e.place, vector(nodes.template get<Sum>(e.place) + change));
            }
            if (!counts) continue;
            e.force += j * inverse_dt;
            heat_ += to_double(heat);
        }
    }

    /// Work that friction has taken from the bodies since the start of the run (J).
    double heat() const { return heat_; }
    void restart() {
        heat_ = 0;
        this->forget_meetings();
    }
    auto nodes() const {
        std::vector<touching_node<D, real>> all;
        for (const entry& e : nodes_)
            if (e.told != contact_state::apart || !e.force.isZero(real(0)))
                all.push_back({lattice_.place_of(e.place), static_cast<int>(e.field[0]), static_cast<int>(e.field[1]),
                               e.normal, e.force, e.told == contact_state::slides});
        return all;
    }

  private:
    double heat_ = 0;

    /// Impulse on the first body for a relative velocity w of the second.
    vector impulse(entry& e, const vector& w) const {
        e.heat = e.friction = real(0);
        e.wanted = w;
        if constexpr (Contact::always) {
            e.state = contact_state::sticks;
            e.given = e.reduced * w;
        } else
            e.given = impulse_where_pressed(e, w);
        return e.given;
    }
    /// The impulse for a further relative velocity w as its state was decided: bodies that stick get equal increments;
    /// those that slide get equal normal ones, and friction by the same share of them.
    vector share_of(const entry& e, const vector& w) const {
        if (e.state == contact_state::apart) return vector::Zero();
        const vector j = e.reduced * w;
        if (e.state == contact_state::sticks) return j;
        const real along = j.dot(e.normal);
        return along * e.normal - along * e.friction * e.tangent;
    }
    vector impulse_where_pressed(entry& e, const vector& w) const {
        const real along = w.dot(e.normal);
        e.state = contact_state::apart;
        if (!(along < real(0))) return vector::Zero();
        const vector across = w - along * e.normal;
        const real stick = e.reduced * across.norm(), pressed = -e.reduced * along;
        const real allowed = policy_.law.tangential(pressed, stick);
        e.state = allowed < stick ? contact_state::slides : contact_state::sticks;
        vector j = e.reduced * along * e.normal;
        if (stick > real(0)) {
            e.tangent = across * (e.reduced / stick);
            e.friction = allowed / pressed;
            j += allowed * e.tangent;
            if (allowed < stick) e.heat = allowed * (stick - allowed / real(2)) / e.reduced;
        }
        return j;
    }
};

/// What a solver keeps for its contact policy.
template <class S, class Shape, class Contact> struct contact_of { using type = touching_nodes<S, Shape, Contact>; };
template <class S, class Shape> struct contact_of<S, Shape, one_velocity> {
    struct type {
        type(const one_velocity&, const lattice<S, Shape>&) {}
    };
};

}  // namespace detail
}  // namespace tamis
