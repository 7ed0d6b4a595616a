#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "affine.hpp"
#include "basis.hpp"
#include "boundary.hpp"
#include "held.hpp"
#include "law.hpp"
#include "load.hpp"
#include "scene.hpp"

namespace reference {

/// f = -G^T (V0 stress) + S^T (M b) and what loads apply, nodes x D, in newtons.
inline Eigen::MatrixXd nodal_forces(const scene& set, const state& body, const basis& shapes, double t) {
    const Eigen::Index dimension = set.dimension();
    Eigen::MatrixXd f = Eigen::MatrixXd::Zero(set.node_count(), dimension);
    for (Eigen::Index b = 0; b < dimension; ++b) {
        Eigen::MatrixXd pull(body.size(), dimension);
        for (Eigen::Index p = 0; p < body.size(); ++p)
            pull.row(p) = body.volume[p] * body.stress[static_cast<std::size_t>(p)].col(b).transpose();
        f -= shapes.G[static_cast<std::size_t>(b)].transpose() * pull;
    }
    if (set.acceleration) {
        Eigen::MatrixXd load(body.size(), dimension);
        for (Eigen::Index p = 0; p < body.size(); ++p)
            load.row(p) =
                body.mass[p] * set.acceleration(body.x.row(p).transpose(), body.v.row(p).transpose(), t).transpose();
        f += shapes.S.transpose() * load;
    }
    return f + applied_forces(set, body, shapes, t);
}

/// What a step tells beside the particles.
struct step_result {
    Eigen::MatrixXd reactions;  ///< nodes x D, newtons
    Eigen::MatrixXd velocity;   ///< v+, of the nodes, which strains the particles last: of FMPM(k) its own, else lumped
    Eigen::VectorXd mass;       ///< of the nodes, lumped
    double last_increment = 0;  ///< sqrt(sum m |dv_k|^2 / sum m) of the series given to the particles; 0 without one
};

/// One step from t to t + dt, by full matrices.
///
/// Reactions. Write P and P0 for the nodal momenta before and after the values of t are imposed, P+ for those after the
/// values of t + dt are imposed on P0 + f dt, and
///     d0 = P0 - P,    d1 = P+ - P0 - f dt,    d2 = -m (what was removed from the increments dv_2 .. dv_k).
/// The weights at a particle add up to one and their gradients to zero. Hence sum_p M (S u)_p = sum_i m_i u_i for any
/// nodal field u, sum_i P = sum_p M V, and sum_i f = sum_p M b. Further m^T A = m^T - M^T S = 0: an increment carries
/// no momentum but for what the conditions remove from it. With these, sum_p M (V' - V) less dt sum_p M b is
///     PIC        V' = S v+                     sum P+ - P - f dt                          = d0 + d1
///     FLIP       V' = V + S a dt               sum P+ - P0 - f dt                         = d1
///     blend      V' = alpha V + S (v+ - alpha v0)
///                                              sum P+ - alpha P0 - (1 - alpha) P - f dt   = (1 - alpha) d0 + d1
///     APIC, TPIC as PIC, and FLIP with affine spreading as FLIP: sum_i P_i has sum_p M C sum_i w (x_i - X) = 0 besides
///     XPIC(k)    V' = S v0(k) + S a dt         sum P0 + d2 + (P+ - P0) - P - f dt         = d0 + d1 + d2
///     FMPM(k)    V' = S v+(k)                  sum P+ + d2 - P - f dt                     = d0 + d1 + d2
/// with d2 from the sum that is handed to the particles. Divided by dt, node by node, these are the reactions.
/// FMPM with another boundary method than `incremental` has sum m v+(k) - P - f dt = sum of that method's impulses; see
/// velocity_under_conditions, which starts from P + f dt: P0 has no part in it.
/// One more term makes the balance exact: a node without mass takes no part, so a force upon it (a gradient need not
/// vanish where the weight does) is lost, as if held by a reaction -f.
inline step_result advance(const scene& set, state& body, double t, double dt) {
    if (set.boundary_method != boundary_method::incremental &&
        (set.update.kind != update_kind::fmpm || set.update.period != 1))
        throw std::invalid_argument("reference: only FMPM in every step has other boundary methods than incremental.");
    if (set.update.period < 1) throw std::invalid_argument("reference: give a period of at least 1.");
    const basis shapes = evaluate_basis(set, body);
    const held_nodes held(set, shapes);
    const Eigen::MatrixXd& S = shapes.S;
    const bool pause = set.update.kind == update_kind::fmpm && (body.steps + 1) % set.update.period != 0;
    const update_kind kind = pause ? update_kind::flip : set.update.kind;
    const stress_order order = set.order;

    const bool euler = order == stress_order::euler;
    const bool half_and_half = order == stress_order::usavg_minus || order == stress_order::usavg_plus;
    const bool again = order == stress_order::usl_plus || order == stress_order::usavg_plus;
    const double time_of_start = euler ? std::max(set.start_time, t - dt) : t;
    const double time_of_end = euler ? t : t + dt;

    // Only FMPM strains with its own velocity; k = 1 is the lumped one.
    const int k_strain = kind == update_kind::fmpm ? set.update.k : 1;
    const auto velocity = [&](const Eigen::MatrixXd& momentum, double time, int k) {
        return velocity_under_conditions(set.boundary_method, momentum, time, k, shapes, held);
    };

    const Eigen::MatrixXd P = nodal_momentum(set, body, shapes, body.v);
    const Eigen::MatrixXd v_free = shapes.inverse_mass.asDiagonal() * P;
    const Eigen::MatrixXd v_start = held.imposed(v_free, time_of_start);

    if (order == stress_order::usf || half_and_half)
        strain_particles(set, body, shapes, velocity(P, time_of_start, k_strain).v, half_and_half ? dt / 2 : dt);

    const Eigen::MatrixXd f = nodal_forces(set, body, shapes, t) + damping_forces(set, body, shapes, v_start, t, dt);
    if (euler) strain_particles(set, body, shapes, velocity(P, time_of_start, k_strain).v, dt);

    const Eigen::MatrixXd v_end_free = v_start + dt * (shapes.inverse_mass.asDiagonal() * f);
    const Eigen::MatrixXd v_end = held.imposed(v_end_free, time_of_end);
    const Eigen::MatrixXd a = (v_end - v_start) / dt;

    const Eigen::MatrixXd d0 = shapes.mass.asDiagonal() * (v_start - v_free);
    const Eigen::MatrixXd d1 = shapes.mass.asDiagonal() * (v_end - v_end_free);
    Eigen::MatrixXd impulse;

    const Eigen::MatrixXd V = body.v;
    Eigen::MatrixXd V_new;
    Eigen::MatrixXd X_new;
    step_result result;
    result.mass = shapes.mass;
    result.velocity = v_end;
    switch (kind) {
        case update_kind::pic:
        case update_kind::apic:
        case update_kind::tpic:
            V_new = S * v_end;
            X_new = body.x + S * v_end * dt;
            impulse = d0 + d1;
            break;
        case update_kind::flip:
        case update_kind::affine_flip:
            V_new = V + S * a * dt;
            X_new = body.x + (S * v_end - set.update.psi / 2 * (S * a) * dt) * dt;
            impulse = d1;
            break;
        case update_kind::blend:
        case update_kind::graphics_blend: {
            const double alpha = set.update.alpha;
            V_new = alpha * V + S * (v_end - alpha * v_start);
            X_new = kind == update_kind::blend ? Eigen::MatrixXd(body.x + S * v_end * dt)
                                               : Eigen::MatrixXd(body.x + V_new * dt);
            impulse = (1 - alpha) * d0 + d1;
            break;
        }
        case update_kind::xpic: {
            const nodal_velocity full = velocity(P, time_of_start, set.update.k);
            V_new = S * full.v + S * a * dt;
            X_new = body.x + (S * v_start + (V_new - V) / 2) * dt;
            impulse = full.impulse + d1;
            result.last_increment = full.last_increment;
            break;
        }
        case update_kind::fmpm: {
            const nodal_velocity full = velocity(P + f * dt, time_of_end, set.update.k);
            V_new = S * full.v;
            X_new = body.x + (V + V_new) / 2 * dt;
            impulse = full.impulse;
            result.velocity = full.v;
            result.last_increment = full.last_increment;
            break;
        }
    }

    if (is_affine(set.update)) body.affine = affine_slopes(set, body, shapes, v_end);
    if (order != stress_order::usf && !euler) {
        Eigen::MatrixXd v = result.velocity;
        if (again) v = velocity(nodal_momentum(set, body, shapes, V_new), time_of_end, k_strain).v;
        strain_particles(set, body, shapes, v, half_and_half ? dt / 2 : dt);
    }

    body.v = V_new;
    if (set.motion == motion::moving) body.x = X_new;
    ++body.steps;

    result.reactions = impulse / dt;
    for (Eigen::Index i = 0; i < set.node_count(); ++i)
        if (!shapes.takes_part(i)) result.reactions.row(i) -= f.row(i);
    return result;
}

/// One step; returns the reactions (nodes x D, newtons).
inline Eigen::MatrixXd step(const scene& set, state& body, double t, double dt) {
    return advance(set, body, t, dt).reactions;
}

}  // namespace reference
