#include "bar.hpp"

#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/motion/motion.hpp>

#include "compositions/left_out.hpp"
#include "require.hpp"

#include <tuple>
#include <type_traits>

namespace {

template <class Shape, class Motion, class Real> struct composed_of;
template <class Wanted, class List> constexpr bool is_in = false;
template <class Wanted, class... All>
constexpr bool is_in<Wanted, std::tuple<All...>> = (std::is_same_v<Wanted, All> || ...);

template <class Shape, class Motion, class Real> constexpr bool built =
    !is_in<composed_of<Shape, Motion, Real>, std::tuple<TAMIS_SCENES_LEFT_OUT>>;

/// f(shape, motion, number) of the types that the options name.
template <class F> auto with_composition(const bar_options& o, F f) {
    const auto with_precision = [&](auto shape, auto motion) {
        return o.precision == "float" ? f(shape, motion, 0.f) : f(shape, motion, 0.);
    };
    const auto with_motion = [&](auto shape) {
        return o.particles == "held" ? with_precision(shape, tamis::held{}) : with_precision(shape, tamis::moving{});
    };
    if (o.shape == "linear") return with_motion(tamis::linear{});
    if (o.shape == "quadratic") return with_motion(tamis::quadratic_spline{});
    return with_motion(tamis::cubic_spline{});
}

}  // namespace

bool is_built(const bar_options& o) {
    return with_composition(
        o, []<class Shape, class Motion, class Real>(Shape, Motion, Real) { return built<Shape, Motion, Real>; });
}

bar_result run_bar(const bar_scene& scene, const bar_options& o) {
    return with_composition(o, [&]<class Shape, class Motion, class Real>(Shape, Motion, Real) -> bar_result {
        if constexpr (built<Shape, Motion, Real>)
            return run_bar_with<Shape, Motion, Real>(scene, o);
        else
            throw unusable_option("this build leaves out shape " + o.shape + " with particles " + o.particles +
                                  " and precision " + o.precision +
                                  "; configure with -DTAMIS_QUICK=OFF -DTAMIS_SCENES_FLOAT=ON");
    });
}

bar_errors errors_of(const bar_scene& scene, const bar_options& o, const bar_result& result) {
    const auto exact = scene.exact(o.amplitude);
    const double strain_scale = o.amplitude / bar_scene::wave_speed * scene.scale,
                 velocity_scale = o.amplitude * scene.scale;
    bar_errors e{0, 0, 0, 0};
    for (const auto& p : result.particles) {
        const auto right = exact.at(p.x, o.time);
        const double dv = std::abs(p.velocity - right.velocity) / velocity_scale;
        const double de = std::abs(p.strain - right.strain) / strain_scale;
        e.velocity_l2 += dv * dv;
        e.strain_l2 += de * de;
        // Written so that a NaN is kept.
        if (!(dv <= e.velocity_max)) e.velocity_max = dv;
        if (!(de <= e.strain_max)) e.strain_max = de;
    }
    const auto n = static_cast<double>(result.particles.size());
    e.velocity_l2 = std::sqrt(e.velocity_l2 / n);
    e.strain_l2 = std::sqrt(e.strain_l2 / n);
    return e;
}
