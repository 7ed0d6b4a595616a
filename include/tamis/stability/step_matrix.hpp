#pragma once
#include <tamis/core/error.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <type_traits>

namespace tamis::stability {

/// Matrix of a linear step as a polynomial of the time step. Every stress order's is of degree 3 at most: stresses take
/// dt times velocities, velocities dt times stresses, and averaging orders strain twice.
template <class Matrix> class step_matrix {
  public:
    /// How many samples it takes.
    static constexpr int samples = 4;
    /// The time steps at which it is to be sampled.
    static constexpr double sample(int k) { return 0.25 * (k + 1); }

    /// From the matrices at the samples.
    explicit step_matrix(const std::array<Matrix, samples>& at) {
        for (std::size_t power = 0; power < samples; ++power) {
            coefficients_[power] = at[0] * 0;
            for (std::size_t k = 0; k < samples; ++k) coefficients_[power] += at[k] * lagrange(k, power);
        }
    }
    /// The matrix of a time step.
    Matrix operator()(double dt) const {
        return coefficients_[0] + dt * (coefficients_[1] + dt * (coefficients_[2] + dt * coefficients_[3]));
    }

  private:
    std::array<Matrix, samples> coefficients_;

    /// Coefficient of a power in the polynomial that is 1 at sample k and 0 at the others.
    static double lagrange(std::size_t k, std::size_t power) {
        std::array<double, samples> c{1, 0, 0, 0};
        double scale = 1;
        for (std::size_t j = 0; j < samples; ++j) {
            if (j == k) continue;
            const double root = sample(static_cast<int>(j));
            scale *= sample(static_cast<int>(k)) - root;
            for (std::size_t p = samples - 1; p > 0; --p) c[p] = c[p - 1] - root * c[p];
            c[0] *= -root;
        }
        return c[power] / scale;
    }
};

namespace detail {

// A template, so that eigenvalues are compiled only where they are asked for.
template <class Scalar> double largest_magnitude(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>& step) {
    using matrix_type = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
    const std::conditional_t<Eigen::NumTraits<Scalar>::IsComplex, Eigen::ComplexEigenSolver<matrix_type>,
                             Eigen::EigenSolver<matrix_type>>
        modes(step, false);
    return modes.info() == Eigen::Success ? modes.eigenvalues().cwiseAbs().maxCoeff() : NAN;
}

}  // namespace detail

/// Largest magnitude of the eigenvalues of step(courant). Throws `error` if they are not found.
template <class Step> double spectral_radius_of(const Step& step, double courant) {
    // The QR iteration does not always converge where eigenvalues of 1 fall together: nearby it does.
    for (int attempt = 0; attempt < 8; ++attempt) {
        const auto matrix = step(courant * (1 + 1e-7 * attempt));
        const double radius = detail::largest_magnitude<typename std::remove_const_t<decltype(matrix)>::Scalar>(matrix);
        if (std::isfinite(radius)) return radius;
    }
    throw error(tamis::detail::sentence("stability: the eigenvalues of a step at the Courant number ", courant,
                                        " were not found; try another number of cells"));
}

/// The number up to which is_stable(number) is true: the first at which it is not is looked for in steps of `stride`,
/// then by bisection to 1e-4; `most` if there is none up to it.
template <class IsStable> double first_unstable(double most, double stride, const IsStable& is_stable) {
    double stable = 0;
    while (stable < most) {
        const double next = std::min(stable + stride, most);
        if (!is_stable(next)) {
            double unstable = next;
            while (unstable - stable > 1e-4) {
                const double middle = (stable + unstable) / 2;
                (is_stable(middle) ? stable : unstable) = middle;
            }
            return stable;
        }
        stable = next;
    }
    return most;
}

}  // namespace tamis::stability
