#pragma once
#include <tamis/core/power.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/neo_hookean.hpp>
#include <tamis/material/unimodular.hpp>

#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

namespace tamis {

/// Plasticity at any strain by the second invariant J2 (von Mises), with linear isotropic hardening (Simo & Hughes,
/// *Computational Inelasticity*, Box 9.1): from the elastic left Cauchy-Green tensor b without its change of volume, J
/// and the accumulated plastic strain alpha, all three stored, the Kirchhoff stress is
///
///     tau = mu dev b + kappa/2 (J^2 - 1) 1,    |mu dev b| <= sqrt(2/3) (yield + hardening alpha)
///
/// Where it does not yield it is `neo_hookean_of<volumetric::split>`. The book's last step keeps tr b of the elastic
/// trial, so that tr b would take up the plastic work too; here tr b is what makes det b = 1, and `energy` is what can
/// be had back. Axes beyond the dimension are held: plane strain in 2D, uniaxial strain in 1D. Where J is not positive
/// the stress is NaN, which stops a run by `integrate`. Pa and kg/m^Dim.
struct j2 {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim), yield stress and hardening modulus (Pa).
    double young, poisson = 0, density, yield, hardening = 0;
    using on_particles = fields<field::elastic_cauchy_green, field::volume_ratio, field::plastic_strain>;
    static constexpr bool three_by_three = true;
    static constexpr std::string_view name = "j2";

    void check() const {
        detail::check_elastic(name, young, poisson, density);
        if (!(yield > 0 && std::isfinite(yield)))
            throw error(detail::sentence(name, ": the yield stress is ", yield, "; give a positive number"));
        if (!(hardening >= 0 && std::isfinite(hardening)))
            throw error(detail::sentence(name, ": the hardening modulus is ", hardening,
                                         "; give 0 or a positive number: what softens fails in a band as wide as a "
                                         "cell, whatever the cell, for the law knows no length"));
    }
    /// Nothing is deformed at first.
    void start(auto p) const {
        using real = std::remove_cvref_t<decltype(p[J])>;
        p[be] = detail::isotropic<matrix<3, real>>(real(1));
        p[J] = real(1);
    }
    /// A particle that is turned inside out, or is not finite, is refused.
    void check(auto p) const { detail::check_unimodular(detail::to_double(p[J]), detail::to_double(p[be].trace())); }
    /// Speed of longitudinal waves where nothing is deformed (m/s); sideways the material is held, in 1D too.
    double wave_speed(int) const { return detail::elastic_wave_speed(3, young, poisson, density); }

    /// Kirchhoff stress of a particle (Pa), out of the plane too: 3 x 3.
    auto full_stress(auto&& p) const { return stress_at(p[be], p[J]); }
    /// Stored elastic energy of a particle per reference volume (J/m^Dim); of its state alone.
    auto energy(auto&& p, const auto&) const {
        using T = std::remove_cvref_t<decltype(p[J])>;
        const T shear = constant<T>(0.5) * (p[be].trace() - constant<T>(3));
        return T(constant<T>(mu()) * shear + constant<T>(kappa()) * volumetric::quadratic::energy(T(p[J])));
    }

    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        static_assert(Tensor::RowsAtCompileTime == 3,
                      "tamis: j2 computes with 3x3 tensors; a law that calls it says `static constexpr bool "
                      "three_by_three = true;`");
        using std::sqrt;
        using T = typename Tensor::Scalar;
        const T one = constant<T>(1), two_thirds_K = constant<T>(hardening * 2 / 3);
        const Tensor f = detail::isotropic<Tensor>(one) + dt * L;
        const T det_f = detail::determinant(f);
        p[J] *= det_f;

        const Tensor trial = detail::power(det_f, -2. / 3) * Tensor(f * p[be] * f.transpose());
        const T I_trial = trial.trace() / constant<T>(3), mu_bar = constant<T>(mu()) * I_trial;
        const Tensor dev_trial = trial - detail::isotropic<Tensor>(I_trial);
        const T s_trial = constant<T>(mu()) * sqrt(T(dev_trial.cwiseProduct(dev_trial).sum()));
        const T radius = constant<T>(std::sqrt(2. / 3)) * (constant<T>(yield) + constant<T>(hardening) * p[alpha]);

        const auto yields = s_trial > radius;
        const T over = select(yields, s_trial - radius, constant<T>(0));
        const T dgamma = over / (constant<T>(2) * mu_bar + two_thirds_K);
        p[alpha] += constant<T>(std::sqrt(2. / 3)) * dgamma;
        const T left = one - constant<T>(2) * mu_bar * dgamma / select(yields, s_trial, one);
        const Tensor dev = left * dev_trial;
        p[be] = dev + detail::isotropic<Tensor>(select(yields, detail::third_of_trace<4>(dev, I_trial), I_trial));
        return stress_at(Tensor(p[be]), T(p[J]));
    }

  private:
    static constexpr field::elastic_cauchy_green be{};
    static constexpr field::volume_ratio J{};
    static constexpr field::plastic_strain alpha{};

    double mu() const { return detail::lame_mu(young, poisson); }
    double kappa() const { return young / (3 * (1 - 2 * poisson)); }

    template <class Tensor, class T> TAMIS_INLINE auto stress_at(const Tensor& b, const T& ratio) const {
        using full = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;
        const T safe = select(ratio > constant<T>(0), ratio, constant<T>(std::numeric_limits<double>::quiet_NaN()));
        const T pressure = constant<T>(kappa()) * volumetric::quadratic::stress(safe);
        const T mean = b.trace() / constant<T>(3);
        return full(constant<T>(mu()) * (b - detail::isotropic<full>(mean)) + detail::isotropic<full>(pressure));
    }
};

}  // namespace tamis
