#pragma once
#include <tamis/core/error.hpp>

#include <cmath>
#include <string_view>

namespace tamis::detail {

inline void check_elastic(std::string_view law, double young, double poisson, double density) {
    if (!(young > 0 && std::isfinite(young)))
        throw error(sentence(law, ": Young's modulus is ", young, "; give a positive number"));
    if (!(poisson > -1 && poisson < 0.5))
        throw error(sentence(law, ": Poisson's ratio is ", poisson, "; give one above -1 and below 0.5"));
    if (!(density > 0 && std::isfinite(density)))
        throw error(sentence(law, ": the density is ", density, "; give a positive number"));
}

/// Lame's constants, in the unit of Young's modulus.
inline double lame_lambda(double young, double poisson) {
    return young * poisson / ((1 + poisson) * (1 - 2 * poisson));
}
inline double lame_mu(double young, double poisson) { return young / (2 * (1 + poisson)); }

/// Speed of longitudinal waves (m/s): in 1D of a bar, in 2D and 3D where the material is held sideways.
inline double elastic_wave_speed(int dim, double young, double poisson, double density) {
    return std::sqrt((dim == 1 ? young : young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))) / density);
}

}  // namespace tamis::detail
