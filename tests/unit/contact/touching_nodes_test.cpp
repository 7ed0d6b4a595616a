#include <tamis/contact/touching_nodes.hpp>
#include <tamis/shape/linear.hpp>

#include <array>
#include <cmath>
#include <utility>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using S = space<2, double>;
using vector = point<2, double>;
using table_type =
    detail::node_table<S, fields<field::mass, field::momentum, field::force, field::mass_gradient, field::mass_place>>;
constexpr double dt = 0.1;

/// Two bodies of masses 2 and 3 on one node, with their momenta.
template <class Contact> struct scene {
    detail::lattice<S, linear> lattice{uniform_grid{{0., 0.}, {2., 2.}, 0.5}};
    table_type first{lattice.size()}, second{lattice.size()};
    std::array<table_type*, 2> both{&first, &second};
    std::size_t at = lattice.node_place({1, 1, 0});
    detail::touching_nodes<S, linear, Contact> contact;

    scene(const Contact& policy, const vector& v1, const vector& v2) : contact(policy, lattice) {
        const auto block = static_cast<std::uint32_t>(at);
        for (auto* table : both) table->set_active({block});
        first.at<field::mass>(at) = 2;
        second.at<field::mass>(at) = 3;
        first.put<field::momentum>(at, 2 * v1);
        second.put<field::momentum>(at, 3 * v2);
        contact.find(both, [&](std::size_t f, std::size_t place) { return both[f]->template at<field::mass>(place); });
    }
    /// Velocity of the second relative to the first.
    vector relative() const { return second.get<field::momentum>(at) / 3 - first.get<field::momentum>(at) / 2; }
    vector total() const { return first.get<field::momentum>(at) + second.get<field::momentum>(at); }
};
const vector along_x(1, 0);

}  // namespace

TEST_CASE("contact laws: friction is a share of the pressure, and never more than sticking takes") {
    CHECK(coulomb{0.3}.tangential(2., 1.) == 0.6);
    CHECK(coulomb{0.3}.tangential(2., 0.25) == 0.25);
    CHECK(coulomb{0}.tangential(2., 1.) == 0);
    CHECK(frictionless{}.tangential(2., 1.) == 0);
    CHECK(bonded{}.tangential(2., 1.) == 1);
    CHECK(names(complaint([] { coulomb{-1}; }), "coulomb", "mu is -1", "0 or more"));
}

TEST_CASE("touching_nodes: bodies that approach slide with friction, whose heat is what the tangential motion loses") {
    const contact policy{coulomb{0.3}, given_normal{along_x}, by_approach{}};
    scene s(policy, vector(0, 0), vector(-1, 2));
    const vector before = s.total();
    s.contact.measure(s.both);
    s.contact.momentum<field::momentum>(s.both, 1, 1 / dt);
    CHECK((s.relative() - vector(0, 2 - 0.3)).norm() < 1e-15);
    CHECK((s.total() - before).norm() < 1e-15);
    const double reduced = 2 * 3 / 5.;
    CHECK(std::abs(s.contact.heat() - reduced * (2 * 2 - 1.7 * 1.7) / 2) < 1e-15);
    s.contact.restart();
    CHECK(s.contact.heat() == 0);
}

TEST_CASE("touching_nodes: bodies that part are left alone, and those that press lightly stick") {
    const contact policy{coulomb{0.3}, given_normal{along_x}, by_approach{}};
    scene parts(policy, vector(0, 0), vector(1, 2));
    parts.contact.measure(parts.both);
    parts.contact.momentum<field::momentum>(parts.both, 1, 1 / dt);
    CHECK(parts.relative() == vector(1, 2));
    CHECK(parts.contact.nodes().empty());
    scene sticks(policy, vector(0, 0), vector(-1, 0.2));
    sticks.contact.measure(sticks.both);
    sticks.contact.momentum<field::momentum>(sticks.both, 1, 1 / dt);
    CHECK(sticks.relative().norm() < 1e-15);
    CHECK(sticks.contact.heat() == 0);
}

TEST_CASE("touching_nodes: the force that is told is that of the start and of the end together") {
    const contact policy{frictionless{}, given_normal{along_x}, by_approach{}};
    scene s(policy, vector(0, 0), vector(-1, 2));
    s.contact.measure(s.both);
    const vector before = s.first.get<field::momentum>(s.at);
    s.contact.momentum<field::momentum>(s.both, 1, 1 / dt);
    s.first.put<field::force>(s.at, vector(4, 0));
    s.second.put<field::force>(s.at, vector(-6, 1));
    s.contact.forces(s.both, dt);
    const vector after = s.first.get<field::momentum>(s.at) + dt * s.first.get<field::force>(s.at);
    REQUIRE(s.contact.nodes().size() == 1);
    const auto node = s.contact.nodes()[0];
    CHECK((before + dt * (vector(4, 0) + node.force) - after).norm() < 1e-15);
    CHECK(node.at == vector(0.5, 0.5));
    CHECK(node.normal == along_x);
    CHECK(node.slides);
    const vector of_second = s.second.get<field::momentum>(s.at) + dt * s.second.get<field::force>(s.at);
    CHECK(std::abs(of_second[0] / 3 - after[0] / 2) < 1e-15);
}

TEST_CASE("touching_nodes: bodies whose particles are too far apart do not touch, approach or not") {
    for (const double distance : {0.39, 0.41}) {
        CAPTURE(distance);
        const contact policy{frictionless{}, given_normal{along_x}, by_separation{}};
        scene s(policy, vector(0, 0), vector(-1, 0));
        // Mean places; 0.8 of a cell is 0.4.
        s.first.put<field::mass_place>(s.at, 2 * vector(0.3, 0.5));
        s.second.put<field::mass_place>(s.at, 3 * vector(0.3 + distance, 0.9));
        s.contact.measure(s.both);
        CHECK(s.contact.any() == (distance < 0.4));
    }
}

TEST_CASE("touching_nodes: by their masses' gradients the normal goes from the first body to the second") {
    scene s(contact{frictionless{}, normal_by_mass{}, by_approach{}}, vector(0, 0), vector(-1, -1));
    s.first.put<field::mass_gradient>(s.at, vector(3, 0));
    s.second.put<field::mass_gradient>(s.at, vector(0, -4));
    s.contact.measure(s.both);
    s.contact.momentum<field::momentum>(s.both, 1, 1 / dt);
    REQUIRE(s.contact.nodes().size() == 1);
    const vector normal(0.6, 0.8);
    CHECK((s.contact.nodes()[0].normal - normal).norm() < 1e-15);
    CHECK(std::abs(s.relative().dot(normal)) < 1e-15);
    CHECK((s.relative() - (vector(-1, -1) + 1.4 * normal)).norm() < 1e-15);
}
