// Passes of a large body are run together, slab by slab. Nothing may come of it but speed: a step is, bit for bit, what
// it is by passes one after the other, for any number of threads.
#include <utility>

#include "laws/sameness.hpp"

using namespace laws;

namespace {

/// Does not say how many threads it has: passes go one after the other.
struct one_by_one {
    template <class F> void for_each(std::size_t n, const F& f) const {
        for (std::size_t k = 0; k < n; ++k) f(k);
    }
};

template <int D> uniform_grid<D, double> hall() { return D == 2 ? box<D>(140, 140) : box<D>(24, 30); }

/// More than four megabytes of particles that go from cell to cell between swaying walls, and what a run leaves behind.
template <int D, class Execution, class... Policies>
auto run(const Execution& how, bool in_waves, Policies... policies) {
    constexpr double left = 0.4, right = D == 2 ? 24 : 5.2, top = D == 2 ? 33.6 : 6.1;
    const walls<D> swaying{[=](const place<D>& at) { return at[0] < left || at[D - 1] > top; },
                           [](const place<D>& at, double t) { return place<D>((0.02 * at * std::sin(9 * t)).eval()); }};
    solver mpm{hall<D>(), swaying, how, policies...};
    auto block = block_in(mpm, [=](const place<D>& at) { return at[0] < right && (at.array() > 0.1).all(); });
    stir(block, 0.8, 0.5);
    const std::size_t bytes = block.store().slots.size() * sizeof(block.store().slots.front());
    CHECK(bytes > (4u << 20));
    const int steps = 5;
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), 1. / 64);
    CHECK(block.store().slabs() >= 8);
    CHECK(mpm.steps_in_waves() == (in_waves ? steps : 0));
    std::vector<double> nodes{mpm.boundary_work(), static_cast<double>(mpm.crossings())};
    for (const auto& node : mpm.reactions())
        for (int d = 0; d < D; ++d) nodes.push_back(node.reaction[d]);
    mpm.grid().each_node([&](const auto& index) {
        for (int d = 0; d < D; ++d) nodes.push_back(mpm.on_node(symbols::v, index)[d]);
    });
    return std::pair(snapshot(std::as_const(block)), nodes);
}
using read_velocity = read_out<field::velocity>;
template <int D, class... Policies> void agree(Policies... policies) {
    const auto expected = run<D>(one_by_one{}, false, policies...);
    const auto same = [&](const auto& how) {
        const bool is = run<D>(how, true, policies...) == expected;
        CHECK(is);
    };
#if defined(_OPENMP)
    for (const int count : {1, 2, 3, 5}) {
        CAPTURE(count);
        same(threads{count});
    }
#else
    same(serial{});
#endif
}

}  // namespace

TEST_CASE("waves: a step is that of passes one after the other, by all kinds of schemes") {
    agree<2>(quadratic_spline{}, flip{}, usl_minus{}, gravity{place<2>(0.3, -1)}, read_velocity{});
    agree<2>(linear{}, fmpm<4>{}, usl_plus{}, read_velocity{});
    agree<2>(cubic_spline{}, fmpm<3>{}, usavg_plus{}, read_velocity{});
    agree<2>(quadratic_spline{}, xpic<3>{}, usf{}, held{}, read_velocity{});
}
TEST_CASE("waves: ... where somebody looks at the nodes between two passes") {
    agree<2>(linear{}, adaptive_fmpm{1e-3, 4}, usl_minus{}, read_velocity{});
    agree<2>(quadratic_spline{}, fmpm<2>{}, boundary_method::velocity{}, kinetic_feedback{0.2, 1, 10}, read_velocity{});
    agree<2>(linear{}, fmpm<2>{}, boundary_method::collected{}, read_velocity{});
    agree<2>(quadratic_spline{}, fmpm<2>{}, boundary_method::partial{}, read_velocity{});
    agree<2>(linear{}, fmpm<dynamic>{3}, read_out<field::full_acceleration, field::velocity>{});
}
TEST_CASE("waves: ... in 3D") {
    agree<3>(quadratic_spline{}, fmpm<3>{}, usl_minus{}, read_velocity{});
    agree<3>(linear{}, flip{}, usavg_minus{}, read_velocity{});
}

TEST_CASE("waves: a body of few particles, bodies in a bundle and a periodic grid take their passes one by one") {
    const auto steps_of = [](const auto& grid, double side, bool two) {
        solver mpm{grid, quadratic_spline{}, flip{}};
        const auto square = [=](const place<2>& at) { return (at.array() > 1).all() && (at.array() < 1 + side).all(); };
        auto one = mpm.make_body(rubber(), square, per_cell{2}), other = one;
        for (int k = 0; k < 2; ++k)
            if (two)
                mpm.step(bodies(one, other), 1e-3);
            else
                mpm.step(bodies(one), 1e-3);
        return mpm.steps_in_waves();
    };
    CHECK(steps_of(hall<2>(), 31, false) == 2);
    CHECK(steps_of(hall<2>(), 20, false) == 0);
    CHECK(steps_of(hall<2>(), 31, true) == 0);
    CHECK(steps_of(hall<2>().wrapped(1), 31, false) == 0);
}

TEST_CASE("waves: a law that asks for the flow past its particles gets it") {
    const auto run_of = [](const auto& how) {
        solver mpm{hall<2>(), quadratic_spline{}, flip{}, held{}, how};
        auto gas = mpm.make_body(pressure_gas{1.4, 1, 1}, everywhere, per_cell{2}, fields<origin>{});
        for (auto p : gas) p[x0] = p[symbols::x];
        for (auto p : gas) p[symbols::v] = place<2>(std::sin(p[x0][0]), std::cos(p[x0][1])) * 0.1;
        for (int step = 0; step < 3; ++step) mpm.step(bodies(gas), 1. / 64);
        return std::pair(snapshot(std::as_const(gas)), mpm.steps_in_waves());
    };
    const auto one = run_of(one_by_one{}), waves = run_of(serial{});
    CHECK(one.second == 0);
    CHECK(waves.second == 3);
    const bool same = one.first == waves.first;
    CHECK(same);
}

namespace {

/// A load throws in one of the first two steps: what that did to the particles stays, but all that it left on the nodes
/// is made anew.
template <class Shape, class Motion> void goes_on_after_failure(Shape shape, Motion motion, int good_steps) {
    CAPTURE(Shape::name, Motion::name, good_steps);
    bool broken = false;
    const auto pull = [&](const place<2>& at, double) {
        if (broken && at[1] > 9) throw error("the load broke");
        return place<2>(0.1, 0);
    };
    const auto loaded = [&] { return particle_force{everywhere, pull}; };
    solver mpm{hall<2>(), shape, fmpm<4>{}, motion, loaded()};
    auto block = block_in(mpm, [](const place<2>& at) { return (at.array() > 0.5).all() && (at.array() < 30).all(); });
    stir(block, 0.1, 0.1);
    for (int step = 0; step < good_steps; ++step) mpm.step(bodies(block), 1e-3);
    broken = true;
    CHECK_THROWS_AS(mpm.step(bodies(block), 1e-3), error);
    broken = false;
    auto copy = block;
    solver fresh{hall<2>(), shape, fmpm<4>{}, motion, loaded()};
    fresh.start_at(mpm.time());
    mpm.step(bodies(block), 1e-3);
    fresh.step(bodies(copy), 1e-3);
    CHECK(mpm.steps_in_waves() == good_steps + 2);
    const bool same = snapshot(std::as_const(block)) == snapshot(std::as_const(copy));
    CHECK(same);
}

}  // namespace

TEST_CASE("waves: what a load throws comes out of the step, and the next step is whole") {
    for (const int good_steps : {0, 1}) {
        goes_on_after_failure(linear{}, moving{}, good_steps);
        goes_on_after_failure(quadratic_spline{}, moving{}, good_steps);
        goes_on_after_failure(linear{}, held{}, good_steps);
    }
}

TEST_CASE("waves: sums are made in one order, whatever was asked of the solver before") {
    solver mpm{hall<2>(), quadratic_spline{}, fmpm<2>{}};
    auto block = block_in(mpm, [](const place<2>& at) { return (at.array() > 0.5).all() && (at.array() < 30).all(); });
    stir(block, 0.1, 0.1);
    auto copy = block;
    const auto once = mpm.inverse_column(bodies(block), {20, 20, 0}),
               again = mpm.inverse_column(bodies(block), {20, 20, 0});
    CHECK(once == again);
    CHECK(mpm.lightest_free_node(bodies(block)) == mpm.lightest_free_node(bodies(block)));
    mpm.step(bodies(block), 1e-3);
    solver fresh{hall<2>(), quadratic_spline{}, fmpm<2>{}};
    fresh.step(bodies(copy), 1e-3);
    const bool same = snapshot(std::as_const(block)) == snapshot(std::as_const(copy));
    CHECK(same);
}
