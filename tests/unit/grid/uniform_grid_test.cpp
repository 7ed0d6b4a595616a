#include <tamis/grid/uniform_grid.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string line(double lower, double upper, double spacing) {
    return complaint([&] { uniform_grid{{lower}, {upper}, spacing}; });
}

}  // namespace

TEST_CASE("uniform_grid: corners give the dimension, the extent gives the cells") {
    const uniform_grid grid{{-0.3, 0., 1.}, {0.7, 2., 1.5}, 0.1};
    STATIC_REQUIRE(std::is_same_v<decltype(grid), const uniform_grid<3, double>>);
    CHECK(grid.cells(0) == 10);
    CHECK(grid.cells(1) == 20);
    CHECK(grid.cells(2) == 5);
    CHECK(std::abs(grid.spacing() - 0.1) < 1e-16);
    CHECK(grid.lower()[0] == -0.3);
    CHECK(grid.upper()[2] == 1.5);
}

TEST_CASE("uniform_grid: nodes on the walls are exactly there, and nodes go up evenly") {
    for (const int n : {1, 3, 7, 49, 76, 1000}) {
        const double lower = -0.3, upper = 0.7, spacing = (upper - lower) / n;
        const uniform_grid grid{{lower}, {upper}, spacing};
        REQUIRE(grid.cells(0) == n);
        CHECK(grid.node({0, 0, 0})[0] == lower);
        CHECK(grid.node({n, 0, 0})[0] == upper);
        for (int i = 0; i < n; ++i) {
            const double step = grid.node({i + 1, 0, 0})[0] - grid.node({i, 0, 0})[0];
            CHECK(std::abs(step - spacing) < 2e-16);
        }
    }
    const uniform_grid plane{{0., -1.}, {0.9, 0.2}, 0.3};
    const auto corner = plane.node({3, 4, 0});
    CHECK(corner[0] == 0.9);
    CHECK(corner[1] == 0.2);
}

TEST_CASE("uniform_grid: a spacing that misses the walls by round-off is taken, and made to fit") {
    const uniform_grid thirds{{0.}, {1.}, 0.3333333333};
    CHECK(thirds.cells(0) == 3);
    CHECK(thirds.spacing() == 1. / 3);
    const uniform_grid single{{0.f}, {1.f}, 0.02f};
    STATIC_REQUIRE(std::is_same_v<decltype(single)::real, float>);
    CHECK(single.cells(0) == 50);
    const uniform_grid extended{{0.L}, {1.L}, 0.125L};
    STATIC_REQUIRE(std::is_same_v<decltype(extended)::real, long double>);
    CHECK(extended.cells(0) == 8);
}

TEST_CASE("uniform_grid: a spacing that is no positive number is refused") {
    CHECK(names(line(0, 1, -0.1), "uniform_grid", "spacing is -0.1", "positive"));
    for (const double spacing : {0., not_a_number, infinity, -infinity}) {
        CAPTURE(spacing);
        CHECK(names(line(0, 1, spacing), "uniform_grid", "spacing is", "positive"));
    }
}

TEST_CASE("uniform_grid: corners in the wrong order, or not numbers, are refused by axis") {
    CHECK(names(line(1, 0, 0.1), "uniform_grid", "axis 0", "upper corner (0)", "lower one (1)"));
    for (const double upper : {0., not_a_number, infinity}) {
        CAPTURE(upper);
        CHECK(names(line(0, upper, 0.1), "uniform_grid", "axis 0", "upper corner"));
    }
    CHECK(names(line(not_a_number, 1, 0.1), "uniform_grid", "lower one (nan)"));
    CHECK(names(complaint([] { uniform_grid{{0., 0.}, {1., -1.}, 0.1}; }), "axis 1", "-1"));
}

TEST_CASE("uniform_grid: a box that is not a whole number of cells is refused by axis") {
    CHECK(names(line(0, 1, 0.3), "uniform_grid", "3.3333", "axis 0", "whole number"));
    CHECK(names(line(0, 1, 3), "whole number"));
    CHECK(names(line(0, 1, 1.2), "whole number"));
    CHECK(names(complaint([] { uniform_grid{{0., 0.}, {1., 1.05}, 0.1}; }), "10.5", "axis 1"));
}

TEST_CASE("uniform_grid: more cells than can be numbered are refused") {
    CHECK(names(line(0, 1, 1e-9), "uniform_grid", "axis 0", "1048576", "larger spacing"));
}

TEST_CASE("uniform_grid: every node once, i fastest") {
    const uniform_grid grid{{0., 0.}, {3., 1.}, 1.};
    std::vector<std::array<int, 3>> seen;
    grid.each_node([&](const std::array<int, 3>& index) { seen.push_back(index); });
    const std::vector<std::array<int, 3>> expected{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0},
                                                   {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {3, 1, 0}};
    CHECK(seen == expected);
}

TEST_CASE("uniform_grid: axes of three cells or more may be wrapped") {
    const uniform_grid grid{{0., 0.}, {3., 2.}, 1.};
    CHECK(grid.wrapped(0).wraps(0));
    CHECK_FALSE(grid.wrapped(0).wraps(1));
    CHECK_FALSE(grid.wraps(0));
    CHECK(names(complaint([&] { grid.wrapped(1); }), "2 cells along axis 1", "cannot be wrapped", "3 or more"));
    for (const int axis : {-1, 2}) CHECK(names(complaint([&] { grid.wrapped(axis); }), "no axis", "to wrap"));
}
TEST_CASE("uniform_grid: numbers that are too coarse for its cells are refused") {
    using namespace tamis;
    REQUIRE_THROWS_AS((uniform_grid<2, float>{{4.5e6f, 5.5e6f}, {4.5e6f + 8, 5.5e6f + 8}, 0.25f}), error);
    REQUIRE_THROWS_AS((uniform_grid<1, float>{{-1e5f}, {-1e5f + 8}, 0.25f}), error);
    REQUIRE_THROWS_AS((uniform_grid<1, double>{{1e13}, {1e13 + 8}, 0.5}), error);
    CHECK_NOTHROW(uniform_grid<2, double>{{4.5e6, 5.5e6}, {4.5e6 + 8, 5.5e6 + 8}, 0.25});
    CHECK_NOTHROW(uniform_grid<1, float>{{0.f}, {1.f}, 1.f / 4000});
    CHECK_NOTHROW(uniform_grid<1, float>{{-1000.f}, {-992.f}, 0.25f});
}
