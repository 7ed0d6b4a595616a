#include "tube.hpp"

#include "catch.hpp"

namespace {

const tamis::quadratic_spline quadratic;

tube strong(double ratio) {
    tube set;
    set.left = {1, 0, ratio};
    set.right = {1, 0, 1};
    set.time = 0.3 / riemann::solution(set.gamma, set.left, set.right).right_front();
    return set;
}
/// Places of contact and shock, in cells from where they should be.
struct places {
    double contact, shock;
};
places off(const tube& set, const tube_result& r) {
    const riemann::solution exact(set.gamma, set.left, set.right);
    return {(r.contact - 0.5 - exact.velocity() * set.time) * set.cells,
            (r.shock - 0.5 - exact.right_front() * set.time) * set.cells};
}

}  // namespace

TEST_CASE("shock tube: Sod's errors fall with about the first order, plateaus and fronts are right") {
    const auto check = [](const auto& scheme, const auto& order, double plateau, double least_order) {
        double before = 0;
        for (const int cells : {100, 200, 400, 800}) {
            CAPTURE(cells, std::decay_t<decltype(scheme)>::name, std::decay_t<decltype(order)>::name);
            tube set;
            set.cells = cells;
            tube_result r = run_tube(set, quadratic, scheme, order);
            measure(set, r);
            const riemann::solution exact(set.gamma, set.left, set.right);
            CAPTURE(r.density_l1, r.velocity_l1, r.pressure_l1, before);
            const places fronts = off(set, r);
            CHECK(std::abs(fronts.contact) < 1);
            CHECK(std::abs(fronts.shock) < 1.5);
            if (cells >= 200) {
                CHECK(std::abs(r.behind_shock.pressure / exact.pressure() - 1) < plateau);
                CHECK(std::abs(r.behind_shock.velocity / exact.velocity() - 1) < plateau);
                CHECK(std::abs(r.behind_shock.density / exact.density_right() - 1) < plateau);
            }
            CHECK(std::abs(r.energy_end / r.energy_start - 1) < 3e-3);
            // Nothing but the ends' pressures acts on the gas.
            CHECK(std::abs(r.momentum - 0.9 * set.time) < 1e-6);
            if (cells == 800) CHECK(std::log2(before / r.density_l1) > least_order);
            before = r.density_l1;
        }
    };
    check(tamis::flip{}, tamis::usavg_minus{}, 0.01, 0.75);
    check(tamis::flip{}, tamis::usl_minus{}, 0.01, 0.5);
}

TEST_CASE("shock tube: strong ones stay positive, and their fronts are where they must be") {
    for (const double ratio : {1e3, 1e5}) {
        CAPTURE(ratio);
        const tube set = strong(ratio);
        tube_result r = run_tube(set, quadratic, tamis::flip{}, tamis::usavg_minus{});
        measure(set, r);
        const riemann::solution exact(set.gamma, set.left, set.right);
        for (const tube_particle& p : r.particles) {
            CHECK(p.density > 0);
            CHECK(p.pressure > 0);
        }
        const places fronts = off(set, r);
        CHECK(std::abs(fronts.contact) < 1);
        CHECK(std::abs(fronts.shock) < 1.5);
        CHECK(std::abs(r.behind_shock.pressure / exact.pressure() - 1) < 0.02);
        CHECK(std::abs(r.behind_shock.velocity / exact.velocity() - 1) < 0.01);
        CHECK(std::abs(r.behind_shock.density / exact.density_right() - 1) < 0.02);
        CHECK(std::abs(r.energy_end / r.energy_start - 1) < 3e-3);
    }
}

TEST_CASE("shock tube: without artificial viscosity the plateau rings") {
    tube set;
    const auto ripple = [&] {
        tube_result r = run_tube(set, quadratic, tamis::flip{}, tamis::usavg_minus{});
        measure(set, r);
        return r.velocity_l1;
    };
    const double with = ripple();
    set.linear = set.quadratic = 0;
    CHECK(ripple() > 1.5 * with);
}
