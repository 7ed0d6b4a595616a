// What must hold when a solver is used in ways that its first user did not think of.
#include <tamis/tamis.hpp>

#include <limits>
#include <memory>
#include <string>

#include "catch.hpp"

using namespace tamis;

namespace {

const linear_elastic soft{.young = 1, .poisson = 0, .density = 1};

template <class Action> std::string message_of(Action action) {
    try {
        action();
    } catch (const error& e) {
        return e.what();
    }
    return "";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const auto between = [](double low, double high) {
    return [=](const auto& at) { return at[0] > low && at[0] < high; };
};
template <class Body> void push(Body& body, double speed) {
    for (auto p : body) p[symbols::v].setConstant(static_cast<typename Body::real>(speed));
}
template <class Body> double largest_difference(const Body& body, double speed) {
    double most = 0;
    for (const auto p : body) most = std::max(most, std::abs(p[symbols::v][0] - speed));
    return most;
}

}  // namespace

TEST_CASE("one solver steps different bodies in turn") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.01}, linear{}, pic{}};
    auto a = mpm.make_body(soft, between(0.1, 0.2), per_cell{2});
    auto b = mpm.make_body(soft, between(0.7, 0.8), per_cell{2});
    push(a, 0.01);
    push(b, -0.02);
    for (int k = 0; k < 20; ++k) {
        mpm.step(bodies(a), 1e-3);
        mpm.step(bodies(b), 1e-3);
    }
    CHECK(largest_difference(a, 0.01) < 1e-14);
    CHECK(largest_difference(b, -0.02) < 1e-14);
}

TEST_CASE("a body goes on with another solver at the place of the first, and so does its copy") {
    using solver_type = decltype(solver{uniform_grid{{0.}, {1.}, 0.01}, linear{}, pic{}});
    const auto make = [] { return std::make_unique<solver_type>(uniform_grid{{0.}, {1.}, 0.01}, linear{}, pic{}); };
    auto mpm = make();
    auto a = mpm->make_body(soft, between(0.1, 0.2), per_cell{2});
    push(a, 0.01);
    for (int k = 0; k < 3; ++k) {
        mpm->step(bodies(a), 1e-3);
        mpm.reset();
        mpm = make();
    }
    auto copy = a;
    mpm->step(bodies(copy), 1e-3);
    mpm->step(bodies(a), 1e-3);
    CHECK(largest_difference(a, 0.01) < 1e-14);
    CHECK(largest_difference(copy, 0.01) < 1e-14);
}

TEST_CASE("bodies that a solver cannot step are refused") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.01}, linear{}, pic{}};
    solver other{uniform_grid{{0.}, {2.}, 0.01}, linear{}, pic{}};
    auto a = mpm.make_body(soft, between(0.1, 0.2), per_cell{2});
    CHECK(has(message_of([&] { other.step(bodies(a), 1e-3); }), "made on another grid"));
    CHECK(has(message_of([&] { mpm.step(bodies(a, a), 1e-3); }), "given twice"));
}

TEST_CASE("a wall that no particle reaches feels nothing") {
    const prescribed wall{[](const auto& at) { return at[0] <= 0; }, [](const auto&, auto t) { return t; }};
    solver mpm{uniform_grid{{0.}, {2.}, 0.01}, linear{}, flip{}, wall};
    auto near = mpm.make_body(soft, between(0, 0.1), per_cell{2});
    auto far = mpm.make_body(soft, between(1.5, 1.6), per_cell{2});
    for (int k = 0; k < 5; ++k) mpm.step(bodies(near), 1e-3);
    CHECK(mpm.reactions().at(0).reaction.norm() > 0);
    const double work = mpm.boundary_work();
    for (int k = 0; k < 5; ++k) mpm.step(bodies(far), 1e-3);
    CHECK(mpm.reactions().at(0).reaction.norm() == 0);
    CHECK(mpm.boundary_work() == work);
}

TEST_CASE("a body that flies far leaves no trail of empty tiles") {
    solver mpm{uniform_grid{{0.}, {40.}, 0.1}, quadratic_spline{}, flip{}};
    auto a = mpm.make_body(soft, between(1, 4.2), per_cell{2});
    push(a, 1.0);
    for (int k = 0; k < 3000; ++k) mpm.step(bodies(a), 1e-2);
    CHECK(a.size() == 64);
    CHECK(a.occupancy() > 0.3);
    CHECK(a.store().tiles.size() < 60 / decltype(mpm)::width + 12);
}

TEST_CASE("a particle that left is still there to be looked at, and the solver can go on") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, linear{}, flip{}};
    auto a = mpm.make_body(soft, everywhere, per_cell{1});
    push(a, 0.0);
    (*a.begin())[symbols::v][0] = -30;
    CHECK(has(message_of([&] { mpm.step(bodies(a), 1e-2); }), "left the grid"));
    std::size_t seen = 0;
    for (const auto p : std::as_const(a)) seen += p[symbols::m] > 0 ? 1 : 0;
    CHECK(seen == a.size());
    CHECK(seen == 20);
    push(a, 0.0);
    CHECK_NOTHROW(mpm.step(bodies(a), 1e-12));
}

TEST_CASE("what was refused once is refused again") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, linear{}, pic{}, held{}};
    auto a = mpm.make_body(soft, everywhere, per_cell{1});
    (*a.begin())[symbols::m] = -1;
    for (int k = 0; k < 2; ++k) CHECK(has(message_of([&] { mpm.step(bodies(a), 1e-3); }), "its mass is -1"));
    push(a, 2.0);
    (*a.begin())[symbols::m] = 1;
    mpm.step(bodies(a), 1e-3);
    CHECK(largest_difference(a, 2.0) < 1e-14);
}

TEST_CASE("a particle at rest on a wall stays, whatever the number of cells") {
    for (int n = 1; n < 400; ++n) {
        const auto stays = [n](auto shape) {
            solver mpm{uniform_grid{{0.}, {1.}, 1.0 / n}, shape, flip{}};
            auto a = mpm.make_body_at(soft, {point<1, double>(0.0), point<1, double>(1.0)}, 0.1);
            return message_of([&] { mpm.step(bodies(a), 1e-3); });
        };
        CAPTURE(n);
        CHECK(stays(linear{}) == "");
        CHECK(stays(quadratic_spline{}) == "");
        CHECK(stays(cubic_spline{}) == "");
    }
}

TEST_CASE("conditions that come to disagree are refused at that time") {
    const auto left = [](const auto& at) { return at[0] <= 0; };
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{},
               conditions{fixed{left}, prescribed{left, [](const auto&, auto t) { return t < 0.25 ? 0.0 : 1.0; }}}};
    auto a = mpm.make_body(soft, everywhere, per_cell{2});
    for (int k = 0; k < 2; ++k) CHECK_NOTHROW(mpm.step(bodies(a), 0.1));
    CHECK(has(message_of([&] { mpm.step(bodies(a), 0.1); }), "boundary conditions disagree"));
}

TEST_CASE("cells of more than 64 particles notice which of them leave") {
    // 90 particles in each of two cells, of which one moves on to the next: it is light beside the others, which rest.
    for (const int leaves : {0, 1, 61, 62, 63, 64, 65, 89}) {
        CAPTURE(leaves);
        solver mpm{uniform_grid{{0., 0.}, {40., 3.}, 1.}, linear{}, fmpm<1>{}};
        std::vector<point<2, double>> places;
        for (const double cell : {10, 11})
            for (int k = 0; k < 90; ++k) places.push_back(point<2, double>(cell + (k + 0.5) / 90, 1.5));
        auto a = mpm.make_body_at(soft, places, 0.01, fields<field::id>{});
        for (auto p : a) {
            const bool moves = static_cast<int>(p[field::id{}]) % 90 == leaves;
            p[symbols::m] = moves ? 1e-9 : 1;
            p[symbols::v][0] = moves ? 2 : 0;
        }
        // By the mean of 2 and of the nodes' velocity.
        mpm.step(bodies(a), 0.999);
        CHECK(mpm.crossings() == 2);
        std::size_t seen = 0;
        for (const auto p : std::as_const(a)) {
            CHECK(p.cell()[0] == static_cast<int>(std::floor(p[symbols::x][0])));
            ++seen;
        }
        CHECK(seen == 180);
    }
}

namespace {

/// Infinite at two corners of cells, where there is no particle, but where empty lanes are.
struct singular {
    [[maybe_unused]] static constexpr bool in_lanes = true;
    template <class V> V acceleration(const V& x, const V&, auto) const {
        V b = x;
        for (int d = 0; d < static_cast<int>(x.size()); ++d)
            b[d] = typename V::Scalar(1e-5) / ((x[d] - 0.375) * (x[d] - 0.625));
        return b;
    }
};

}  // namespace

TEST_CASE("a load need make no sense where no particle is") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.125}, linear{}, flip{}, singular{}, held{}};
    // One particle per cell sits at its middle; empty lanes have their cell's corner: that of the cell before 0.5, or
    // of the one before 0.75, gives to nodes that particles beside it read.
    auto a = mpm.make_body(
        soft, [](const auto& at) { return at[0] < 0.4 || at[0] > 0.7; }, per_cell{1});
    mpm.step(bodies(a), 1e-3);
    for (const auto p : std::as_const(a)) CHECK(std::isfinite(p[symbols::v][0]));
}

TEST_CASE("a body whose particles all left has no mass") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{}, leaving_removes{}};
    auto a = mpm.make_body(soft, everywhere, per_cell{2});
    push(a, 2.0);
    for (int k = 0; k < 30; ++k) mpm.step(bodies(a), 0.02);
    CHECK(a.size() == 0);
    CHECK(total_mass(a) == 0);
    CHECK(kinetic_energy(a) == 0);
    CHECK(total_momentum(a).norm() == 0);
}

TEST_CASE("a million floats add up to their sum") {
    solver mpm{uniform_grid{{0.f}, {1.f}, 1.f / 1000}, linear{}};
    auto a = mpm.make_body(soft, everywhere, per_cell{1000});
    CHECK(std::abs(total_mass(a) - 1.0) < 1e-5);
    push(a, 1.0);
    CHECK(std::abs(total_momentum(a)[0] - 1.0) < 1e-5);
    CHECK(std::abs(kinetic_energy(a) - 0.5) < 1e-5);
    CHECK(std::abs(mean(a, symbols::v)[0] - 1.0) < 1e-5);
}

TEST_CASE("a second run counts from its own start, and a run in two parts is one run") {
    const prescribed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; },
                          [](const auto& at, auto t) { return 0.01 * at[0] * t; }};
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, linear{}, flip{}, ends, held{}};
    const auto run = [&](auto... parts) {
        auto a = mpm.make_body(soft, everywhere, per_cell{2});
        (integrate(mpm, bodies(a), parts, fixed_steps{static_cast<long>((parts.end - parts.begin) * 100 + 0.5)}), ...);
        return std::pair{mpm.boundary_work(), mpm.steps()};
    };
    const auto first = run(interval{0, 1}), second = run(interval{0, 1}),
               in_two = run(interval{0, 0.5}, interval{0.5, 1});
    CHECK(first == second);
    CHECK(in_two.second == 100);
    CHECK(std::abs(in_two.first - first.first) < 1e-12 * std::abs(first.first));
}

TEST_CASE("bad numbers are answered with a sentence") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}};
    auto a = mpm.make_body(soft, everywhere, per_cell{2});
    CHECK(has(message_of([&] {
                  integrate(mpm, bodies(a), {0, 1}, courant{2});
              }),
              "the Courant number (c + |V|) dt/h is 2 with dt"));
    CHECK(has(message_of([&] {
                  integrate(mpm, bodies(a), {1, 1}, courant{0.2});
              }),
              "give a beginning and a later, finite end"));
    CHECK(has(message_of([&] { mpm.step(bodies(a), 0.01, -5); }), "give a later, finite end"));
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(has(message_of([&] { mpm.step(bodies(a), infinite); }), "the time step is inf; give a positive, finite"));
    for (auto p : a) p[symbols::V] = infinite;
    CHECK(has(message_of([&] { mpm.step(bodies(a), 0.01); }), "its volume is inf; give a positive, finite"));
    CHECK(has(message_of([&] { mpm.make_body(soft, everywhere, per_cell{1 << 30}); }), "give fewer"));
    CHECK(has(message_of([] {
                  solver huge{uniform_grid{{0., 0., 0.}, {1., 1., 1.}, 1e-5}};
              }),
              "more than can be numbered; take fewer cells"));
}
