#pragma once

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include "basis.hpp"
#include "held.hpp"
#include "scene.hpp"

namespace reference {

/// v(k) = sum of k increments, dv_1 = `lumped`, dv_l = A dv_(l-1) with held components taken out, and the sum of what
/// was taken out. k = 1 gives `lumped` back.
struct full_mass_velocity {
    Eigen::MatrixXd v;
    Eigen::MatrixXd removed;

    full_mass_velocity(const Eigen::MatrixXd& lumped, int k, const basis& shapes, const held_nodes& held)
        : v(lumped), removed(Eigen::MatrixXd::Zero(lumped.rows(), lumped.cols())) {
        if (k < 1) throw std::invalid_argument("reference: give k of at least 1.");
        Eigen::MatrixXd increment = lumped;
        for (int l = 2; l <= k; ++l) {
            const Eigen::MatrixXd unconstrained = shapes.A * increment;
            increment = held.zeroed(unconstrained);
            removed += unconstrained - increment;
            v += increment;
        }
    }
};

/// Linear elasticity in small increments: stress += C : sym(grad v) dt; bar in 1D, plane strain in 2D.
/// `v`: nodal velocities (nodes x D).
inline void strain_particles(const scene& set, state& body, const basis& shapes, const Eigen::MatrixXd& v, double dt) {
    const Eigen::Index dimension = set.dimension();
    for (Eigen::Index p = 0; p < body.size(); ++p) {
        Eigen::MatrixXd gradient(dimension, dimension);
        for (Eigen::Index b = 0; b < dimension; ++b)
            gradient.col(b) = (shapes.G[static_cast<std::size_t>(b)].row(p) * v).transpose();
        const Eigen::MatrixXd strain = dt * (gradient + gradient.transpose()) / 2;
        const double young = set.young.size() == 1 ? set.young[0] : set.young[p];
        Eigen::MatrixXd& stress = body.stress[static_cast<std::size_t>(p)];
        if (dimension == 1) {
            stress += young * strain;
        } else {
            const double shear = young / (2 * (1 + set.poisson));
            const double lame = young * set.poisson / ((1 + set.poisson) * (1 - 2 * set.poisson));
            stress += 2 * shear * strain + lame * strain.trace() * Eigen::MatrixXd::Identity(dimension, dimension);
        }
    }
}

/// f = -G^T (V0 stress) + S^T (M b), nodes x D, in newtons.
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
    return f;
}

/// One step from t to t + dt, by full matrices. Returns the reactions (nodes x D, newtons).
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
///     XPIC(k)    V' = S v0(k) + S a dt         sum P0 + d2 + (P+ - P0) - P - f dt         = d0 + d1 + d2
///     FMPM(k)    V' = S v+(k)                  sum P+ + d2 - P - f dt                     = d0 + d1 + d2
/// with d2 from the sum that is handed to the particles. Divided by dt, node by node, these are the reactions.
/// One more term makes the balance exact: a node without mass takes no part, so a force upon it (a gradient need not
/// vanish where the weight does) is lost, as if held by a reaction -f.
inline Eigen::MatrixXd step(const scene& set, state& body, double t, double dt) {
    const basis shapes = evaluate_basis(set, body.x, body.mass);
    const held_nodes held(set, shapes);
    const Eigen::MatrixXd& S = shapes.S;
    const update_kind kind = set.update.kind;
    const stress_order order = set.order;

    const bool euler = order == stress_order::euler;
    const bool half_and_half = order == stress_order::usavg_minus || order == stress_order::usavg_plus;
    const bool again = order == stress_order::usl_plus || order == stress_order::usavg_plus;
    const double time_of_start = euler ? std::max(set.start_time, t - dt) : t;
    const double time_of_end = euler ? t : t + dt;

    // Only FMPM strains with its own velocity; k = 1 is the lumped one.
    const int k_strain = kind == update_kind::fmpm ? set.update.k : 1;
    const auto straining = [&](const Eigen::MatrixXd& lumped) {
        return full_mass_velocity(lumped, k_strain, shapes, held).v;
    };

    const Eigen::MatrixXd P = S.transpose() * (body.mass.asDiagonal() * body.v);
    const Eigen::MatrixXd v_free = shapes.inverse_mass.asDiagonal() * P;
    const Eigen::MatrixXd v_start = held.imposed(v_free, time_of_start);

    if (order == stress_order::usf) strain_particles(set, body, shapes, straining(v_start), dt);
    if (half_and_half) strain_particles(set, body, shapes, straining(v_start), dt / 2);

    const Eigen::MatrixXd f = nodal_forces(set, body, shapes, t);
    if (euler) strain_particles(set, body, shapes, straining(v_start), dt);

    const Eigen::MatrixXd v_end_free = v_start + dt * (shapes.inverse_mass.asDiagonal() * f);
    const Eigen::MatrixXd v_end = held.imposed(v_end_free, time_of_end);
    const Eigen::MatrixXd a = (v_end - v_start) / dt;

    const Eigen::MatrixXd d0 = shapes.mass.asDiagonal() * (v_start - v_free);
    const Eigen::MatrixXd d1 = shapes.mass.asDiagonal() * (v_end - v_end_free);
    Eigen::MatrixXd impulse;

    const Eigen::MatrixXd V = body.v;
    Eigen::MatrixXd V_new;
    Eigen::MatrixXd X_new;
    switch (kind) {
        case update_kind::pic:
            V_new = S * v_end;
            X_new = body.x + S * v_end * dt;
            impulse = d0 + d1;
            break;
        case update_kind::flip:
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
            const full_mass_velocity full(v_start, set.update.k, shapes, held);
            V_new = S * full.v + S * a * dt;
            X_new = body.x + (S * v_start + (V_new - V) / 2) * dt;
            impulse = d0 + d1 - shapes.mass.asDiagonal() * full.removed;
            break;
        }
        case update_kind::fmpm: {
            const full_mass_velocity full(v_end, set.update.k, shapes, held);
            V_new = S * full.v;
            X_new = body.x + (V + V_new) / 2 * dt;
            impulse = d0 + d1 - shapes.mass.asDiagonal() * full.removed;
            break;
        }
    }

    if (order != stress_order::usf && !euler) {
        Eigen::MatrixXd lumped = v_end;
        if (again) {
            const Eigen::MatrixXd P_new = S.transpose() * (body.mass.asDiagonal() * V_new);
            lumped = held.imposed(shapes.inverse_mass.asDiagonal() * P_new, time_of_end);
        }
        strain_particles(set, body, shapes, straining(lumped), half_and_half ? dt / 2 : dt);
    }

    body.v = V_new;
    if (set.motion == motion::moving) body.x = X_new;

    Eigen::MatrixXd reactions = impulse / dt;
    for (Eigen::Index i = 0; i < set.node_count(); ++i)
        if (!shapes.takes_part(i)) reactions.row(i) -= f.row(i);
    return reactions;
}

}  // namespace reference
