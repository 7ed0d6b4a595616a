#pragma once

#include <stdexcept>

#include <Eigen/Dense>

#include "basis.hpp"
#include "held.hpp"
#include "mass.hpp"
#include "scene.hpp"

namespace reference {

/// Nodal velocities (nodes x D) made of momenta under conditions, and what that did.
struct nodal_velocity {
    Eigen::MatrixXd v;
    Eigen::MatrixXd impulse;    ///< by the conditions, node by node: sum m v = sum p + sum impulse
    double last_increment = 0;  ///< sqrt(sum m |dv_k|^2 / sum m); 0 where the matrix is solved exactly
};

/// Velocity from the momenta p* (nodes x D) that no condition has touched, held components h having the values b at t,
/// by the full mass matrix to k terms, Minv_k = sum_(l<k) A^l m^-1. f_l = m b - p* in the held components, 0 elsewhere,
/// is the impulse that holds the lumped velocity.
///
///     incremental   dv_1 = (p* + f_l)/m, dv_l = A dv_(l-1) less its held components; v = sum dv_l
///     lumped        v = Minv_k (p* + f_l)
///     velocity      v = Minv_k p*, then v_h = b
///     combined      v = Minv_k (p* + f_l), then v_h = b
///     unlumped1     v = Minv_k (p* + Mt m^-1 f_l)
///     unlumped2     v = Minv_k (p* + Mt d), d = b - Minv_k p* in the held components, 0 elsewhere
///     partial       v = Minv_k (p* + j), (Minv_k)_ii j_i = b_i - p*_i/m_i for each held component by itself
///     collected     v = Minv_k (p* + j), [Minv_k]_hh j = b - (Minv_k p*)_h for all together
///
/// What holds of them:
/// - k = 1: v_h = b in all but the unlumped ones, and all but these are the lumped velocity with v_h = b.
/// - k = 2: `combined` is `incremental`, velocities and impulses: dv_1 has the held values, and dv_2 = A dv_1 is the
///   first that is cut.
/// - any k: incremental, velocity, combined and collected give v_h = b.
/// - k -> infinity: incremental and collected are the constrained least squares solution, for which (Mt v - p*) is
///   zero but in held components, where it is the impulse. unlumped2 becomes velocity.
/// - [Minv_k]_hh can always be solved with: see inverse_mass_matrix.
///
/// Impulses. m^T A = 0 and 1^T Mt = m^T give sum m Minv_k p = sum p and sum Mt u = sum m u for all p and u. So the
/// momentum sum m v - sum p* is the sum over the held components of
///     incremental f_l - m (what was cut),  lumped f_l,  velocity m (b - Minv_k p*),  combined f_l + m (b - Minv_k p+),
///     unlumped1 f_l,  unlumped2 m d,  partial and collected j.
inline nodal_velocity velocity_under_conditions(boundary_method method, const Eigen::MatrixXd& p, double t, int k,
                                                const basis& shapes, const held_nodes& held) {
    const Eigen::Index dimension = p.cols();
    const Eigen::VectorXd b = held.values(t);
    const Eigen::VectorXd& m_h = held.mass();
    const auto spread = [&](const Eigen::VectorXd& components) { return held.spread(components, dimension); };
    const Eigen::MatrixXd f_l = spread(m_h.cwiseProduct(b) - held.along(p));

    if (method == boundary_method::incremental) {
        if (k == exact_solve) {
            const Eigen::MatrixXd v = constrained_least_squares(p, b, shapes, held);
            return {v, spread(held.along(shapes.full_mass * v - p))};
        }
        const full_mass_velocity full(held.imposed(shapes.inverse_mass.asDiagonal() * p, t), k, shapes, held);
        return {full.v, f_l - shapes.mass.asDiagonal() * full.removed, mass_norm(full.last, shapes)};
    }

    const Eigen::MatrixXd inverse = inverse_mass_matrix(shapes, k);
    Eigen::MatrixXd impulse = Eigen::MatrixXd::Zero(p.rows(), dimension);
    Eigen::MatrixXd p_used = p;  // what Minv_k is applied to
    bool set_after = false;
    switch (method) {
        case boundary_method::incremental:
            break;
        case boundary_method::velocity:
            set_after = true;
            break;
        case boundary_method::combined:
            set_after = true;
            [[fallthrough]];
        case boundary_method::lumped:
            impulse = f_l;
            p_used = p + f_l;
            break;
        case boundary_method::unlumped1:
            impulse = f_l;
            p_used = p + shapes.full_mass * (shapes.inverse_mass.asDiagonal() * f_l);
            break;
        case boundary_method::unlumped2: {
            const Eigen::MatrixXd d = spread(b - held.along(inverse * p));
            impulse = shapes.mass.asDiagonal() * d;
            p_used = p + shapes.full_mass * d;
            break;
        }
        case boundary_method::partial:
        case boundary_method::collected: {
            // [Minv_k]_hh = N Minv_k N^T, column by column.
            Eigen::MatrixXd between(b.size(), b.size());
            for (Eigen::Index e = 0; e < b.size(); ++e)
                between.col(e) = held.along(inverse * spread(Eigen::VectorXd::Unit(b.size(), e)));
            const Eigen::VectorXd j =
                method == boundary_method::partial
                    ? Eigen::VectorXd((b - held.along(p).cwiseQuotient(m_h)).cwiseQuotient(between.diagonal()))
                    : Eigen::VectorXd(between.fullPivLu().solve(b - held.along(inverse * p)));
            impulse = spread(j);
            p_used = p + impulse;
            break;
        }
    }

    Eigen::MatrixXd v = inverse * p_used;
    if (set_after) {
        const Eigen::MatrixXd change = spread(b - held.along(v));
        impulse += shapes.mass.asDiagonal() * change;
        v += change;
    }
    if (k == exact_solve) return {v, impulse};
    Eigen::MatrixXd last = shapes.inverse_mass.asDiagonal() * p_used;
    for (int l = 2; l <= k; ++l) last = shapes.A * last;
    return {v, impulse, mass_norm(last, shapes)};
}

}  // namespace reference
