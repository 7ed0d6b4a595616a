#include <tamis/tamis.hpp>

#include <cmath>
#include <map>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1e-6, .poisson = 0.2, .density = 1};
constexpr field::id id;

/// Particles by their numbers; each number must be met once.
template <class Body> auto by_id(const Body& body) {
    using point_type = point<Body::dim, typename Body::real>;
    std::map<long, point_type> all;
    for (const auto p : body) {
        const double number = static_cast<double>(p[id]);
        REQUIRE(number == std::floor(number));
        REQUIRE(all.emplace(static_cast<long>(number), p[x]).second);
    }
    REQUIRE(all.size() == body.size());
    return all;
}

}  // namespace

TEST_CASE("seeding: particles are numbered in the order of their points, where somebody asks for it") {
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, 0.125}, linear{}, flip{}};
    const std::vector<point<2, double>> points{{1.9, 1.9}, {0.1, 0.1}, {1.9, 1.85}, {0.1, 1.7}, {0.1, 0.1}, {1.1, 0.3}};
    const auto some = mpm.make_body_at(law, points, 0.01, fields<field::id>{});
    const auto found = by_id(some);
    REQUIRE(found.size() == points.size());
    for (const auto& [k, where] : found) CHECK((where - points[static_cast<std::size_t>(k)]).norm() < 1e-15);
    STATIC_REQUIRE_FALSE(decltype(mpm.make_body(law, everywhere, per_cell{1}))::has(id));

    // In a region: cell by cell, x fastest.
    solver still{uniform_grid{{0., 0.}, {2., 2.}, 0.125}, linear{}, flip{}, held{}};
    const auto block = still.make_body(law, everywhere, per_cell{2}, fields<field::id>{});
    for (const auto& [k, where] : by_id(block)) {
        CHECK(std::lround(where[0] * 16 - 0.5) == k % 32);
        CHECK(std::lround(where[1] * 16 - 0.5) == k / 32);
    }
}

TEST_CASE("seeding: numbers stay with particles that cross cells, while tiles are sorted and others leave") {
    solver mpm{uniform_grid{{0., 0.}, {60., 8.}, 1.}, quadratic_spline{}, flip{}, leaving_removes{}};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] > 2 && at[0] < 30; }, per_cell{2}, fields<field::id>{});
    const std::size_t count = block.size();
    const auto before = by_id(block);
    for (auto p : block) p[v] << 1, 0.02;
    const auto ground = block.store().ground.number();
    for (int k = 0; k < 450; ++k) mpm.step(bodies(block), 0.1);
    CHECK(mpm.crossings() > 10 * count);
    CHECK(block.store().ground.number() != ground);
    CHECK(block.size() < count);
    CHECK(block.size() > count / 4);
    for (const auto& [k, where] : by_id(block)) CHECK((where - before.at(k) - point<2, double>(45, 0.9)).norm() < 0.1);
}

TEST_CASE("seeding: more particles than numbers of the grid's kind tell apart are refused") {
    CHECK_NOTHROW(detail::check_ids<float>(1 << 24));
    CHECK(names(complaint([] { detail::check_ids<float>((1 << 24) + 1); }), "make_body: field::id", "16777217",
                "16777216", "24 binary digits", "double"));
    CHECK_NOTHROW(detail::check_ids<double>(std::uint64_t(1) << 53));
    CHECK(names(complaint([] { detail::check_ids<double>((std::uint64_t(1) << 53) + 1); }), "53 binary digits"));
    CHECK_NOTHROW(detail::check_ids<long double>(std::uint64_t(1) << 60));
    CHECK(static_cast<float>(1 << 24) != static_cast<float>((1 << 24) - 1));
}
