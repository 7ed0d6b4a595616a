#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/power.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/johnson_cook_failure.hpp>
#include <tamis/material/neo_hookean.hpp>
#include <tamis/material/unimodular.hpp>

#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

namespace tamis {
namespace field {

/// Temperature of a particle (K, or degrees Celsius, as the law's constants are).
struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
    static constexpr std::string_view unit = "K";
};

}  // namespace field

/// Metals at high rates of strain and any strain (Johnson & Cook 1983, Proc. 7th Int. Symp. Ballistics, 541-547):
/// elastic as `j2`, with its fields and its radial return, but that von Mises' equivalent stress, of Kirchhoff's, is
/// bounded by
///
///     Y = (yield + hardening eps^exponent) (1 + rate_factor ln max(rate/reference_rate, 1)) (1 - T*^softening)
///     T* = (T - reference_temperature)/(melting_temperature - reference_temperature), within 0 and 1
///
/// eps is the plastic strain, rate its growth in this step over dt; slower than the reference it makes no difference.
/// Both are those of the step's end: the equation of the plastic increment is solved in each step, T* is that of its
/// start. Plastic work heats the particle, density heat_capacity dT = taylor_quinney Y d eps, without conduction. What
/// has molten bears no shear, nor does what has failed (`johnson_cook_failure`). Axes beyond the dimension are held:
/// plane strain in 2D, uniaxial strain in 1D. Where J is not positive, or the equation finds no solution, the stress is
/// NaN, which stops a run by `integrate`. Pa, kg/m^Dim, K.
template <class Failure> struct johnson_cook_of {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    /// Yield stress A and hardening B (Pa), exponent n of the plastic strain.
    double yield, hardening = 0, exponent = 1;
    /// Factor C of the rate's logarithm, the rate from which on it counts (1/s).
    double rate_factor = 0, reference_rate = 1;
    /// Exponent m of T*.
    double softening = 1;
    /// Temperature of the start, from which on metals soften (K).
    double reference_temperature = 0;
    /// Temperature at which they melt (K).
    double melting_temperature = std::numeric_limits<double>::infinity();
    /// Heat capacity per mass (J/(kg K)); nothing warms if it is infinite.
    double heat_capacity = std::numeric_limits<double>::infinity();
    /// Share of plastic work that is heat.
    double taylor_quinney = 0.9;
    /// `no_failure` or `johnson_cook_failure`.
    [[no_unique_address]] Failure failure{};

    using on_particles =
        merge<fields<field::elastic_cauchy_green, field::volume_ratio, field::plastic_strain, field::temperature>,
              typename Failure::on_particles>;
    static constexpr bool three_by_three = true;
    static constexpr std::string_view name = "johnson_cook";

    void check() const {
        detail::check_elastic(name, young, poisson, density);
        positive(yield, "the yield stress");
        if (!(hardening >= 0 && std::isfinite(hardening)))
            throw error(detail::sentence(name, ": the hardening is ", hardening, "; give 0 or a positive number"));
        positive(exponent, "the exponent of hardening");
        if (!(rate_factor >= 0 && std::isfinite(rate_factor)))
            throw error(detail::sentence(name, ": the rate's factor is ", rate_factor,
                                         "; give 0 or a positive number: what is weaker at a higher rate has no one "
                                         "stress in a step"));
        positive(reference_rate, "the reference rate");
        positive(softening, "the exponent of softening");
        if (!std::isfinite(reference_temperature))
            throw error(detail::sentence(name, ": the reference temperature is ", reference_temperature,
                                         "; give a finite one"));
        if (!(melting_temperature > reference_temperature))
            throw error(detail::sentence(name, ": the melting temperature is ", melting_temperature,
                                         "; give one above the reference temperature, ", reference_temperature));
        if (!(heat_capacity > 0))
            throw error(detail::sentence(name, ": the heat capacity is ", heat_capacity, "; give a positive number"));
        if (!(taylor_quinney >= 0 && taylor_quinney <= 1))
            throw error(
                detail::sentence(name, ": Taylor and Quinney's share is ", taylor_quinney, "; give one from 0 to 1"));
        failure.check(name);
    }
    /// Nothing is deformed at first, at the reference temperature.
    void start(auto p) const {
        using real = std::remove_cvref_t<decltype(p[J])>;
        p[be] = detail::isotropic<matrix<3, real>>(real(1));
        p[J] = real(1);
        p[temperature] = constant<real>(reference_temperature);
    }
    /// A particle that is turned inside out, or is not finite, is refused.
    void check(auto p) const {
        detail::check_unimodular(detail::to_double(p[J]), detail::to_double(p[be].trace()));
        const double eps = detail::to_double(p[alpha]), warm = detail::to_double(p[temperature]);
        if (!(eps >= 0 && std::isfinite(eps)))
            throw error(detail::sentence("its plastic strain is ", eps, "; give it 0 or a positive and finite one"));
        if (!std::isfinite(warm)) throw error(detail::sentence("its temperature is ", warm, "; give it a finite one"));
    }
    /// Speed of longitudinal waves where nothing is deformed (m/s); sideways the material is held, in 1D too.
    double wave_speed(int) const { return detail::elastic_wave_speed(3, young, poisson, density); }

    /// Kirchhoff stress of a particle (Pa), out of the plane too: 3 x 3.
    auto full_stress(auto&& p) const {
        using T = std::remove_cvref_t<decltype(p[J])>;
        using full = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;
        const full b = p[be];
        return full(constant<T>(mu()) * (b - detail::isotropic<full>(b.trace() / constant<T>(3))) +
                    detail::isotropic<full>(mean_stress(T(p[J]), failed(p))));
    }
    /// Stored elastic energy of a particle per reference volume (J/m^Dim); of its state alone.
    auto energy(auto&& p, const auto&) const {
        using T = std::remove_cvref_t<decltype(p[J])>;
        const T one = constant<T>(1), ratio = p[J], shear = constant<T>(0.5) * (p[be].trace() - constant<T>(3));
        const T closed = select(failed(p) && ratio > one, one, ratio);
        return T(constant<T>(mu()) * shear + constant<T>(kappa()) * volumetric::quadratic::energy(closed));
    }

    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        static_assert(Tensor::RowsAtCompileTime == 3,
                      "tamis: johnson_cook computes with 3x3 tensors; a law that calls it says `static constexpr bool "
                      "three_by_three = true;`");
        using std::sqrt;
        using T = typename Tensor::Scalar;
        const T zero = constant<T>(0), one = constant<T>(1), third = constant<T>(1. / 3);
        const Tensor f = detail::isotropic<Tensor>(one) + dt * L;
        const T det_f = detail::determinant(f);
        p[J] *= det_f;

        const Tensor trial = detail::power(det_f, -2. / 3) * Tensor(f * p[be] * f.transpose());
        const T I_trial = trial.trace() * third;
        const Tensor dev_trial = trial - detail::isotropic<Tensor>(I_trial);
        const T mises = constant<T>(std::sqrt(1.5) * mu()) * sqrt(T(dev_trial.cwiseProduct(dev_trial).sum()));
        const T stiffness = constant<T>(3 * mu()) * I_trial;

        const T warmth = warmth_of(T(p[temperature]));
        const T strength = select(failed(p), zero, one - detail::power(warmth, softening));
        const T least_rate = constant<T>(reference_rate) * T(dt);
        const T flow = plastic_increment<T>(mises, stiffness, T(p[alpha]), strength, least_rate);
        const T left_mises = mises - stiffness * flow;
        p[alpha] += flow;
        p[temperature] += constant<T>(taylor_quinney / (density * heat_capacity)) * left_mises * flow;
        auto bears_shear = strength > zero;
        if constexpr (Failure::fails) {
            const T ratio = flow / least_rate, log_rate = detail::logarithm(select(ratio > one, ratio, one));
            const T triaxiality = mean_stress(T(p[J]), failed(p)) / select(bears_shear, left_mises, one);
            const T damage = p[spoilt] + flow / failure.at(triaxiality, log_rate, warmth);
            // What bears nothing flows without stress, and is not damaged by that.
            p[spoilt] = select(bears_shear, select(damage < one, damage, one), p[spoilt]);
            bears_shear = bears_shear && !failed(p);
        }
        const T left = select(bears_shear, left_mises / select(mises > zero, mises, one), zero * flow);
        const Tensor dev = left * dev_trial;
        p[be] = dev + detail::isotropic<Tensor>(select(flow > zero, detail::third_of_trace<6>(dev, I_trial), I_trial));
        return full_stress(p);
    }

  private:
    static constexpr field::elastic_cauchy_green be{};
    static constexpr field::volume_ratio J{};
    static constexpr field::plastic_strain alpha{};
    static constexpr field::temperature temperature{};
    static constexpr field::damage spoilt{};

    double mu() const { return detail::lame_mu(young, poisson); }
    double kappa() const { return young / (3 * (1 - 2 * poisson)); }
    /// T*.
    template <class T> T warmth_of(const T& temperature_now) const {
        const T zero = constant<T>(0), one = constant<T>(1);
        const T above = (temperature_now - constant<T>(reference_temperature)) *
                        constant<T>(1 / (melting_temperature - reference_temperature));
        return select(above < zero, zero, select(above > one, one, above));
    }
    /// Where has a particle failed?
    template <class P> static TAMIS_INLINE auto failed(P& p) {
        using T = std::remove_cvref_t<decltype(p[J])>;
        if constexpr (Failure::fails)
            return p[spoilt] >= constant<T>(1);
        else
            return constant<T>(0) > constant<T>(0);
    }
    template <class T, class Mask> T mean_stress(const T& ratio, const Mask& has_failed) const {
        const T zero = constant<T>(0);
        const T safe = select(ratio > zero, ratio, constant<T>(std::numeric_limits<double>::quiet_NaN()));
        const T mean = constant<T>(kappa()) * volumetric::quadratic::stress(safe);
        return select(has_failed && mean > zero, zero, mean);
    }

    /// The plastic strain x that a step adds, of mises - stiffness x = Y(eps + x, x/least), 0 where that much is borne.
    /// The left side falls and the right side rises, so that there is one root, below that of Y(eps, 0). Newton's
    /// method within bounds, which each round narrows; they are halved where it would leave them, or go more than half
    /// as far as the last time, for Y has no finite slope at 0. It ends where x moves by rounding of `mises`; a lane
    /// that is there stays as it is. Three rounds are usual, and 48 were the most for 1e5 random states; what has not
    /// ended after 128 is no number.
    template <class T> TAMIS_NOINLINE T plastic_increment(const T& mises, const T& stiffness, const T& eps,
                                                          const T& strength, const T& least) const {
        using real = typename lane<T>::real;
        using std::abs;
        using limits = std::conditional_t<std::numeric_limits<real>::is_specialized, std::numeric_limits<real>,
                                          std::numeric_limits<double>>;
        const T zero = constant<T>(0), one = constant<T>(1), half = constant<T>(0.5), C = constant<T>(rate_factor);
        const T slope_of_power = constant<T>(hardening * exponent);
        const T at_rest = strength * (constant<T>(yield) + constant<T>(hardening) * detail::power(eps, exponent));
        const auto yields = mises > at_rest;
        const T near = constant<T>(16 * static_cast<double>(limits::epsilon())) * mises / stiffness;
        T low = zero, high = (mises - at_rest) / stiffness;
        T x = select(yields, high, zero * at_rest), last = high;
        auto moves = yields;
        for (int round = 0; round < 128 && lane<T>::any(moves); ++round) {
            const T power = detail::power(T(eps + x), exponent), ratio = x / least;
            const auto counts = ratio > one;
            const T hardened = constant<T>(yield) + constant<T>(hardening) * power;
            const T faster = one + C * detail::logarithm(select(counts, ratio, one));
            const T slope = slope_of_power * power / (eps + x) * faster + select(counts, hardened * C / x, zero);
            const T over = mises - stiffness * x - strength * hardened * faster;
            const T step = over / (stiffness + strength * slope);
            low = select(over > zero, x, low);
            high = select(over > zero, high, x);
            const T newton = x + step;
            const auto good = newton >= low && newton <= high && abs(step) <= half * last;
            const T next = select(good, newton, low + half * (high - low));
            last = select(moves, abs(T(next - x)), last);
            x = select(moves, next, x);
            moves = moves && !(last <= near);
        }
        return select(moves, constant<T>(std::numeric_limits<double>::quiet_NaN()), x);
    }
    static void positive(double value, std::string_view what) {
        if (!(value > 0 && std::isfinite(value)))
            throw error(detail::sentence(name, ": ", what, " is ", value, "; give a positive number"));
    }
};
/// The usual one, which does not fail.
using johnson_cook = johnson_cook_of<no_failure>;

}  // namespace tamis
