#include <tamis/tamis.hpp>

#include <cmath>
#include <limits>
#include <set>

#include "catch.hpp"

using namespace tamis;

namespace {

/// The nodes near a point have all the weight, give its place back, and are each met once.
template <class Shape> void nodes_near(const point<2, double>& where) {
    CAPTURE(Shape::support, where.transpose());
    solver mpm{uniform_grid{{-1., 2.}, {2., 4.}, 0.25}, Shape{}};
    double weight = 0;
    point<2, double> place(0, 0), slope(0, 0);
    matrix<2, double> place_slope = matrix<2, double>::Zero();
    std::set<std::array<int, 3>> met;
    const bool inside = each_near_node(mpm.lattice(), mpm.functions(), where, [&](const auto& node) {
        CHECK(met.insert(node.index).second);
        CHECK(node.at == mpm.grid().node(node.index));
        weight += node.weight;
        place += node.weight * node.at;
        slope += node.slope;
        place_slope += node.at * node.slope.transpose();
    });
    CHECK(inside);
    CHECK(std::abs(weight - 1) < 1e-15);
    CHECK((place - where).norm() < 1e-15);
    CHECK(slope.norm() < 1e-13);
    CHECK((place_slope - matrix<2, double>::Identity()).norm() < 1e-13);
}

}  // namespace

TEST_CASE("reach: the nodes near a point have all the weight, in the middle and at walls") {
    for (const point<2, double>& where :
         {point<2, double>(0.3, 3.1), point<2, double>(-1, 2.05), point<2, double>(2, 4)}) {
        nodes_near<linear>(where);
        nodes_near<quadratic_spline>(where);
        nodes_near<cubic_spline>(where);
    }
}

TEST_CASE("reach: a point outside has no nodes near it") {
    const solver mpm{uniform_grid{{0.}, {1.}, 0.5}};
    for (const double where : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
        CHECK_FALSE(
            each_near_node(mpm.lattice(), mpm.functions(), point<1, double>(where), [](const auto&) { FAIL(); }));
}
