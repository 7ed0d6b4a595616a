#pragma once
#include <Eigen/Dense>

#include <cmath>

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
