#include <tamis/tamis.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
};
constexpr temperature warmth;
struct heat_flow : vector_field {
    static constexpr std::string_view name = "heat_flow";
};
constexpr heat_flow flow;

const linear_elastic law{.young = 3, .poisson = 0.2, .density = 5};

auto plane_solver() { return solver{uniform_grid{{-1., 2.}, {2., 4.}, 0.25}, quadratic_spline{}, flip{}}; }

}  // namespace

TEST_CASE("body: every particle is met once, in its place, with the mass and volume of its share") {
    auto mpm = plane_solver();
    const auto inside = [](const auto& at) { return at[0] < 0.6 && at[1] > 2.4; };
    auto block = mpm.make_body(law, inside, per_cell{3});
    std::map<std::pair<long, long>, int> met;
    double mass = 0, volume = 0;
    for (const auto p : std::as_const(block)) {
        const auto at = p[x];
        CHECK(inside(at));
        ++met[{std::lround((at[0] + 1) * 120), std::lround((at[1] - 2) * 120)}];
        mass += p[m];
        volume += p[V];
        CHECK(p[v].norm() == 0);
        CHECK(p[sigma].norm() == 0);
    }
    CHECK(met.size() == block.size());
    for (const auto& [place, times] : met) {
        CHECK(times == 1);
        // (s + 1/2)/3 of a cell of 1/4 is (2 s + 1) times 5/120.
        CHECK(place.first % 10 == 5);
        CHECK(place.second % 10 == 5);
    }
    CHECK(std::abs(mass - 5 * volume) < 1e-12);
    CHECK(std::abs(volume - double(block.size()) * 0.0625 / 9) < 1e-14);
    CHECK(block.occupancy() > 0);
    CHECK(block.occupancy() <= 1);
}

TEST_CASE("body: particles are written to in place, whatever the kind of field") {
    auto mpm = plane_solver();
    auto block = mpm.make_body(law, everywhere, per_cell{1}, fields<temperature, heat_flow, field::deformation>{});
    STATIC_REQUIRE(block.has(warmth));
    STATIC_REQUIRE(block.has(F));
    STATIC_REQUIRE_FALSE(block.has(rho));
    STATIC_REQUIRE_FALSE(decltype(plane_solver().make_body(law, everywhere, per_cell{1}))::has(warmth));

    double k = 0;
    for (auto p : block) {
        CHECK(p[F] == Eigen::Matrix2d::Identity());
        k += 1;
        p[warmth] = k;
        p[flow] << k, -k;
        p[v][1] = 2 * k;
        p[F](0, 1) = 3 * k;
        p[sigma] = (Eigen::Matrix2d() << k, 1, 3, -k).finished();
        CHECK(p[sigma](0, 1) == 2);
        p[sigma](1, 0) = 7;
    }
    CHECK(k == double(block.size()));
    k = 0;
    for (const auto p : std::as_const(block)) {
        k += 1;
        CHECK(p[warmth] == k);
        CHECK(p[flow] == Eigen::Vector2d(k, -k));
        CHECK(p[v] == Eigen::Vector2d(0, 2 * k));
        CHECK(p[F] == (Eigen::Matrix2d() << 1, 3 * k, 0, 1).finished());
        CHECK(p[sigma] == (Eigen::Matrix2d() << k, 7, 7, -k).finished());
    }
}

TEST_CASE("body: a field asked for goes with its particle to other cells") {
    auto mpm = plane_solver();
    auto block = mpm.make_body(
        law, [](const auto& at) { return (at - point<2, double>(0, 3)).norm() < 0.5; }, per_cell{2},
        fields<temperature>{});
    for (auto p : block) {
        p[v] << 1, 0.5;
        p[warmth] = p[x][0] - 2 * p[x][1];
    }
    for (int k = 0; k < 10; ++k) mpm.step(bodies(block), 0.1);
    CHECK(mpm.crossings() > 0);
    for (const auto p : std::as_const(block)) CHECK(std::abs(p[warmth] - (p[x][0] - 1 - 2 * (p[x][1] - 0.5))) < 1e-9);
}

TEST_CASE("body: held particles are where they were put, known from their weights") {
    const uniform_grid grid{{-1., 2.}, {2., 4.}, 0.25};
    std::vector<point<2, double>> points{{-1, 2}, {-0.99, 3.99}, {1.7, 2.3}, {2, 4}, {0.125, 3.1}};
    const auto check = [&](auto shape) {
        solver mpm{grid, shape, flip{}, held{}};
        auto some = mpm.make_body_at(law, points, 0.01);
        CHECK(some.size() == points.size());
        for (const auto& at : points) {
            double nearest = 1;
            for (const auto p : std::as_const(some)) nearest = std::min(nearest, (p[x] - at).norm());
            CHECK(nearest < 1e-15);
        }
    };
    check(linear{});
    check(quadratic_spline{});
    check(cubic_spline{});
}

TEST_CASE("body: a copy is a body of its own") {
    auto mpm = plane_solver();
    auto block = mpm.make_body(law, everywhere, per_cell{1});
    auto other = block;
    for (auto p : other) p[m] = 1e9;
    for (const auto p : std::as_const(block)) CHECK(p[m] == 0.0625 * 5);
    CHECK(other.size() == block.size());
}

TEST_CASE("body: one that was moved from is empty, refused by a step, and as good as new when it is given another") {
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, 0.125}, quadratic_spline{}, flip{}};
    const auto middle = [](const auto& at) { return (at - point<2, double>(1, 1)).norm() < 0.4; };
    auto first = mpm.make_body(law, middle, per_cell{2});
    const std::size_t count = first.size();
    for (auto p : first) p[v] << 1, 0.5;
    // Letters are under way.
    for (int k = 0; k < 5; ++k) mpm.step(bodies(first), 0.01);
    REQUIRE(mpm.crossings() > 0);
    auto expected = first;
    CHECK_FALSE(first.moved_from());
    auto second = std::move(first);
    const auto is_empty = [](auto& body) {
        CHECK(body.moved_from());
        CHECK(body.size() == 0);
        for (const auto p : std::as_const(body)) FAIL("there is a particle at " << p[x]);
        for (auto p : body) FAIL("there is a particle at " << p[x]);
        CHECK(body.occupancy() == 1);
        CHECK(total_mass(body) == 0);
    };
    is_empty(first);
    const auto why = complaint([&] { mpm.step(bodies(first), 0.01); });
    CHECK(names(why, "step: a body has no particles", "moved from", "assign"));
    CHECK(names(complaint([&] { mpm.step(bodies(second, first), 0.01); }), "moved from"));
    CHECK(names(complaint([&] { integrate(mpm, bodies(first), {0, 1}, fixed_steps{100}); }), "moved from"));

    const auto same = [](const auto& one, const auto& with) {
        REQUIRE(one.size() == with.size());
        auto other = with.begin();
        for (const auto p : one) {
            CHECK(p[x] == (*other)[x]);
            CHECK(p[v] == (*other)[v]);
            ++other;
        }
    };
    CHECK(second.size() == count);
    same(second, expected);
    for (int k = 0; k < 5; ++k) mpm.step(bodies(second), 0.01);
    for (int k = 0; k < 5; ++k) mpm.step(bodies(expected), 0.01);
    same(second, expected);

    first = std::move(second);
    is_empty(second);
    same(first, expected);
    second = first;
    for (int k = 0; k < 5; ++k) mpm.step(bodies(first), 0.01);
    for (int k = 0; k < 5; ++k) mpm.step(bodies(second), 0.01);
    same(first, second);
}

TEST_CASE("body: several threads may read and copy a const body, also where particles have just gone to other cells") {
    solver mpm{uniform_grid{{0.}, {1.}, 1. / 2000}, linear{}};
    const linear_elastic soft{.young = 1e-9, .density = 1};
    auto bar = mpm.make_body(
        soft, [](const auto& at) { return at[0] < 0.9; }, per_cell{2});
    set_velocity_of(bar, [](const auto&) { return 1.; });
    for (int round = 0; round < 60; ++round) {
        mpm.step(bodies(bar), 0.3 / 2000);
        const auto& read = bar;
        struct seen {
            double mass = 0, mean = 0, copy = 0, occupancy = 0;
            bool operator==(const seen&) const = default;
        };
        const auto look = [&](bool copies_first) {
            seen all;
            if (copies_first) {
                const auto copy = read;
                all.copy = total_mass(copy);
            }
            all.occupancy = read.occupancy();
            all.mass = total_mass(read);
            all.mean = mean(read, x)[0];
            if (!copies_first) {
                const auto copy = read;
                all.copy = total_mass(copy);
            }
            return all;
        };
        std::array<seen, 3> found;
        std::atomic<int> here{0};
        std::vector<std::thread> threads;
        for (std::size_t k = 0; k < found.size(); ++k)
            threads.emplace_back([&, k] {
                ++here;
                while (here < 3) {
                }
                found[k] = look(k == 1);
            });
        for (auto& one : threads) one.join();
        const seen afterwards = look(true);
        for (const seen& one : found) REQUIRE(one == afterwards);
        REQUIRE(std::abs(afterwards.mass - 0.9) < 1e-12);
    }
}
