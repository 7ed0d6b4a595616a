// Loads of all kinds: what they do to the momentum of the bodies, and that threads do not matter.
#include <algorithm>

#include "laws/sameness.hpp"

using namespace laws;
using namespace tamis::symbols;

namespace {

/// A force on some particles, and a traction, normal and shear, on the sides across x.
template <int D> auto pull() {
    return particle_force{
        [](const place<D>& at) { return at.sum() > 0.3 * D; },
        [](const place<D>& at, double t) { return place<D>((place<D>::Constant(0.01 + t) - 0.02 * at).eval()); }};
}
template <int D> place<D> push_at(const place<D>& at, const place<D>& normal, double t) {
    place<D> value = normal * (0.3 + std::sin(20 * t) + at[0]);
    value[D - 1] += 0.2 + at[D - 1];
    return value;
}
template <int D> auto push() {
    return traction{[](const place<D>&, const place<D>& normal) { return normal[0] != 0; }, push_at<D>};
}
template <int D> place<D> down() {
    place<D> g;
    for (int d = 0; d < D; ++d) g[d] = 3 - 4 * d;
    return g;
}
constexpr double rate = 1.5, drag = 0.7;

/// The impulse of all loads in the next step is the change of momentum.
template <int D, class... Policy> void impulse(const Policy&... policy) {
    (UNSCOPED_INFO(Policy::name), ...);
    solver mpm{box<D>(10, 6), policy...,
               loads{gravity<place<D>>{down<D>()}, pull<D>(), push<D>(), grid_damping{rate}, particle_damping{drag}}};
    auto block = stirred_block<D>(mpm);
    const double dt = 0.01;
    for (int step = 0; step < 20; ++step) {
        CAPTURE(step);
        const double t = mpm.time();
        const place<D> before = total_momentum(block);
        place<D> force = total_mass(block) * down<D>() - (rate + drag) * before;
        double scale = force.norm();
        for (const auto p : std::as_const(block)) {
            const place<D> at = p[x];
            const place<D> pulled = p[field::chosen<1>{}] * (place<D>::Constant(0.01 + t) - 0.02 * at);
            force += pulled;
            const double half = std::pow(p[V], 1. / D) / 2;
            for (int k = 0; k < 2 * D; ++k) {
                const double area = p[field::faces<2>{}][k * p.W];
                if (area == 0) continue;
                place<D> normal = place<D>::Zero();
                normal[k / 2] = k % 2 == 0 ? -1 : 1;
                const place<D> pushed = area * push_at<D>(at + half * normal, normal, t);
                force += pushed;
                scale += pushed.norm();
            }
        }
        mpm.step(bodies(block), dt);
        const place<D> after = total_momentum(block);
        REQUIRE((after - before - dt * force).norm() < 3e-14 * (after.norm() + dt * scale));
        REQUIRE(scale > 1e-3);
    }
}

template <int D> void impulses() {
    impulse<D>(quadratic_spline{}, flip{}, usl_minus{}, moving{});
    impulse<D>(linear{}, fmpm<2>{}, usl_minus{}, moving{});
    impulse<D>(quadratic_spline{}, xpic<2>{}, usf{}, moving{});
    impulse<D>(quadratic_spline{}, flip{}, usf{}, held{});
    impulse<D>(cubic_spline{}, fmpm<2>{}, usf{}, held{});
    impulse<D>(linear{}, xpic<2>{}, usl_minus{}, held{});
}

#if defined(_OPENMP)
template <int D, class... Policy> auto run_with(const Policy&... policy) {
    constexpr int along = D == 2 ? 40 : 30;
    const auto grid = box<D>(along, D == 2 ? 60 : 12);
    solver mpm{grid, policy...,
               loads{push<D>(), gravity<place<D>>{down<D>()}, pull<D>(), kinetic_feedback{0.01, 5, 20}}};
    auto block = block_in(mpm, [&](const place<D>& at) {
        return (at - grid.lower()).minCoeff() > 0.5 && (grid.upper() - at).minCoeff() > 0.5;
    });
    stir(block, 0.5, 0.3);
    for (int step = 0; step < 10; ++step) mpm.step(bodies(block), 0.005);
    CHECK(block.store().slabs() > 3);
    const double alpha = std::get<3>(mpm.load().all).alpha();
    CHECK(alpha > 0.01);
    return std::pair(snapshot(std::as_const(block)), alpha);
}
template <int D, class... Policy> void same_for_any_number(const Policy&... policy) {
    const auto alone = run_with<D>(policy..., serial{});
    for (const int count : {1, 2, 3}) {
        CAPTURE(D, count);
        const bool same = run_with<D>(policy..., threads{count}) == alone;
        CHECK(same);
    }
}
#endif

}  // namespace

TEST_CASE("loads: the change of momentum is their impulse, in 1D") { impulses<1>(); }
TEST_CASE("loads: the change of momentum is their impulse, in 2D") { impulses<2>(); }
TEST_CASE("loads: the change of momentum is their impulse, in 3D") {
    impulse<3>(quadratic_spline{}, flip{}, usl_minus{}, moving{});
    impulse<3>(linear{}, fmpm<2>{}, usf{}, held{});
}
#if defined(_OPENMP)
TEST_CASE("loads: the same, bit for bit, for any number of threads") {
    same_for_any_number<2>(quadratic_spline{}, flip{}, usl_minus{});
    same_for_any_number<3>(linear{}, fmpm<2>{}, usf{});
}
#endif
