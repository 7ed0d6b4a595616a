#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/grains.hpp>

#include <cmath>
#include <string_view>
#include <type_traits>

namespace tamis {

/// Grains that lie, flow and fly, at any strain: friction that grows with the rate of flow, the mu(I) of Jop, Forterre
/// and Pouliquen (2006), on an elastic body that bears no stress where it is less dense than a packing (Dunatunga &
/// Kamrin 2015, *Continuum modelling and simulation of granular flows through their many phases*). With e = 1/2 ln b,
/// b the elastic left Cauchy-Green tensor, and J the packing's density over the present one, the Kirchhoff stress is
///
///     tau = 2 G dev e + kappa tr e 1,    tr e = min(ln J, 0),    P = -tr tau/3
///     |dev tau|/sqrt(2) <= mu_s P where it lies, and = mu(I) P where it flows
///     mu(I) = mu_s + (mu_2 - mu_s)/(I0/I + 1),    I = rate d sqrt(rho_s/p),    p = P/J
///
/// with the plastic shear rate, sqrt(2) |D_p|, which goes along dev tau and keeps the volume. A step ends with mu(I) of
/// its own rate (implicit). The elastic part is that of `drucker_prager`, where the paper takes Hooke's law by rates:
/// no turning and no cycle makes energy here, and the pressure is a function of the density alone, so that none is left
/// over when grains part and meet. Where mu_2 = mu_s it is `drucker_prager` without cohesion and dilatancy, whose angle
/// has 2 sqrt(3) sin(friction)/(3 - sin(friction)) = mu_s. Axes beyond the dimension are held: plane strain in 2D,
/// uniaxial strain in 1D. A particle that is turned inside out gets a stress that is no number, which stops the run.
/// Pa, m and kg/m^Dim.
struct granular_flow {
    /// Young's modulus (Pa), Poisson's ratio, density of the packing (kg/m^Dim): below it there is no stress.
    double young, poisson = 0, density;
    /// Coefficient of friction where nothing flows, mu_s, and that which the fastest flow comes near to, mu_2.
    double static_friction, limit_friction;
    /// Inertial number at which friction has risen by half of that, I0.
    double inertial_number;
    /// Diameter (m) and density (kg/m^3) of a grain, d and rho_s.
    double grain_diameter, grain_density;
    using on_particles = fields<field::elastic_cauchy_green, field::opening, field::plastic_strain>;
    static constexpr bool three_by_three = true;
    static constexpr std::string_view name = "granular_flow";

    void check() const {
        detail::check_elastic(name, young, poisson, density);
        if (!(static_friction >= 0 && std::isfinite(static_friction)))
            throw error(
                detail::sentence(name, ": the static friction is ", static_friction, "; give 0 or a positive number"));
        if (!(limit_friction > 0 && limit_friction >= static_friction && std::isfinite(limit_friction)))
            throw error(detail::sentence(name, ": the limit of friction is ", limit_friction,
                                         "; give a positive number, not below the static friction, ", static_friction));
        if (!(inertial_number > 0 && std::isfinite(inertial_number)))
            throw error(
                detail::sentence(name, ": the inertial number is ", inertial_number, "; give a positive number"));
        if (!(grain_diameter > 0 && std::isfinite(grain_diameter)))
            throw error(
                detail::sentence(name, ": the grain's diameter is ", grain_diameter, "; give a positive number"));
        if (!(grain_density >= density && std::isfinite(grain_density)))
            throw error(detail::sentence(name, ": the grain's density is ", grain_density,
                                         "; give one not below that of the packing, ", density));
    }
    /// Nothing is deformed at first: as dense as the packing.
    void start(auto p) const {
        using real = std::remove_cvref_t<decltype(p[open])>;
        p[be] = detail::isotropic<matrix<3, real>>(real(1));
    }
    /// A particle whose elastic strain is none is refused.
    void check(auto p) const { detail::check_elastic_cauchy_green(detail::to_double(p[be].trace())); }
    /// Speed of longitudinal waves where nothing is deformed (m/s); sideways the material is held, in 1D too.
    double wave_speed(int) const { return detail::elastic_wave_speed(3, young, poisson, density); }

    /// Kirchhoff stress of a particle (Pa), out of the plane too: 3 x 3.
    auto full_stress(auto&& p) const { return elastic().stress_of(p[be]); }
    /// Stored elastic energy of a particle per reference volume (J/m^Dim); of its state alone.
    auto energy(auto&& p, const auto&) const { return elastic().energy_of(p[be]); }

    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        static_assert(Tensor::RowsAtCompileTime == 3,
                      "tamis: granular_flow computes with 3x3 tensors; a law that calls it says `static constexpr "
                      "bool three_by_three = true;`");
        using std::sqrt;
        using T = typename Tensor::Scalar;
        const T zero = constant<T>(0), one = constant<T>(1);
        const auto trial = detail::hencky_trial(Tensor(p[be]), L, T(dt));
        auto e = detail::parts_of(trial.values);
        const T shear = sqrt(e.square());

        // The logarithm of J; what has come apart closes before it bears pressure. Flow keeps the volume, so this is
        // the pressure after it too.
        const T stretch = e.trace + p[open];
        const auto apart = stretch > zero;
        p[open] = select(apart, stretch, zero);
        e.trace = select(apart, zero, stretch);
        const T P = constant<T>(-elastic().kappa) * e.trace;
        const T left = shear_left(shear, P, T(P * detail::exponential(T(zero - e.trace))), T(dt));
        const T slid = select(left < shear, shear - left, zero);
        p[alpha] += constant<T>(std::sqrt(2. / 3)) * slid;

        const T scale = left / select(shear > zero, shear, one);
        for (T& one_of : e.dev) one_of = scale * one_of;
        p[be] = trial.with(detail::squares_of(e));
        return trial.with(elastic().stress(e));
    }

  private:
    static constexpr field::elastic_cauchy_green be{};
    static constexpr field::opening open{};
    static constexpr field::plastic_strain alpha{};

    detail::hencky_elastic elastic() const { return {young, poisson}; }
    /// |dev e| after a step's flow, from that before it, the pressures P and p, and the step's length. In this measure
    /// friction bears s = mu_s P/(sqrt(2) G), the fastest flow D = (mu_2 - mu_s) P/(sqrt(2) G) more, and
    /// a = I0 dt sqrt(p/rho_s)/(sqrt(2) d) flows where I = I0. Of the excess o over s, y is left where the flow, o - y,
    /// is that at which mu(I) bears y:
    ///
    ///     o - y = a y/(D - y)    or    y^2 - (o + D + a) y + o D = 0,    0 <= y <= min(o, D)
    ///
    /// (the paper's equation for the shear stress, moved by s). The smaller root is it, by the quotient in which
    /// nothing cancels: the discriminant is (o - D)^2 + a (a + 2 (o + D)).
    template <class T> TAMIS_INLINE T shear_left(const T& shear, const T& P, const T& p, const T& dt) const {
        using std::sqrt;
        const T two = constant<T>(2);
        const double strain_of_stress = 1 / (std::sqrt(2.) * elastic().mu);
        const T s = constant<T>(static_friction * strain_of_stress) * P;
        const T D = constant<T>((limit_friction - static_friction) * strain_of_stress) * P;
        const T a = constant<T>(inertial_number / (grain_diameter * std::sqrt(2 * grain_density))) * dt * sqrt(p);
        const auto flows = shear > s;
        const T o = select(flows, shear - s, constant<T>(1));
        const T root = sqrt(T((o - D) * (o - D) + a * (a + two * (o + D))));
        const T y = two * o * D / (o + D + a + root);
        return select(flows, s + y, shear);
    }
};

}  // namespace tamis
