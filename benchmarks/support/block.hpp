#pragma once
#include <tamis/tamis.hpp>

#include <cmath>
#include <memory>
#include <tuple>

/// A block of n^Dim cells with 2^Dim particles each, free in a box with room to spare, as in the step by hand.
template <class Solver, class Body> struct stepped {
    std::unique_ptr<Solver> mpm;
    std::unique_ptr<Body> body;
    typename Solver::real dt;
    void step() { mpm->step(tamis::bodies(*body), dt); }
    std::size_t particles() const { return body->size(); }
};

template <int Dim, class Real, class Law, class... Policies>
auto block_of(const Law& law, int n, Policies... policies) {
    using namespace tamis;
    using namespace tamis::symbols;
    const Real h = Real(1) / Real(n);
    Real lower[Dim], upper[Dim];
    for (int d = 0; d < Dim; ++d) {
        lower[d] = 0;
        upper[d] = h * Real(n + 16);
    }
    using solver_type = solver<uniform_grid<Dim, Real>, Policies...>;
    auto mpm = std::make_unique<solver_type>(uniform_grid<Dim, Real>{lower, upper, h}, policies...);
    // Cells centred on nodes begin half a cell earlier: the block fills whole cells of the bookkeeping.
    const Real first = h * Real(8 - std::decay_t<decltype(mpm->functions())>::shift);
    const auto inside = [&](const auto& at) {
        bool in = true;
        for (int d = 0; d < Dim; ++d) in = in && at[d] > first && at[d] < first + h * Real(n);
        return in;
    };
    using body_type = decltype(mpm->make_body(law, inside, per_cell{2}));
    auto body = std::make_unique<body_type>(mpm->make_body(law, inside, per_cell{2}));
    for (auto p : *body)
        for (int d = 0; d < Dim; ++d) p[v][d] = Real(0.01 * std::sin(3 * double(p[x][d])));
    // However long the timing runs, the block stays where it is, and far from what any composition finds unstable.
    const Real dt = Real(1e-7) * h / Real(law.wave_speed(Dim));
    return stepped<solver_type, body_type>{std::move(mpm), std::move(body), dt};
}

/// The step is that of USL-, in two sweeps, where no other order is named.
template <int Dim, class Real, class Law = tamis::linear_elastic, class... Policies>
auto elastic_block(int n, Policies... policies) {
    const Law law{.young = 1e6, .poisson = Dim == 1 ? 0.0 : 0.3, .density = 1000};
    if constexpr ((tamis::StressOrder<Policies> || ...))
        return block_of<Dim, Real>(law, n, policies...);
    else
        return block_of<Dim, Real>(law, n, policies..., tamis::usl_minus{});
}

template <class Problem> struct hand_stepped {
    std::unique_ptr<Problem> problem;
    void step() { problem->step(); }
    std::size_t particles() const { return problem->particles(); }
};

/// Registers all shapes and updates of a dimension; `by_hand` is what the quadratic FLIP step is compared with.
template <int Dim, class Run>
void add_steps(Run& run, int n, const std::string& dimension, const std::string& by_hand) {
    using namespace tamis;
    const auto shape = [&](const auto& functions, const std::string& shape_name) {
        const auto update = [&](const auto& scheme, const std::string& name, const std::string& compared) {
            run.add(dimension + "/" + shape_name + "/" + name, compared,
                    [=] { return elastic_block<Dim, double>(n, functions, scheme); });
        };
        const std::string reference = dimension + "/" + shape_name + "/flip";
        update(flip{}, "flip", shape_name == "quadratic" ? by_hand : "");
        update(pic{}, "pic", reference);
        update(xpic<2>{}, "xpic(2)", reference);
        update(fmpm<2>{}, "fmpm(2)", reference);
        update(fmpm<4>{}, "fmpm(4)", reference);
    };
    shape(linear{}, "linear");
    shape(quadratic_spline{}, "quadratic");
    shape(cubic_spline{}, "cubic");
}
