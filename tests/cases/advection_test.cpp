// The Taylor-Galerkin scenes against their exact answers.
#include "advection.hpp"
#include "elastic_taylor_galerkin.hpp"

#include "catch.hpp"

#include <cmath>
#include <numbers>

namespace {

/// Error of the nodes that the phase error of linear functions gives after one period of the sine: per step
/// C theta^3 (1/6 - r - C^2/6), r = 0 with the lumped mass and 3/16 with the full one at 2 particles per cell.
double expected_error(const advection_options& o) {
    const double r = o.mass == "lumped" ? 0 : 3. / 16, C = o.courant, h = 1. / o.cells;
    return std::pow(2 * std::numbers::pi, 3) * h * h * std::abs(1. / 6 - r - C * C / 6) / std::sqrt(2.);
}

}  // namespace

TEST_CASE("advection: a sine is second order, with the error that the phase has") {
    for (const char* mass : {"lumped", "fmpm"})
        for (const char* ends : {"periodic", "open"}) {
            double before = 0;
            for (const int cells : {50, 100, 200}) {
                advection_options o;
                o.cells = cells;
                o.mass = mass;
                o.ends = ends;
                const advection_result r = run_advection(o);
                const galerkin_unknown& u = r.unknowns[0];
                CAPTURE(mass, ends, cells, u.node_l2, u.l2, before);
                CHECK(std::abs(u.total_final - u.total_initial - u.gain) < 1e-14);
                if (o.ends == "periodic") {
                    CHECK(u.gain == 0);
                    CHECK(std::abs(u.node_l2 / expected_error(o) - 1) < 0.03);
                }
                if (cells > 50) CHECK(std::abs(std::log2(before / u.node_l2) - 2) < 0.1);
                before = u.node_l2;
            }
        }
}

TEST_CASE("advection: reference norms of the sine and the step") {
    struct line {
        const char *shape, *profile, *mass, *ends;
        double courant, l1, l2, overshoot;
    };
    for (const line& given : {line{"linear", "sine", "lumped", "periodic", 0.4, 2.22687e-03, 2.47333e-03, 5.19290e-05},
                              line{"linear", "sine", "fmpm", "open", 0.4, 4.44869e-04, 5.23008e-04, 1.21557e-04},
                              line{"quadratic", "sine", "fmpm", "periodic", 0.1, 3.43015e-04, 3.81008e-04, 1.23539e-04},
                              line{"cubic", "sine", "lumped", "open", 0.4, 3.97127e-03, 4.68887e-03, 1.01453e-03},
                              line{"linear", "step", "lumped", "periodic", 0.4, 8.46778e-02, 1.49365e-01, 2.28580e-01},
                              line{"linear", "step", "fmpm", "periodic", 0.4, 6.42489e-02, 1.27883e-01, 2.35229e-01},
                              line{"quadratic", "step", "fmpm", "open", 0.1, 4.00705e-02, 8.65636e-02, 1.84179e-01},
                              line{"cubic", "step", "fmpm", "periodic", 0.1, 4.23657e-02, 8.43307e-02, 1.41455e-01}}) {
        advection_options o;
        o.shape = given.shape;
        o.profile = given.profile;
        o.mass = given.mass;
        o.ends = given.ends;
        o.courant = given.courant;
        const advection_result r = run_advection(o);
        const galerkin_unknown& u = r.unknowns[0];
        CAPTURE(given.shape, given.profile, given.mass, given.ends, u.l1, u.l2, u.overshoot);
        CHECK(std::abs(u.l1 / given.l1 - 1) < 2e-3);
        CHECK(std::abs(u.l2 / given.l2 - 1) < 2e-3);
        CHECK(std::abs(u.overshoot - given.overshoot) < 2e-3 * (given.overshoot + 1e-3));
        CHECK(std::abs(u.total_final - u.total_initial - u.gain) < 1e-13);
    }
}

TEST_CASE("elastic bar in (stress, velocity): fronts of the small shock, and second order of its first mode") {
    struct line {
        const char* mass;
        double stress_l1, front, behind, ahead;
    };
    for (const line& given :
         {line{"lumped", 2.57380e-02, 0.994965, 0.231528, 0}, line{"fmpm", 1.98140e-02, 1.003582, 0, 0.241328}}) {
        elastic_taylor_galerkin_options o;
        o.mass = given.mass;
        const elastic_taylor_galerkin_result r = run_elastic_taylor_galerkin(o);
        const galerkin_unknown& stress = r.unknowns[0];
        CAPTURE(given.mass, stress.l1, r.front_speed, r.overshoot, stress.overshoot);
        CHECK(std::abs(stress.l1 / given.stress_l1 - 1) < 2e-3);
        CHECK(std::abs(r.front_speed / given.front - 1) < 1e-4);
        CHECK(std::abs(r.front_speed - 1) < 0.01);
        // Lumped: ripples behind the fronts, beyond the plateau. Full: ahead of them, beyond all that is exact.
        CHECK(std::abs(r.overshoot - given.behind) < 1e-3);
        CHECK(std::abs(stress.overshoot - given.ahead) < 1e-3);
        CHECK(r.energy_final < r.energy_initial);
        for (const galerkin_unknown& u : r.unknowns) CHECK(std::abs(u.total_final - u.total_initial - u.gain) < 1e-15);
    }
    for (const char* mass : {"lumped", "fmpm"}) {
        double before = 0;
        for (const int cells : {25, 50, 100}) {
            elastic_taylor_galerkin_options o;
            o.profile = "mode";
            o.mass = mass;
            o.cells = cells;
            o.time = 1.9;
            const elastic_taylor_galerkin_result r = run_elastic_taylor_galerkin(o);
            CAPTURE(mass, cells, before, r.unknowns[0].node_l2);
            if (cells > 25) CHECK(std::abs(std::log2(before / r.unknowns[0].node_l2) - 2) < 0.15);
            before = r.unknowns[0].node_l2;
        }
    }
}
