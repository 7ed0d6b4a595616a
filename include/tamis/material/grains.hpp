#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/material/hencky.hpp>

#include <cmath>
#include <string_view>

namespace tamis {
namespace field {

/// Logarithm of the volume by which a particle of grains has come apart without stress; it closes before the particle
/// bears pressure again.
struct opening : scalar_field {
    static constexpr std::string_view name = "opening";
    static constexpr std::string_view unit = "1";
};

}  // namespace field
namespace detail {

/// Throws `error` where the constants of a law of soils and grains make no sense.
template <class Law> void check_grains(const Law& law) {
    check_elastic(Law::name, law.young, law.poisson, law.density);
    const auto refuse = [](const auto&... words) { throw error(sentence(Law::name, ": ", words...)); };
    if (!(law.friction >= 0 && law.friction < 90))
        refuse("the angle of friction is ", law.friction, " degrees; give one from 0 to less than 90");
    if (!(law.cohesion >= 0 && std::isfinite(law.cohesion)))
        refuse("the cohesion is ", law.cohesion, "; give 0 or a positive number");
    if (!(law.friction > 0 || law.cohesion > 0))
        refuse("friction and cohesion are both 0, which bears no shear; give one of them, or take a fluid's law");
    if (!(law.dilatancy >= 0 && law.dilatancy <= law.friction))
        refuse("the angle of dilatancy is ", law.dilatancy, " degrees; give one from 0 to the angle of friction, ",
               law.friction);
    if (!(law.tension >= 0)) refuse("the largest tension is ", law.tension, "; give 0 or a positive number");
}
/// Throws `error` where a particle's elastic strain is none, told by the trace of its Cauchy-Green tensor.
inline void check_elastic_cauchy_green(double trace) {
    if (!(trace > 0 && std::isfinite(trace)))
        throw error(sentence("its elastic Cauchy-Green tensor has the trace ", trace,
                             "; give it a positive tensor (the identity where nothing is deformed), and see that "
                             "steps are short enough to turn no particle inside out"));
}

}  // namespace detail
}  // namespace tamis
