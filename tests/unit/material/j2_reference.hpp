#pragma once
#include <Eigen/Dense>

#include <cmath>
#include <vector>

/// J2 plasticity of one particle in plain numbers, line by line as in Simo & Hughes, *Computational Inelasticity*, Box
/// 9.1, but that the trace in its last line is made such that det b = 1.
struct j2_reference {
    using tensor = Eigen::Matrix3d;
    double mu, kappa, yield, K;
    tensor b = tensor::Identity(), tau = tensor::Zero();
    double J = 1, alpha = 0;
    double dissipated = 0;  // by the last step, per reference volume: what the elastic trial stored and b does not

    static tensor dev(const tensor& a) { return a - a.trace() / 3 * tensor::Identity(); }
    static double root(const tensor& d) {
        double low = std::sqrt(d.squaredNorm() / 6), high = low + 2;
        while (true) {
            const double middle = (low + high) / 2;
            if (middle == low || middle == high) return middle;
            ((d + middle * tensor::Identity()).determinant() < 1 ? low : high) = middle;
        }
    }
    /// Deformed by f, the gradient from the last place to the next.
    void step(const tensor& f) {
        J *= f.determinant();
        const tensor f_bar = f / std::cbrt(f.determinant());
        const tensor trial = f_bar * b * f_bar.transpose();
        tensor s = mu * dev(trial);
        const double phi = s.norm() - std::sqrt(2. / 3) * (yield + K * alpha);
        b = trial;
        if (phi > 0) {
            const double mu_bar = mu * trial.trace() / 3;
            const double dgamma = phi / (2 * mu_bar) / (1 + K / (3 * mu_bar));
            const tensor n = s / s.norm();
            s -= 2 * mu_bar * dgamma * n;
            alpha += std::sqrt(2. / 3) * dgamma;
            b = s / mu + root(s / mu) * tensor::Identity();
        }
        const double dU = kappa / 2 * (J - 1 / J);
        tau = J * dU * tensor::Identity() + s;
        dissipated = mu / 2 * (trial.trace() - b.trace());
    }
};

/// Motions in steps: each f is the gradient from the last place to the next.
namespace motion_of {

using tensor = Eigen::Matrix3d;
using steps = std::vector<tensor>;

inline tensor along(int d, int e, double size) {
    tensor f = tensor::Identity();
    f(d, e) += size;
    return f;
}
inline steps uniaxial(double size, int count) { return steps(static_cast<std::size_t>(count), along(0, 0, size)); }
inline steps shear(double size, int count) { return steps(static_cast<std::size_t>(count), along(0, 1, size)); }
/// Stretched, back beyond the start, and stretched again, sheared a little all the while.
inline steps there_and_back(double size, int count) {
    steps all;
    for (const double sign : {1., -2., 1.5})
        for (int n = 0; n < std::abs(sign) * count; ++n) {
            tensor f = along(0, 0, sign < 0 ? -size : size);
            f(1, 0) = size / 3;
            f(1, 1) -= size / 4;
            all.push_back(f);
        }
    return all;
}
/// All components at once, in 3D.
inline steps twisted(double size, int count) {
    steps all;
    for (int n = 0; n < count; ++n) {
        tensor f = tensor::Identity();
        for (int c = 0; c < 9; ++c) f.data()[c] += size * std::sin(1 + 2.3 * c + 0.2 * n);
        all.push_back(f);
    }
    return all;
}
/// A turn about an axis that is none of the grid's.
inline tensor turn(double angle) {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}
/// The same motion watched by someone who turns by `angle` in a step.
inline steps turned(steps all, double angle) {
    double now = 0;
    for (auto& f : all) {
        f = turn(now + angle) * f * turn(now).transpose();
        now += angle;
    }
    return all;
}

}  // namespace motion_of
