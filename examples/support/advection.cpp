#include "advection.hpp"
#include "galerkin_run.hpp"

#include <numbers>

long galerkin_options::step_count() const {
    if (steps > 0) return steps;
    // A Courant number that divides the time must not get a step more by round-off.
    return std::max(1L, static_cast<long>(std::ceil(time * cells / courant * (1 - 1e-12))));
}

double advected(const std::string& profile, double x, double t) {
    const double y = x - t - std::floor(x - t);
    if (profile == "sine") return std::sin(2 * std::numbers::pi * y);
    const double off = std::abs(y - 0.5) - 0.25;
    return std::abs(off) < 1e-12 ? 0.5 : off < 0 ? 1 : 0;
}

advection_result run_advection(const advection_options& o) {
    using namespace tamis;
    return galerkin::with_scheme(o, [&](const auto& shape, const auto& mass) {
        uniform_grid<1> grid{{0.}, {1.}, 1. / o.cells};
        if (o.ends == "periodic") grid = grid.wrapped(0);
        const conservation::advection<> law{{1.}};
        const conservation::ends open{conservation::inflow{[&](double t) { return advected(o.profile, 0, t); }},
                                      conservation::outflow{}};
        taylor_galerkin scheme{grid, law, per_cell{o.per_cell}, shape, mass, open};
        const auto exact = [&](double x, double t) {
            return conservation::state<1, double>(advected(o.profile, x, t));
        };
        advection_result result;
        galerkin::drive(
            scheme, o, exact, {"u"}, 1, [](double) {}, result);
        return result;
    });
}
