#include "shock_tube.hpp"

#include "catch.hpp"
#include "unit/complaint.hpp"

namespace {

/// Relative differences of the plateau behind the shock from the exact one.
riemann::state plateau_off(const tube& set, const tube_result& r) {
    const riemann::solution exact(set.gamma, set.left, set.right);
    return {std::abs(r.behind_shock.density / exact.density_right() - 1),
            std::abs(r.behind_shock.velocity / exact.velocity() - 1),
            std::abs(r.behind_shock.pressure / exact.pressure() - 1)};
}

}  // namespace

TEST_CASE("shock tube: Sod's errors fall with about the first order, plateaus and fronts are right") {
    struct scheme {
        std::string shape, update, stress;
        int order;
        double density_at_200, least_order, energy;
    };
    for (const scheme& s : {scheme{"quadratic", "flip", "usavg-", 2, 6.31e-3, 0.75, 1e-3},
                            scheme{"quadratic", "flip", "usl-", 2, 6.46e-3, 0.5, 3e-3},
                            scheme{"quadratic", "xpic", "usavg+", 2, 5.51e-3, 0.8, 3e-3},
                            scheme{"cubic", "fmpm", "usavg-", 2, 5.20e-3, 0.9, 3e-3}}) {
        double before = 0;
        for (const int cells : {100, 200, 400, 800}) {
            shock_tube_options o;
            o.shape = s.shape;
            o.update = s.update;
            o.stress = s.stress;
            o.order = s.order;
            o.set.cells = cells;
            const shock_tube_result r = run_shock_tube(o);
            CAPTURE(s.shape, s.update, s.stress, cells, r.density_l1, r.velocity_l1, r.pressure_l1, before);
            CHECK(std::abs(r.contact_off) < 1.5);
            CHECK(std::abs(r.shock_off) < 1.5);
            if (cells == 200) CHECK(std::abs(r.density_l1 / s.density_at_200 - 1) < 0.02);
            if (cells >= 200) {
                const riemann::state off = plateau_off(o.set, r);
                CHECK(off.density < 0.01);
                CHECK(off.velocity < 0.01);
                CHECK(off.pressure < 0.01);
            }
            CHECK(std::abs(r.energy_end / r.energy_start - 1) < s.energy);
            // Nothing but the ends' pressures acts on the gas.
            CHECK(std::abs(r.momentum - 0.9 * o.set.time) < 1e-6);
            if (cells == 800) CHECK(std::log2(before / r.density_l1) > s.least_order);
            before = r.density_l1;
        }
    }
}

TEST_CASE("shock tube: strong ones stay positive, and their fronts are where they must be") {
    for (const double ratio : {1e3, 1e5}) {
        CAPTURE(ratio);
        shock_tube_options o;
        o.pressure_ratio(ratio);
        const shock_tube_result r = run_shock_tube(o);
        for (const tube_particle& p : r.particles) {
            CHECK(p.density > 0);
            CHECK(p.pressure > 0);
        }
        CHECK(std::abs(r.contact_off) < 1);
        CHECK(std::abs(r.shock_off) < 1.5);
        const riemann::state off = plateau_off(o.set, r);
        CHECK(off.density < 0.02);
        CHECK(off.velocity < 0.01);
        CHECK(off.pressure < 0.02);
        CHECK(std::abs(r.energy_end / r.energy_start - 1) < 3e-3);
    }
}

TEST_CASE("shock tube: without artificial viscosity the plateau rings") {
    shock_tube_options o;
    const double with = run_shock_tube(o).velocity_l1;
    o.set.linear = o.set.quadratic = 0;
    CHECK(run_shock_tube(o).velocity_l1 > 1.5 * with);
}

TEST_CASE("shock tube: one that cannot run stops with a sentence that names a particle and why") {
    shock_tube_options o;
    o.pressure_ratio(1e5);
    // A viscosity too strong for so long a step.
    o.set.linear = 10;
    o.set.courant = 1;
    CHECK(names(complaint([&] { run_shock_tube(o); }), "particle ", "step ", "stability limit"));
    o.set = {};
    o.shape = "gimp";
    CHECK(names(complaint([&] { run_shock_tube(o); }), "shape", "'gimp'", "cubic"));
}
