// In 1D particles are updated and the next step's sums over them made in one pass. Nothing may come of it but speed.
#include <utility>

#include "laws/sameness.hpp"

using namespace laws;

namespace {

/// Bars of many cells with a gap between them, which swing and go to other cells; two slabs at least, with up to eight
/// lanes.
template <class Execution, class Lanes, class... Policies> struct bars {
    using solver_type =
        solver<uniform_grid<1, double>, walls<1>, Execution, Lanes, read_out<field::velocity>, Policies...>;
    solver_type mpm;
    static auto make_bar(const solver_type& of, double speed) {
        auto bar =
            block_in(of, [](const auto& at) { return (at[0] > 0 && at[0] < 100) || (at[0] > 120.1 && at[0] < 200); });
        for (auto p : bar) {
            const double x = p[x0][0];
            p[symbols::v][0] = speed * std::sin(0.7 * x) + 0.02 * std::sin(29 * x);
            p[symbols::sigma](0, 0) = 0.05 * std::cos(23 * x);
        }
        return bar;
    }
    decltype(make_bar(mpm, 0.)) bar;
    explicit bars(double speed, Execution run, Lanes lanes_of, Policies... policies)
        : mpm(box<1>({880}),
              walls<1>{[](const auto& at) { return at[0] < 0 || at[0] > 199; },
                       [](const auto&, double t) { return place<1>(0.1 * std::sin(3 * t)); }},
              run, lanes_of, read_out<field::velocity>{}, policies...),
          bar(make_bar(mpm, speed)) {}
};
template <class Execution, class Lanes, class... Policies> bars(double, Execution, Lanes, Policies...)
    -> bars<Execution, Lanes, Policies...>;

double difference(const auto& one, const auto& other) {
    REQUIRE(one.size() == other.size());
    double most = 0;
    for (const auto& [key, values] : one)
        for (std::size_t c = 0; c < values.size(); ++c) most = std::max(most, std::abs(values[c] - other.at(key)[c]));
    return most;
}
/// What is left behind, with reactions and work.
auto state(const auto& b) {
    std::vector<double> nodes{b.mpm.boundary_work()};
    for (const auto& node : b.mpm.reactions()) nodes.push_back(node.reaction[0]);
    for (int i = 0; i < 880; ++i) nodes.push_back(b.mpm.on_node(symbols::v, {i, 0, 0})[0]);
    return std::pair(snapshot(std::as_const(b.bar)), nodes);
}
constexpr double dt = 1. / 256;

/// The same steps in one pass and in two, of particles that stay in their cells or not.
template <class... Policies> void passes_agree(double speed, Policies... policies) {
    CAPTURE(speed);
    bars one(speed, serial{}, native_lanes{}, policies...), two(speed, serial{}, native_lanes{}, policies...);
    const int steps = 40;
    for (int step = 0; step < steps; ++step) {
        one.mpm.step(bodies(one.bar), dt);
        two.bar.begin();  // open to changes: its sums are made anew
        two.mpm.step(bodies(two.bar), dt);
    }
    CHECK(two.mpm.steps_in_one_pass() == 0);
    CHECK(two.bar.store().slabs() > 1);
    CHECK(one.mpm.crossings() == two.mpm.crossings());
    if (decltype(one.mpm)::width > 1) {
        if (one.mpm.crossings() == 0)
            CHECK(one.mpm.steps_in_one_pass() == steps - 1);
        else
            CHECK(one.mpm.steps_in_one_pass() > 0);
    }
    const auto by_one = state(one), by_two = state(two);
    CHECK(difference(by_one.first, by_two.first) < 1e-12);
    for (std::size_t k = 0; k < by_one.second.size(); ++k)
        CHECK_THAT(by_one.second[k], Catch::Matchers::WithinAbs(by_two.second[k], 1e-11));
}
/// The same by threads, bit for bit, and one lane wide, to round-off.
template <class... Policies> void runs_agree(Policies... policies) {
    bars alone(0.6, serial{}, native_lanes{}, policies...);
    bars narrow(0.6, serial{}, one_lane{}, policies...);
    for (int step = 0; step < 40; ++step) {
        alone.mpm.step(bodies(alone.bar), dt);
        narrow.mpm.step(bodies(narrow.bar), dt);
    }
    CHECK(alone.mpm.crossings() > 10);
    CHECK(narrow.mpm.steps_in_one_pass() == 0);
    const auto expected = state(alone);
    CHECK(difference(expected.first, state(narrow).first) < 1e-10);
#if defined(_OPENMP)
    for (const int count : {2, 3}) {
        bars parted(0.6, threads{count}, native_lanes{}, policies...);
        for (int step = 0; step < 40; ++step) parted.mpm.step(bodies(parted.bar), dt);
        CHECK(parted.mpm.steps_in_one_pass() == alone.mpm.steps_in_one_pass());
        const bool same = state(parted) == expected;
        CHECK(same);
    }
#endif
}

}  // namespace

TEST_CASE("one pass: the same as two, for particles that stay and for particles that go to other cells") {
    for (const double speed : {0., 0.6}) {
        passes_agree(speed, linear{}, flip{}, euler{});
        passes_agree(speed, quadratic_spline{}, xpic<2>{}, usl_minus{});
    }
    passes_agree(0., linear{}, flip{}, euler{}, held{});
    passes_agree(0., cubic_spline{}, pic{}, usl_minus{}, held{});
}
TEST_CASE("one pass: the same for any number of threads, and one lane wide") { runs_agree(linear{}, flip{}, euler{}); }

TEST_CASE("one pass: sums made ahead are not those of a body that was changed, copied or stepped elsewhere") {
    const auto make = [] { return bars(0.1, serial{}, native_lanes{}, linear{}, flip{}, usl_minus{}); };
    auto one = make(), other = make();
    auto& mpm = one.mpm;
    for (int step = 0; step < 3; ++step) mpm.step(bodies(one.bar), dt);
    const long before = mpm.steps_in_one_pass();
    CHECK((before == 2 || decltype(one.mpm)::width == 1));
    // What a solver that knows nothing of steps before makes of a body.
    const auto expect = [&](auto bar) {
        auto fresh = make();
        fresh.mpm.start_at(mpm.time());
        fresh.mpm.step(bodies(bar), dt);
        return snapshot(std::as_const(bar));
    };
    const auto step_as = [&](const auto& expected) {
        mpm.step(bodies(one.bar), dt);
        CHECK(mpm.steps_in_one_pass() == before);
        CHECK(difference(snapshot(std::as_const(one.bar)), expected) < 1e-13);
    };
    SECTION("changed") {
        for (auto p : one.bar) p[symbols::v][0] *= -2;
        step_as(expect(one.bar));
    }
    SECTION("assigned") {
        one.bar = other.bar;
        step_as(expect(one.bar));
    }
    SECTION("another body in between") {
        auto copy = one.bar;
        const auto expected = expect(one.bar);
        const double now = mpm.time();
        mpm.step(bodies(copy), dt);
        mpm.start_at(now);
        mpm.step(bodies(one.bar), dt);
        CHECK(mpm.steps_in_one_pass() == 0);
        CHECK(difference(snapshot(std::as_const(one.bar)), expected) < 1e-13);
    }
    SECTION("stepped by another solver in between") {
        other.mpm.start_at(mpm.time() - dt);
        other.mpm.step(bodies(one.bar), dt);
        step_as(expect(one.bar));
    }
}
