#include "bi_material.hpp"

namespace {

template <class Shape, class Scheme> two_bars_result with_motion(const bi_material_options& o, const Scheme& scheme) {
    if (o.particles == "held") return run_two_bars(o, Shape{}, scheme, tamis::usl_minus{}, tamis::held{});
    return run_two_bars(o, Shape{}, scheme, tamis::usl_minus{}, tamis::moving{});
}
template <class Shape> two_bars_result with_update(const bi_material_options& o) {
    if (o.update == "flip") return with_motion<Shape>(o, tamis::flip{});
    return with_motion<Shape>(o, tamis::fmpm<tamis::dynamic>{o.order});
}

}  // namespace

bi_material_result run_bi_material(const bi_material_options& o) {
    if (o.shape == "linear") return with_update<tamis::linear>(o);
    return with_update<tamis::quadratic_spline>(o);
}
