#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/fields.hpp>
#include <tamis/core/lanes.hpp>

#include <cmath>
#include <string_view>

namespace tamis {
namespace field {

/// Damage of a particle: 0 where there is none, 1 where it has failed.
struct damage : scalar_field {
    static constexpr std::string_view name = "damage";
    static constexpr std::string_view unit = "1";
};

}  // namespace field

/// A metal of `johnson_cook_of` never fails; no damage is stored.
struct no_failure {
    using on_particles = fields<>;
    /// Does it fail at all?
    static constexpr bool fails = false;
    /// There is nothing to refuse.
    void check(std::string_view) const {}
};

/// A metal of `johnson_cook_of` fails at the plastic strain of Johnson and Cook (1985, Eng. Fract. Mech. 21, 31-48)
///
///     eps_f = (d1 + d2 e^(d3 sigma*)) (1 + d4 ln max(rate/reference_rate, 1)) (1 + d5 T*)
///
/// sigma* being the mean stress, tension positive, over von Mises' equivalent one. Damage grows by d eps/eps_f; from 1
/// on the particle bears pressure only, and no tension: where it has come apart it closes before it bears again. eps_f
/// counts as 1e-6 where it is less. A table of another sign of d3 takes pressure as positive.
struct johnson_cook_failure {
    /// The constants D1 to D5, without unit.
    double d1, d2 = 0, d3 = 0, d4 = 0, d5 = 0;
    using on_particles = fields<field::damage>;
    /// Does it fail at all?
    static constexpr bool fails = true;

    /// Throws `error` where the constants make no sense, in the name of the law.
    void check(std::string_view law) const {
        if (!(d1 >= 0 && d2 >= 0 && d1 + d2 > 0 && std::isfinite(d1 + d2)))
            throw error(detail::sentence(law, ": the failure strain has d1 = ", d1, " and d2 = ", d2,
                                         "; give 0 or positive numbers, one of them positive"));
        if (!std::isfinite(d3 + d4 + d5))
            throw error(detail::sentence(law, ": the failure strain has d3 = ", d3, ", d4 = ", d4, " and d5 = ", d5,
                                         "; give finite numbers"));
    }
    /// eps_f at sigma*, the logarithm of the rate and T*.
    template <class T> T at(const T& triaxiality, const T& log_rate, const T& warmth) const {
        const T one = constant<T>(1), least = constant<T>(1e-6), most = constant<T>(60);
        T power = constant<T>(d3) * triaxiality;
        power = select(power > most, most, select(power < -most, T(-most), power));
        const T strain = (constant<T>(d1) + constant<T>(d2) * detail::exponential(power)) *
                         (one + constant<T>(d4) * log_rate) * (one + constant<T>(d5) * warmth);
        return select(strain > least, strain, least);
    }
};

}  // namespace tamis
