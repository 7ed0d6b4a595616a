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

TEST_CASE("reach: a stretched particle has its own weights, those of the next step") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, cpgimp{2}};
    auto one = mpm.make_body_at(neo_hookean{.young = 1, .density = 1}, {point<1, double>(0.45)}, 0.125);
    set_deformation_of(one, [](const auto&) { return 1.6; });
    for (auto p : one) p[symbols::v][0] = 1;
    const auto weights_of = [&](const auto& of) {
        std::array<double, 5> all{};
        CHECK(each_near_node(mpm.lattice(), mpm.functions(), of,
                             [&](const auto& node) { all[static_cast<std::size_t>(node.index[0])] = node.weight; }));
        return all;
    };
    std::array<double, 5> stretched{}, at_place{};
    for (const auto p : std::as_const(one)) {
        stretched = weights_of(p);
        at_place = weights_of(point<1, double>(p[symbols::x]));
    }
    // From 0.05 left of the middle node, 0.4 of a side to each side of it; undeformed 0.25.
    CHECK(std::abs(stretched[3] - 0.2 * 0.2 / 1.6) < 1e-15);
    CHECK(std::abs(at_place[3] - 0.05 * 0.05) < 1e-15);
    const auto record = node_records(mpm.lattice(), mpm.functions(), bodies(std::as_const(one)));
    REQUIRE(record.size() == 3);
    for (const auto& node : record)
        CHECK(std::abs(node.mean.mass - 0.125 * stretched[static_cast<std::size_t>(node.index[0])]) < 1e-15);
    mpm.step(bodies(one), 1e-9);
    // Momentum over its weight is the velocity at every node, and the force that of the record.
    for (const auto& node : record) {
        const double a = mpm.on_node(field::acceleration{}, node.index)[0];
        CHECK(std::abs(a * node.mean.mass - node.internal_force[0]) < 1e-12 * std::abs(node.internal_force[0]));
    }
}
