#include "bar.hpp"

#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/solver/motion.hpp>

namespace {

template <class Shape, class Motion> bar_result with_precision(const bar_scene& scene, const bar_options& o) {
    return o.precision == "float" ? run_bar_with<Shape, Motion, float>(scene, o)
                                  : run_bar_with<Shape, Motion, double>(scene, o);
}
template <class Shape> bar_result with_motion(const bar_scene& scene, const bar_options& o) {
    return o.particles == "held" ? with_precision<Shape, tamis::held>(scene, o)
                                 : with_precision<Shape, tamis::moving>(scene, o);
}

}  // namespace

bar_result run_bar(const bar_scene& scene, const bar_options& o) {
    if (o.shape == "linear") return with_motion<tamis::linear>(scene, o);
    if (o.shape == "quadratic") return with_motion<tamis::quadratic_spline>(scene, o);
    return with_motion<tamis::cubic_spline>(scene, o);
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
