#pragma once
#include <tamis/core/lane_functions.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/elastic_constants.hpp>
#include <tamis/material/principal.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace tamis::detail {

/// A strain in its principal axes: what changes the shape, and its trace, which changes the volume.
template <class T> struct strain_parts {
    std::array<T, 3> dev;
    T trace;
    /// |dev e|^2.
    TAMIS_INLINE T square() const { return dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]; }
};
template <class T> TAMIS_INLINE strain_parts<T> parts_of(const std::array<T, 3>& strain) {
    const T trace = strain[0] + strain[1] + strain[2], third = trace * constant<T>(1. / 3);
    return {{strain[0] - third, strain[1] - third, strain[2] - third}, trace};
}
/// Principal values of Hencky's strain, 1/2 ln b, from those of b.
template <class T> TAMIS_INLINE std::array<T, 3> hencky_strain(const std::array<T, 3>& squares) {
    std::array<T, 3> strain;
    for (std::size_t a = 0; a < 3; ++a) strain[a] = constant<T>(0.5) * logarithm(squares[a]);
    return strain;
}
/// ... and back.
template <class T> TAMIS_INLINE std::array<T, 3> squares_of(const strain_parts<T>& e) {
    std::array<T, 3> squares;
    for (std::size_t a = 0; a < 3; ++a)
        squares[a] = exponential(T(constant<T>(2) * (e.dev[a] + e.trace * constant<T>(1. / 3))));
    return squares;
}
/// Hencky's strain, with its axes, of a step that only strains: of f b f^T with f = 1 + dt L, b the elastic left
/// Cauchy-Green tensor. Not a number where f turns the material inside out.
template <class Tensor> TAMIS_INLINE auto hencky_trial(const Tensor& b, const Tensor& L, const auto& dt) {
    using T = typename Tensor::Scalar;
    const T one = constant<T>(1), none = constant<T>(std::numeric_limits<double>::quiet_NaN());
    const Tensor f = isotropic<Tensor>(one) + dt * L;
    const T safe = select(determinant(f) > constant<T>(0), one, none);
    auto trial = principal(Tensor(safe * Tensor(f * b * f.transpose())));
    trial.values = hencky_strain(trial.values);
    return trial;
}

/// Isotropic elasticity in Hencky's strain: the Kirchhoff stress is tau = 2 mu dev e + kappa tr e 1 (Pa).
struct hencky_elastic {
    double mu, kappa;
    hencky_elastic(double young, double poisson)
        : mu(lame_mu(young, poisson)), kappa(young / (3 * (1 - 2 * poisson))) {}

    template <class T> TAMIS_INLINE std::array<T, 3> stress(const strain_parts<T>& e) const {
        std::array<T, 3> tau;
        for (std::size_t a = 0; a < 3; ++a) tau[a] = constant<T>(2 * mu) * e.dev[a] + constant<T>(kappa) * e.trace;
        return tau;
    }
    /// The stress of an elastic left Cauchy-Green tensor.
    template <class Tensor> auto stress_of(const Tensor& b) const {
        const auto form = principal(b);
        return form.with(stress(parts_of(hencky_strain(form.values))));
    }
    /// Its stored energy per reference volume (J/m^Dim).
    template <class Tensor> auto energy_of(const Tensor& b) const {
        const auto e = parts_of(hencky_strain(principal(b).values));
        using T = std::remove_cvref_t<decltype(e.trace)>;
        return T(constant<T>(mu) * e.square() + constant<T>(kappa / 2) * e.trace * e.trace);
    }
};

}  // namespace tamis::detail
