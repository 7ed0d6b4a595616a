#pragma once
#include <tamis/core/config.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace tamis::detail {

/// The plane n . x + b = 0 that divides two clouds of points most probably, the second on the side that n points to:
/// the least sum_p (c_p - L(n . x_p + b))^2 + penalty |n|^2, c_p = -1 and 1, L(s) = 2/(1 + exp(-s)) - 1 (Nairn,
/// Hammerquist & Smith 2020). Points are in sides of a cell, from the node.
template <int D> class dividing_plane {
  public:
    using vector = Eigen::Matrix<double, D, 1, Eigen::DontAlign>;
    using unknowns = Eigen::Matrix<double, D + 1, 1, Eigen::DontAlign>;
    using square = Eigen::Matrix<double, D + 1, D + 1, Eigen::DontAlign>;
    /// A point: the side that it is on, c = -1 or 1, and its place with a 1 behind.
    struct member {
        double side;
        std::array<double, D + 1> at;
        member(double c, const vector& x) : side(c) {
            for (std::size_t d = 0; d < D; ++d) at[d] = x[static_cast<int>(d)];
            at[D] = 1;
        }
        double along(const unknowns& plane) const {
            double sum = 0;
            for (std::size_t d = 0; d <= D; ++d) sum += plane[static_cast<int>(d)] * at[d];
            return sum;
        }
    };
    using points = std::vector<member>;

    explicit dividing_plane(double penalty) : penalty_(penalty) {}

    /// The unit normal from the first cloud to the second; zero where one of them is empty, or both lie in each other.
    vector normal(const points& all) const {
        unknowns at = beginning(all);
        sums now = sums_at(at, all);
        // Newton's steps; the sum to be made least has flat tails, where a whole one may lead away.
        for (int k = 0; k < most_steps; ++k) {
            const unknowns step = now.curvature.ldlt().solve(now.descent);
            if (!step.allFinite()) break;
            double share = 1;
            sums next = sums_at(unknowns(at + step), all);
            while (!(next.error <= now.error) && share > least_share) {
                share /= 2;
                next = sums_at(unknowns(at + share * step), all);
            }
            if (!(next.error <= now.error)) break;
            const vector before = unit(at);
            at += share * step;
            now = next;
            if (share == 1 && (unit(at) - before).norm() < tolerance) break;
        }
        return unit(at);
    }

  private:
    static constexpr int most_steps = 40;
    static constexpr double least_share = 1e-3, tolerance = 1e-7;
    double penalty_;

    struct sums {
        double error;
        unknowns descent;
        square curvature;  // the lower half, which the solver takes
        void add(const member& p, double to_descent, double to_curvature) {
            for (int d = 0; d <= D; ++d) {
                const double x = p.at[static_cast<std::size_t>(d)];
                descent[d] += to_descent * x;
                for (int e = 0; e <= d; ++e) curvature(d, e) += to_curvature * x * p.at[static_cast<std::size_t>(e)];
            }
        }
    };
    static vector unit(const unknowns& plane) {
        const double length = plane.template head<D>().norm();
        return length > 0 ? vector(plane.template head<D>() / length) : vector(vector::Zero());
    }
    sums no_points(const unknowns& at) const {
        sums all{penalty_ * at.template head<D>().squaredNorm(), unknowns::Zero(), square::Zero()};
        all.descent.template head<D>() = -penalty_ * at.template head<D>();
        all.curvature.template topLeftCorner<D, D>().diagonal().setConstant(penalty_);
        // Far from all points the offset would have no curvature at all.
        all.curvature(D, D) = std::numeric_limits<double>::min();
        return all;
    }
    /// Of linear regression, with L(s) by its slope at 0. Where that divides the clouds, n is made about as long as it
    /// will be, when the nearest points pull as the penalty does: Newton's steps would lengthen it by little each.
    unknowns beginning(const points& all) const {
        sums of = no_points(unknowns::Zero());
        bool any[2] = {false, false};
        for (const member& p : all) {
            of.add(p, p.side, 1);
            any[p.side > 0] = true;
        }
        if (!any[0] || !any[1]) return unknowns::Zero();
        unknowns at = 2 * of.curvature.ldlt().solve(of.descent);
        if (!at.allFinite()) return unknowns::Zero();
        unknowns along = unknowns::Zero();
        along.template head<D>() = unit(at);
        constexpr double far = std::numeric_limits<double>::infinity();
        double first = -far, second = far;
        for (const member& p : all) {
            const double s = p.along(along);
            if (p.side < 0)
                first = std::max(first, s);
            else
                second = std::min(second, s);
        }
        const double apart = second - first;
        if (!(apart > least_apart)) return at;
        double length = 1 / apart;
        for (int k = 0; k < 3; ++k) length = std::max(1., std::log(8 * apart / (penalty_ * length))) / apart;
        at = length * along;
        at[D] = -length * (first + second) / 2;
        return at;
    }
    static constexpr double least_apart = 0.05;

    /// The error, half its descent, and half its second derivatives, those of bending away left out.
    sums sums_at(const unknowns& at, const points& all) const {
        sums of = no_points(at);
        for (const member& p : all) {
            const double s = p.along(at), right = p.side * s;
            if (right > 40) continue;  // on its side, and far: nothing that a double would notice
            const double tail = std::exp(-std::abs(s)), sum = 1 + tail;
            const double value = (s < 0 ? tail - 1 : 1 - tail) / sum, slope = 2 * tail / (sum * sum);
            const double off = 2 * p.side * (right > 0 ? tail : 1) / sum;  // c - L, without losing the tail's digits
            const double bend = -slope * value;                            // L''
            of.error += off * off;
            of.add(p, off * slope, slope * slope - std::min(0., off * bend));
        }
        return of;
    }
};

}  // namespace tamis::detail
