// The Taylor-Galerkin scheme for conservation laws.
#include "bits.hpp"
#include "optional.hpp"

using namespace bits;

namespace {

struct burgers {
    static constexpr int unknowns = 1;
    template <class State> State flux(const State& u, int) const {
        State f;
        f[0] = constant<typename State::Scalar>(0.5) * u[0] * u[0];
        return f;
    }
    double wave_speed(const auto& u) const { return std::abs(u[0]); }
};

template <class Scheme> void solve(account& out, Scheme& scheme, int count, double dt) {
    noise random(4);
    scheme.set([&](const auto& at) {
        auto u = (scheme.on_node({0, 0, 0}) * 0).eval();
        for (int c = 0; c < Scheme::count; ++c) u[c] = 1 + 0.3 * std::sin(5 * at.sum() + c) + 0.1 * random();
        return u;
    });
    for (int k = 0; k < count; ++k) scheme.step(dt);
    const auto& grid = scheme.grid();
    const int rows = Scheme::dim > 1 ? grid.cells(1) : 0;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= grid.cells(0); ++i) {
            const std::array<int, 3> node{i, j, 0};
            put(out, "node.", "unknowns", node, scheme.on_node(node));
            put(out, "node.", "mass", node, scheme.mass_of_node(node));
        }
    long k = 0;
    scheme.each_particle([&](const auto&, const auto& u) { put(out, "particle.", "unknowns", k++, u); });
    put(out, "", "total", 0L, scheme.total());
    put(out, "", "gain", 0L, scheme.gain());
    out.tell("wave_speed", scheme.wave_speed());
    out.tell("time", scheme.time());
    out.remark = std::to_string(scheme.size()) + " particles, " + std::to_string(scheme.steps()) + " steps";
}

const composition all[] = {
    {"1d_taylor_galerkin_linear_full_mass3_burgers",
     [](account& out) {
         const conservation::ends open{conservation::inflow{[](double t) { return 1 + 0.2 * std::sin(t); }},
                                       conservation::outflow{}};
         taylor_galerkin scheme{box<1>(), burgers{}, per_cell{2}, linear{}, full_mass<3>{}, open};
         solve(out, scheme, 15, 0.021);
     }},
    {"1d_taylor_galerkin_quadratic_lumped_elastic_bar_periodic",
     [](account& out) {
         taylor_galerkin scheme{box<1>().wrapped(0), conservation::elastic_bar{3.7, 0.23}, per_cell{2},
                                quadratic_spline{}};
         solve(out, scheme, 15, 0.011);
     }},
    {"2d_taylor_galerkin_cubic_full_mass_dynamic_advection_threads",
     [](account& out) {
         taylor_galerkin scheme{box<2>().wrapped(0).wrapped(1),
                                conservation::advection<2>{{0.7, 1.1}},
                                per_cell{2},
                                cubic_spline{},
                                full_mass<dynamic>{3},
                                conservation::ends<>{},
                                two_threads()};
         solve(out, scheme, 12, 0.021);
     }},
};

}  // namespace
