#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/elastic_constants.hpp>

namespace tamis {

namespace detail {

/// Stress of isotropic linear elasticity for unit Young's modulus: uniaxial stress in 1D, plane strain in 2D.
template <class Tensor> TAMIS_INLINE Tensor elastic_stress(double poisson, const Tensor& strain) {
    using T = typename Tensor::Scalar;
    if constexpr (Tensor::RowsAtCompileTime == 1)
        return strain;
    else {
        const T lambda = constant<T>(poisson / ((1 + poisson) * (1 - 2 * poisson)));
        const T two_mu = constant<T>(1 / (1 + poisson));
        return isotropic<Tensor>(lambda * strain.trace()) + two_mu * strain;
    }
}

/// Strain of isotropic linear elasticity for unit Young's modulus: the inverse of `elastic_stress`.
template <class Tensor> Tensor elastic_strain(double poisson, const Tensor& tau) {
    using T = typename Tensor::Scalar;
    if constexpr (Tensor::RowsAtCompileTime == 1)
        return tau;
    else {
        // Plane strain: the third direction's stress nu tr(tau) belongs to the trace.
        const T trace = tau.trace() * constant<T>(Tensor::RowsAtCompileTime == 2 ? 1 + poisson : 1.0);
        return constant<T>(1 + poisson) * tau - isotropic<Tensor>(constant<T>(poisson) * trace);
    }
}

}  // namespace detail

/// Isotropic linear elasticity in small strain: in 1D sigma = E epsilon, plane strain in 2D, 3D. Pa and kg/m^3.
struct linear_elastic {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    using on_particles = fields<const field::stress>;
    static constexpr std::string_view name = "linear_elastic";

    void check() const { detail::check_elastic(name, young, poisson, density); }
    double wave_speed(int dim) const { return detail::elastic_wave_speed(dim, young, poisson, density); }
    /// Stress of a particle at a given strain.
    template <class Tensor> Tensor at_strain(auto&&, const Tensor& strain) const {
        return constant<typename Tensor::Scalar>(young) * detail::elastic_stress(poisson, strain);
    }
    /// Strain of a particle at a given stress.
    template <class Tensor> Tensor strain_at(auto&&, const Tensor& tau) const {
        return detail::elastic_strain(poisson, tau) / constant<typename Tensor::Scalar>(young);
    }
    /// Elastic energy of a particle per reference volume (J/m^Dim).
    template <class Tensor> auto energy(auto&& p, const Tensor& tau) const {
        return tau.cwiseProduct(strain_at(p, tau)).sum() / 2;
    }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        const Tensor strain = (dt / 2) * Tensor(L + L.transpose());
        return p[symbols::sigma] + at_strain(p, strain);
    }
};

/// Linear elasticity whose Young's modulus varies from particle to particle: `p[E]`, at first `young`.
struct varying_elastic {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    using on_particles = fields<const field::stress, const field::modulus>;
    static constexpr std::string_view name = "varying_elastic";

    void check() const { detail::check_elastic(name, young, poisson, density); }
    void start(auto p) const { p[symbols::E] = young; }
    void check(auto p) const {
        if (!(p[symbols::E] > 0))
            throw error(detail::sentence("its modulus is ", p[symbols::E], "; give a positive number"));
    }
    double wave_speed(int dim) const { return detail::elastic_wave_speed(dim, young, poisson, density); }
    /// Wave speed at a particle of its own density.
    double wave_speed_at(auto p, int dim) const {
        using namespace symbols;
        return detail::elastic_wave_speed(dim, static_cast<double>(p[E]), poisson, static_cast<double>(p[m] / p[V]));
    }
    template <class Tensor> Tensor at_strain(auto&& p, const Tensor& strain) const {
        return p[symbols::E] * detail::elastic_stress(poisson, strain);
    }
    template <class Tensor> Tensor strain_at(auto&& p, const Tensor& tau) const {
        return detail::elastic_strain(poisson, tau) / p[symbols::E];
    }
    template <class Tensor> auto energy(auto&& p, const Tensor& tau) const {
        return tau.cwiseProduct(strain_at(p, tau)).sum() / 2;
    }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        const Tensor strain = (dt / 2) * Tensor(L + L.transpose());
        return p[symbols::sigma] + at_strain(p, strain);
    }
};

}  // namespace tamis
