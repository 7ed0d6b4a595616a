#include <tamis/run/solver.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/update/affine.hpp>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

TEST_CASE("affine: particles take the slope of a linear velocity field, and spread it again") {
    // D = h^2/4 for quadratic splines, less where a wall folds them, down to the wall, where a hundredth is its least.
    const matrix<2, double> L = (matrix<2, double>() << 0.3, -0.2, 0.5, 0.1).finished();
    const auto field_of = [&](const auto& at) { return point<2, double>(L * at); };
    const prescribed all{everywhere, [&](const auto& at, auto) { return field_of(at); }};
    const auto check = [&](auto shape) {
        solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, shape, apic{}, held{}, all};
        auto block = mpm.make_body(linear_elastic{.young = 1e-9, .density = 1}, everywhere, per_cell{3});
        for (auto p : block) p[v] = field_of(p[x]);
        mpm.step(bodies(block), 0.01);
        for (const auto p : std::as_const(block)) {
            CAPTURE(p[x][0], p[x][1]);
            CHECK((p[v] - field_of(p[x])).norm() < 1e-14);
            CHECK((p[C] - L).norm() < 1e-12);
        }
    };
    check(quadratic_spline{});
    check(cubic_spline{});
    check(linear{});
}
