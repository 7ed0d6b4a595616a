#include "bi_material.hpp"

#include "require.hpp"
#include "summary.hpp"
#include "two_bars_run.hpp"

namespace {

template <class Shape, class Order = tamis::usl_minus, class Scheme>
two_bars_result with_motion(const bi_material_options& o, const Scheme& scheme) {
    if (o.particles == "held") return run_two_bars(o.set, Shape{}, scheme, Order{}, tamis::held{});
    return run_two_bars(o.set, Shape{}, scheme, Order{}, tamis::moving{});
}
template <class Shape> two_bars_result with_update(const bi_material_options& o) {
    if constexpr (std::same_as<Shape, tamis::linear>)
        if (o.stress == "euler") return with_motion<Shape, tamis::euler>(o, tamis::flip{});
    if (o.update == "flip") return with_motion<Shape>(o, tamis::flip{});
    return with_motion<Shape>(o, tamis::fmpm<tamis::dynamic>{o.order});
}

}  // namespace

bi_material_result run_bi_material(const bi_material_options& o) {
    require_name("shape", o.shape, {"linear", "quadratic"});
    require_name("update", o.update, {"flip", "fmpm"});
    if (o.shape == "linear" && o.update == "flip")
        require_name("stress", o.stress, {"usl-", "euler"});
    else
        require_name("stress (but for linear functions with flip)", o.stress, {"usl-"});
    require_name("particles", o.particles, {"moving", "held"});
    if (!(o.set.speed() > 0.2 && o.set.speed() < 1.6))
        throw unusable_option("the right bar's wave speed is " + std::to_string(o.set.speed()) +
                              " times the left one's, and its pulse would be cut by the end or by the cells; give "
                              "ratios of modulus and density whose quotient is from 0.04 to 2.5");
    return o.shape == "linear" ? with_update<tamis::linear>(o) : with_update<tamis::quadratic_spline>(o);
}

std::string summary_of(const bi_material_options& o, const bi_material_result& r) {
    const two_bars& set = o.set;
    auto all = composition_of("bi_material", set.cells, set.per_cell, o);
    all["particles"] = o.particles;
    all["modulus_ratio"] = set.young;
    all["density_ratio"] = set.density;
    put_cost(all, r.particle_count, r.steps, r.wall_seconds);
    all["courant"] = set.courant;
    all["reflected"] = r.reflected;
    all["reflected_by_theory"] = set.reflected();
    all["transmitted"] = r.transmitted;
    all["transmitted_by_theory"] = set.transmitted();
    all["unexplained_left"] = r.rest_left;
    all["unexplained_right"] = r.rest_right;
    all["energy_gain"] = r.energy_gain;
    return all.dump(2) + "\n";
}
