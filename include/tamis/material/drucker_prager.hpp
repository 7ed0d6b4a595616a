#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/grains.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <type_traits>

namespace tamis {
/// Grains and soils at any strain: Drucker and Prager's cone in Hencky's strain (Klar et al. 2016, *Drucker-Prager
/// elastoplasticity for sand animation*), with a flow rule of its own angle, and the volume that separated grains have
/// gained kept in mind (Tampubolon et al. 2017). With e = 1/2 ln b, b the elastic left Cauchy-Green tensor, the
/// Kirchhoff stress is
///
///     tau = 2 mu dev e + kappa tr e 1,    |dev tau| <= k - A tr tau,    tr tau/3 <= tension
///     A = sqrt(2/3) 2 sin(friction)/(3 - sin(friction)),    k = sqrt(2/3) 6 cohesion cos(friction)/(3 - sin(friction))
///
/// the cone through the compressive edges of Mohr and Coulomb's pyramid. It flows along dev tau, and swells by the same
/// A of the angle of dilatancy. Beyond the cone's tip, or the tension that is given, the mean stress is that of the
/// tip: what is stretched further is open. Axes beyond the dimension are held: plane strain in 2D, uniaxial strain in
/// 1D. A particle that is turned inside out gets a stress that is no number, which stops the run. Pa and kg/m^Dim.
struct drucker_prager {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    /// Angle of friction, from 0 to less than 90 (degrees), cohesion (Pa).
    double friction, cohesion = 0;
    /// Angle of dilatancy, from 0 to that of friction (degrees).
    double dilatancy = 0;
    /// Largest mean stress (Pa); the cone's tip bounds it too.
    double tension = std::numeric_limits<double>::infinity();
    using on_particles = fields<field::elastic_cauchy_green, field::opening, field::plastic_strain>;
    static constexpr bool three_by_three = true;
    static constexpr std::string_view name = "drucker_prager";

    void check() const { detail::check_grains(*this); }
    /// Nothing is deformed at first.
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
                      "tamis: drucker_prager computes with 3x3 tensors; a law that calls it says `static constexpr "
                      "bool three_by_three = true;`");
        using std::sqrt;
        using T = typename Tensor::Scalar;
        const T zero = constant<T>(0), one = constant<T>(1);
        const auto trial = detail::hencky_trial(Tensor(p[be]), L, T(dt));
        auto e = detail::parts_of(trial.values);
        const T shear = sqrt(e.square());
        // What has come apart closes first.
        const T stretch = e.trace + p[open];
        const double A = slope_of(friction), B = slope_of(dilatancy), k = offset(), G = elastic().mu,
                     bulk = elastic().kappa;
        const T over = constant<T>(2 * G) * shear + constant<T>(3 * A * bulk) * stretch - constant<T>(k);
        const T flow = select(over > zero, over / constant<T>(2 * G + 9 * A * B * bulk), zero);
        const T slid = select(flow < shear, flow, shear);
        const T swollen = stretch - constant<T>(3 * B) * slid;
        // Beyond the tip, or the tension that is borne, the rest is opening; the cone is wider there, so the shear
        // stays.
        const T most = constant<T>(largest_stretch());
        const auto opens = swollen > most;
        e.trace = select(opens, most, swollen);
        p[open] = select(opens, swollen - most, zero);
        const T left = shear - slid;
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
    static double slope_of(double degrees) {
        const double sine = std::sin(degrees * std::numbers::pi / 180);
        return std::sqrt(2. / 3) * 2 * sine / (3 - sine);
    }
    double offset() const {
        const double angle = friction * std::numbers::pi / 180;
        return std::sqrt(2. / 3) * 6 * cohesion * std::cos(angle) / (3 - std::sin(angle));
    }
    /// tr e at the cone's tip or the largest tension; finite, that it can be computed with.
    double largest_stretch() const {
        const double A = slope_of(friction), tip = A > 0 ? offset() / (3 * A) : std::numeric_limits<double>::infinity();
        return std::min(std::min(tip, tension) / elastic().kappa, 1e3);
    }
};

}  // namespace tamis
