#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/elastic_constants.hpp>

#include <limits>

namespace tamis {

/// Energies U(J) of a change of volume, per unit of their modulus: `energy(J)` = U, `stress(J)` = J dU/dJ, which is its
/// Kirchhoff stress. `isochoric`: the shear energy is that of J^(-1/3) F, which leaves the pressure to U alone.
namespace volumetric {

/// U = (ln J)^2/2 (Bonet & Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, compressible
/// neo-Hookean material).
struct logarithmic {
    /// Is the shear energy that of J^(-1/3) F?
    static constexpr bool isochoric = false;
    /// J dU/dJ.
    template <class T> static TAMIS_INLINE T stress(const T& J) { return detail::logarithm(J); }
    /// U(J).
    template <class T> static TAMIS_INLINE T energy(const T& J) {
        const T log_J = detail::logarithm(J);
        return constant<T>(0.5) * log_J * log_J;
    }
};
/// U = ((J^2 - 1)/2 - ln J)/2 (Simo & Hughes, *Computational Inelasticity*, section 9.2).
struct quadratic {
    /// Is the shear energy that of J^(-1/3) F?
    static constexpr bool isochoric = false;
    /// J dU/dJ.
    template <class T> static TAMIS_INLINE T stress(const T& J) { return constant<T>(0.5) * (J * J - constant<T>(1)); }
    /// U(J).
    template <class T> static TAMIS_INLINE T energy(const T& J) {
        return constant<T>(0.5) * (stress(J) - detail::logarithm(J));
    }
};
/// `quadratic` with shear and volume apart (Simo & Hughes, section 9.2).
struct split : quadratic {
    /// Is the shear energy that of J^(-1/3) F?
    static constexpr bool isochoric = true;
};

}  // namespace volumetric

/// Neo-Hookean solid, isotropic and elastic at any strain: from the deformation gradient F, with B = F F^T, J = det F
/// and U of `Volumetric`, the Kirchhoff stress is
///
///     tau = mu (B - 1) + lambda J U'(J) 1                  logarithmic, quadratic
///     tau = mu dev(J^(-2/3) B) + kappa J U'(J) 1           split; dev and trace over three axes
///
/// lambda and mu are Lame's constants and kappa = E/(3 (1 - 2 nu)), so that all are Hooke's law where strains are
/// small. Axes beyond the dimension are held, F = 1 there: plane strain in 2D and uniaxial strain in 1D, where the
/// modulus at small strain is `young` for Poisson's ratio 0, and E (1 - nu)/((1 + nu)(1 - 2 nu)) for another
/// (`linear_elastic` in 1D is a bar instead, free sideways). Where J is not positive the stress is NaN, which stops a
/// run by `integrate`. Pa and kg/m^Dim.
template <class Volumetric> struct neo_hookean_of {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    using on_particles = fields<const field::deformation>;
    static constexpr std::string_view name = "neo_hookean";

    void check() const { detail::check_elastic(name, young, poisson, density); }
    /// A particle whose F turns it inside out, or is not finite, is refused.
    void check(auto p) const {
        const double J = detail::to_double(detail::determinant(p[symbols::F]));
        if (!(J > 0 && std::isfinite(J)))
            throw error(detail::sentence("its deformation gradient has the determinant ", J,
                                         "; give it a positive and finite one (the identity where nothing is "
                                         "deformed), and see that steps are short enough to keep it so"));
    }
    /// Speed of longitudinal waves where nothing is deformed (m/s); sideways the material is held, in 1D too.
    double wave_speed(int) const { return detail::elastic_wave_speed(3, young, poisson, density); }

    /// Kirchhoff stress (Pa) at a deformation gradient.
    template <class Tensor> TAMIS_INLINE Tensor at_deformation(const Tensor& F) const {
        using T = typename Tensor::Scalar;
        const T mu = constant<T>(detail::lame_mu(young, poisson)), J = positive(detail::determinant(F));
        const Tensor B = F * F.transpose();
        const T pressure = constant<T>(modulus()) * Volumetric::stress(J);
        if constexpr (Volumetric::isochoric) {
            const T shear = mu * inverse_area(J), mean = trace(B) * constant<T>(1. / 3);
            return shear * (B - mean * Tensor::Identity()) + pressure * Tensor::Identity();
        } else
            return mu * (B - Tensor::Identity()) + pressure * Tensor::Identity();
    }
    /// Stored energy per reference volume (J/m^Dim) at a deformation gradient.
    template <class Tensor> auto energy_at(const Tensor& F) const {
        using T = typename Tensor::Scalar;
        const T mu = constant<T>(detail::lame_mu(young, poisson)), J = positive(detail::determinant(F));
        const Tensor B = F * F.transpose();
        const T half = constant<T>(0.5), three = constant<T>(3);
        const T shear = Volumetric::isochoric ? T(half * (inverse_area(J) * trace(B) - three))
                                              : T(half * (trace(B) - three) - detail::logarithm(J));
        return T(mu * shear + constant<T>(modulus()) * Volumetric::energy(J));
    }

    template <class Tensor> Tensor stress(auto p, const Tensor&, auto) const {
        return at_deformation(Tensor(p[symbols::F]));
    }
    /// Stored energy of a particle per reference volume (J/m^Dim); of its deformation alone.
    auto energy(auto&& p, const auto&) const { return energy_at(p[symbols::F].eval()); }

  private:
    double modulus() const {
        return detail::lame_lambda(young, poisson) +
               (Volumetric::isochoric ? detail::lame_mu(young, poisson) * 2 / 3 : 0);
    }
    template <class T> static TAMIS_INLINE T positive(const T& J) {
        return select(J > constant<T>(0), J, constant<T>(std::numeric_limits<double>::quiet_NaN()));
    }
    /// J^(-2/3)
    template <class T> static TAMIS_INLINE T inverse_area(const T& J) {
        return detail::exponential(T(constant<T>(-2. / 3) * detail::logarithm(J)));
    }
    template <class Tensor> static TAMIS_INLINE auto trace(const Tensor& B) {
        using T = typename Tensor::Scalar;
        return T(B.trace() + constant<T>(3 - static_cast<int>(Tensor::RowsAtCompileTime)));
    }
};
/// The usual one: tau = mu (B - 1) + lambda ln J 1.
using neo_hookean = neo_hookean_of<volumetric::logarithmic>;

}  // namespace tamis
