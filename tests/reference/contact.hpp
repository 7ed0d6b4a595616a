#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "basis.hpp"
#include "held.hpp"
#include "law.hpp"
#include "mass.hpp"
#include "scene.hpp"
#include "step.hpp"

namespace reference {

enum class contact_law { bonded, frictionless, coulomb };

/// What contact acts upon beside the momentum of the step's start: p+ and every increment of the full mass matrix's
/// series, as p+ was found to touch; the same, each partial sum judged anew; p+ alone; p+, with the start's change d
/// filtered out of the series, P_k v+ - P_(k-1) d for P_k = 1 + A + ... + A^(k-1); the velocity that the series gave.
enum class contact_stage { increments, sums, momentum, filtered, velocity };

/// How bodies, each with nodal velocities of its own, meet on the nodes they share.
struct contact_rule {
    contact_law law = contact_law::coulomb;
    double mu = 0;
    /// Unit normal at a place, from the body with the smaller number to the other; if empty, along
    /// (S-slopes of mass of the first) - (those of the second), (sum_p M_p G_pi)_a - (sum_p M_p G_pi)_b.
    std::function<Eigen::VectorXd(const Eigen::VectorXd& at)> normal = {};
    /// Bodies touch only if (x_b - x_a) . n < cells * spacing, x = sum_p S_pi M_p X_p / m.
    double cells = std::numeric_limits<double>::infinity();
    contact_stage stage = contact_stage::increments;
};

enum class contact_state { apart, sticks, slides };

/// A node that two bodies share.
struct shared_node {
    Eigen::Index node = 0;
    std::size_t a = 0, b = 0;
    double m_a = 0, m_b = 0;
    Eigen::VectorXd normal = {};  ///< from a to b
    bool near = true;             ///< near enough to touch
    contact_state state = contact_state::apart;
    Eigen::VectorXd tangent = {};  ///< of sliding, b against a
    Eigen::VectorXd force = {};    ///< on a, as its particles felt it in the step (N)
    Eigen::VectorXd free = {};     ///< b against a as it would be without contact (m/s)
    Eigen::VectorXd impulse = {};  ///< on a, for that
    double heat = 0;

    double reduced() const { return m_a * m_b / (m_a + m_b); }
};

/// A nodal field (nodes x D) of each body.
using fields_of_bodies = std::vector<Eigen::MatrixXd>;

/// The nodes that bodies share, and the impulses there. With w = v_b - v_a, J = m_red w on a and -J on b would make the
/// two move as one: v_a + J/m_a = v_b - J/m_b. Momentum is kept by whatever part of J is taken.
class contact_nodes {
  public:
    contact_nodes(const scene& set, const contact_rule& rule, const std::vector<state>& bodies,
                  const std::vector<basis>& shapes)
        : rule_(rule) {
        for (std::size_t b = 1; b < bodies.size(); ++b)
            for (std::size_t a = 0; a < b; ++a)
                for (Eigen::Index i = 0; i < set.node_count(); ++i) {
                    if (!shapes[a].takes_part(i) || !shapes[b].takes_part(i)) continue;
                    shared_node e{i, a, b, shapes[a].mass[i], shapes[b].mass[i]};
                    e.tangent = e.force = Eigen::VectorXd::Zero(set.dimension());
                    e.normal = rule.normal ? rule.normal(set.node_position(i))
                                           : Eigen::VectorXd(slope_of_mass(bodies[a], shapes[a], i) -
                                                             slope_of_mass(bodies[b], shapes[b], i));
                    e.normal.normalize();
                    if (rule.law != contact_law::bonded && std::isfinite(rule.cells)) {
                        const double apart =
                            (mean_place(bodies[b], shapes[b], i) - mean_place(bodies[a], shapes[a], i)).dot(e.normal);
                        e.near = apart < rule.cells * set.spacing;
                        decided(apart / set.spacing - rule.cells);
                    }
                    all_.push_back(e);
                }
    }

    /// Lumped velocities become those that the contact allows: the states are found anew. Returns the heat of friction,
    /// the tangential impulses times the mean sliding velocity. `inverse_dt`: 1/dt if particles feel it.
    double lumped(fields_of_bodies& v, double inverse_dt = 0) {
        scale_ = 0;
        double heat = 0;
        for (const Eigen::MatrixXd& field : v) scale_ = std::max(scale_, field.cwiseAbs().maxCoeff());
        for (shared_node& e : all_) {
            judge(e, relative(e, v));
            heat += e.heat;
            apply(e, e.impulse, v);
            e.force += e.impulse * inverse_dt;
        }
        return heat;
    }

    /// Increments of the full mass matrix's series: nodes that stick get equal ones; those that slide get equal normal
    /// components, and as much friction for it as the law has, in the direction it had. Returns the friction's heat,
    /// with the sliding velocity of `sum`, what the increments before add up to.
    double increments(const fields_of_bodies& sum, fields_of_bodies& dv, double inverse_dt = 0) {
        double heat = 0;
        for (shared_node& e : all_) {
            if (e.state == contact_state::apart) continue;
            Eigen::VectorXd J = e.reduced() * relative(e, dv);
            if (e.state == contact_state::slides) {
                const double along = J.dot(e.normal), across = -along * friction();
                J = along * e.normal + across * e.tangent;
                const double before = (relative(e, sum) + relative(e, dv)).dot(e.tangent);
                heat += across * (before + (before - across / e.reduced())) / 2;
            }
            apply(e, J, dv);
            e.force += J * inverse_dt;
        }
        return heat;
    }

    /// Increments, where the law is asked about what they add up to. Returns what the heat grows by.
    double sums(fields_of_bodies& dv, double inverse_dt = 0) {
        double heat = 0;
        for (shared_node& e : all_) {
            const Eigen::VectorXd before = e.impulse;
            heat -= e.heat;
            judge(e, Eigen::VectorXd(e.free + relative(e, dv)));
            heat += e.heat;
            apply(e, Eigen::VectorXd(e.impulse - before), dv);
            e.force += (e.impulse - before) * inverse_dt;
        }
        return heat;
    }
    /// The change of the lumped velocities by `lumped`, nodes x D of each body like `v`.
    fields_of_bodies change(const fields_of_bodies& v) const {
        fields_of_bodies d = v;
        for (Eigen::MatrixXd& field : d) field.setZero();
        for (const shared_node& e : all_) apply(e, e.impulse, d);
        return d;
    }
    void unfelt(double inverse_dt, const std::vector<Eigen::VectorXd>& impulses) {
        for (std::size_t n = 0; n < all_.size(); ++n) all_[n].force -= impulses[n] * inverse_dt;
    }
    std::vector<Eigen::VectorXd> impulses() const {
        std::vector<Eigen::VectorXd> now;
        for (const shared_node& e : all_) now.push_back(e.impulse);
        return now;
    }

    const std::vector<shared_node>& all() const { return all_; }
    /// The smallest distance of a decision (touching or not, sticking or sliding) from the opposite one, relative to
    /// the largest velocity or the spacing.
    double margin() const { return margin_; }

  private:
    contact_rule rule_;
    std::vector<shared_node> all_;
    double margin_ = std::numeric_limits<double>::infinity(), scale_ = 0;

    /// The state and the impulse for a relative velocity w that there would be without contact.
    void judge(shared_node& e, const Eigen::VectorXd& w) {
        e.free = w;
        e.heat = 0;
        e.state = contact_state::sticks;
        e.impulse = e.reduced() * w;
        if (rule_.law == contact_law::bonded) return;
        const double approach = w.dot(e.normal);
        if (e.near) decided(approach / scale_);
        if (!e.near || !(approach < 0)) {
            e.state = contact_state::apart;
            e.impulse.setZero();
            return;
        }
        const Eigen::VectorXd slip = w - approach * e.normal;
        const double wanted = e.reduced() * slip.norm();
        const double pressed = e.reduced() * -approach;
        const double allowed = friction() * pressed;
        decided((wanted - allowed) / (e.reduced() * scale_));
        if (!(allowed < wanted)) return;
        e.state = contact_state::slides;
        e.tangent = slip.normalized();
        e.impulse = -pressed * e.normal + allowed * e.tangent;
        e.heat = allowed * (slip.norm() - allowed / (2 * e.reduced()));
    }
    double friction() const { return rule_.law == contact_law::coulomb ? rule_.mu : 0; }
    void decided(double by) { margin_ = std::min(margin_, std::abs(by)); }
    static Eigen::VectorXd relative(const shared_node& e, const fields_of_bodies& v) {
        return (v[e.b].row(e.node) - v[e.a].row(e.node)).transpose();
    }
    static void apply(const shared_node& e, const Eigen::VectorXd& J, fields_of_bodies& v) {
        v[e.a].row(e.node) += J.transpose() / e.m_a;
        v[e.b].row(e.node) -= J.transpose() / e.m_b;
    }
    static Eigen::VectorXd slope_of_mass(const state& body, const basis& shapes, Eigen::Index node) {
        Eigen::VectorXd sum(body.x.cols());
        for (Eigen::Index d = 0; d < sum.size(); ++d)
            sum[d] = shapes.G[static_cast<std::size_t>(d)].col(node).dot(body.mass);
        return sum;
    }
    static Eigen::VectorXd mean_place(const state& body, const basis& shapes, Eigen::Index node) {
        const Eigen::VectorXd share = shapes.S.col(node).cwiseProduct(body.mass) / shapes.mass[node];
        return body.x.transpose() * share;
    }
};

/// What a step of several bodies tells.
struct contact_result {
    Eigen::MatrixXd reactions;          ///< of the conditions upon all bodies, nodes x D, newtons
    std::vector<shared_node> touching;  ///< as they were for p + f dt
    double heat = 0;                    ///< of friction (J)
    double margin = 0;                  ///< see contact_nodes::margin
};

/// One step of bodies of one law that touch, by FLIP, XPIC(k) or FMPM(k). Contact acts before the conditions, which
/// therefore hold: on the momentum of the start, a change that FLIP's particles do not feel; on p + f dt, as a force;
/// on every increment made of either; and on momentum that is extrapolated again. Other stages of the rule leave some
/// of these out.
inline contact_result advance(const scene& set, const contact_rule& rule, std::vector<state>& bodies, double t,
                              double dt) {
    const bool is_fmpm = set.update.kind == update_kind::fmpm, is_xpic = set.update.kind == update_kind::xpic;
    if (!(is_fmpm || is_xpic || (set.update.kind == update_kind::flip && set.update.psi == 0)) ||
        set.update.period != 1 || set.boundary_method != boundary_method::incremental ||
        set.order == stress_order::euler)
        throw std::invalid_argument("reference: contact is there for FLIP, XPIC and FMPM by increments, not in euler.");
    const stress_order order = set.order;
    const bool half_and_half = order == stress_order::usavg_minus || order == stress_order::usavg_plus;
    const bool again = order == stress_order::usl_plus || order == stress_order::usavg_plus;
    const double part = half_and_half ? dt / 2 : dt;
    const int k = is_fmpm || is_xpic ? set.update.k : 1;

    std::vector<basis> shapes;
    std::vector<held_nodes> held;
    for (const state& body : bodies) {
        shapes.push_back(evaluate_basis(set, body));
        held.emplace_back(set, shapes.back());
    }
    contact_nodes contact(set, rule, bodies, shapes);
    contact_result result;
    result.reactions = Eigen::MatrixXd::Zero(set.node_count(), set.dimension());

    const auto each = [&](auto f) {
        for (std::size_t b = 0; b < bodies.size(); ++b) f(b);
    };
    // Conditions upon lumped velocities, and what they did.
    const auto impose = [&](fields_of_bodies& v, double time, bool counts) {
        each([&](std::size_t b) {
            const Eigen::MatrixXd free = v[b];
            v[b] = held[b].imposed(free, time);
            if (counts) result.reactions += shapes[b].mass.asDiagonal() * (v[b] - free) / dt;
        });
    };
    const bool after_series = rule.stage == contact_stage::velocity;
    // `d`: what contact changed at the step's start, or in the momentum that was extrapolated last.
    fields_of_bodies d;
    std::vector<Eigen::VectorXd> of_start;
    double heat_of_start = 0;
    fields_of_bodies gained(bodies.size());  // by the forces
    const auto full = [&](const fields_of_bodies& lumped, double time, bool counts) {
        fields_of_bodies v = lumped, dv = lumped;
        if (rule.stage == contact_stage::filtered) {
            fields_of_bodies term = d;
            for (int l = 1; l < k; ++l)
                each([&](std::size_t b) {
                    const Eigen::MatrixXd free = l == 1 ? term[b] : Eigen::MatrixXd(shapes[b].A * term[b]);
                    term[b] = held[b].zeroed(free);
                    v[b] -= term[b];
                    if (counts) result.reactions += shapes[b].mass.asDiagonal() * (free - term[b]) / dt;
                });
            if (counts && k > 1) {
                contact.unfelt(1 / dt, of_start);
                result.heat -= heat_of_start;
            }
        }
        for (int l = 2; l <= k; ++l) {
            each([&](std::size_t b) { dv[b] = shapes[b].A * dv[b]; });
            double heat = 0;
            if (rule.stage == contact_stage::increments) {
                fields_of_bodies sum = v;
                if (counts && is_xpic) each([&](std::size_t b) { sum[b] += gained[b]; });
                heat = contact.increments(sum, dv, counts ? 1 / dt : 0);
            }
            if (rule.stage == contact_stage::sums) heat = contact.sums(dv, counts ? 1 / dt : 0);
            if (counts) result.heat += heat;
            each([&](std::size_t b) {
                const Eigen::MatrixXd free = dv[b];
                dv[b] = held[b].zeroed(free);
                if (counts) result.reactions += shapes[b].mass.asDiagonal() * (dv[b] - free) / dt;
                v[b] += dv[b];
            });
        }
        if (after_series) {
            const double heat = contact.lumped(v, counts ? 1 / dt : 0);
            if (counts) result.heat += heat;
            impose(v, time, counts);
        }
        return v;
    };
    const auto strain = [&](const fields_of_bodies& v) {
        each([&](std::size_t b) { strain_particles(set, bodies[b], shapes[b], v[b], part); });
    };
    const auto velocities = [&] {
        fields_of_bodies v(bodies.size());
        each([&](std::size_t b) {
            v[b] = shapes[b].inverse_mass.asDiagonal() * shapes[b].S.transpose() *
                   (bodies[b].mass.asDiagonal() * bodies[b].v);
        });
        return v;
    };

    fields_of_bodies v_start = velocities();
    const double start_heat = contact.lumped(v_start, is_fmpm || is_xpic ? 1 / dt : 0);
    if (is_fmpm || is_xpic) result.heat = heat_of_start = start_heat;
    d = contact.change(v_start);
    of_start = contact.impulses();
    impose(v_start, t, is_fmpm || is_xpic);
    if (order == stress_order::usf || half_and_half) strain(is_xpic ? v_start : full(v_start, t, false));

    fields_of_bodies v_end(bodies.size());
    each([&](std::size_t b) {
        const Eigen::MatrixXd f = nodal_forces(set, bodies[b], shapes[b], t);
        v_end[b] = v_start[b] + dt * (shapes[b].inverse_mass.asDiagonal() * f);
        for (Eigen::Index i = 0; i < set.node_count(); ++i)
            if (!shapes[b].takes_part(i)) result.reactions.row(i) -= f.row(i);
    });
    if (!after_series) result.heat += contact.lumped(v_end, 1 / dt);
    impose(v_end, t + dt, true);
    each([&](std::size_t b) { gained[b] = v_end[b] - v_start[b]; });
    // XPIC's particles take the series of the start's velocity, and the acceleration.
    fields_of_bodies v_last = full(is_xpic ? v_start : v_end, t + dt, true);
    result.touching = contact.all();

    fields_of_bodies x(bodies.size());
    each([&](std::size_t b) {
        const Eigen::MatrixXd& S = shapes[b].S;
        const Eigen::MatrixXd V = bodies[b].v;
        if (is_fmpm) {
            bodies[b].v = S * v_last[b];
            x[b] = bodies[b].x + dt * (V + bodies[b].v) / 2;
        } else if (is_xpic) {
            bodies[b].v = S * (v_last[b] + gained[b]);
            x[b] = bodies[b].x + dt * (S * v_start[b] + (bodies[b].v - V) / 2);
        } else {
            bodies[b].v = V + S * gained[b];
            x[b] = bodies[b].x + dt * (S * v_end[b]);
        }
    });
    if (is_xpic) v_last = v_end;
    if (again) {
        v_last = velocities();
        if (!after_series) contact.lumped(v_last);
        d = contact.change(v_last);
        impose(v_last, t + dt, false);
        if (is_fmpm) v_last = full(v_last, t + dt, false);
    }
    if (order != stress_order::usf) strain(v_last);
    each([&](std::size_t b) {
        if (set.motion == motion::moving) bodies[b].x = x[b];
        ++bodies[b].steps;
    });
    result.margin = contact.margin();
    return result;
}

}  // namespace reference
