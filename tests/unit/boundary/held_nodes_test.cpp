#include <tamis/boundary/held_nodes.hpp>
#include <tamis/core/names.hpp>
#include <tamis/shape/linear.hpp>

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

namespace {

using real = double;
constexpr real inverse_dt = 20;

template <int Dim> using place = point<Dim, real>;

template <int Dim> uniform_grid<Dim, real> box() {
    if constexpr (Dim == 1)
        return {{0.}, {2.}, 1.};
    else if constexpr (Dim == 2)
        return {{0., 0.}, {2., 2.}, 1.};
    else
        return {{0., 0., 0.}, {2., 2., 2.}, 1.};
}

/// Nodes of a box of two cells per axis, each of mass 3, and their conditions.
template <int Dim, class Boundary> struct scene {
    using S = space<Dim, real>;
    detail::lattice<S, linear> lattice{box<Dim>()};
    detail::node_table<S, fields<field::mass, field::momentum, field::velocity, field::force, field::increment>> nodes{
        lattice.size()};
    detail::held_nodes<S, linear, Boundary> held;

    explicit scene(const Boundary& boundary) : held(boundary, lattice) {
        for (std::size_t k = 0; k < lattice.size(); ++k) nodes.template at<field::mass>(k) = 3;
        held.attend(std::vector<char>(lattice.size(), 1));
    }
    void start(double t, double share = 1) {
        held.start_values(t);
        held.template take_masses<field::mass>(nodes);
        held.start(nodes, inverse_dt, share);
    }
    void forces(double t) {
        held.end_values(t);
        held.forces(nodes, inverse_dt);
        held.check_values();
    }
    template <class F> void put(F, std::size_t at, const place<Dim>& a) {
        for (int d = 0; d < Dim; ++d) nodes.template at<F>(at, d) = a[d];
    }
    template <class F> place<Dim> get(F, std::size_t at) const {
        place<Dim> a;
        for (int d = 0; d < Dim; ++d) a[d] = nodes.template at<F>(at, d);
        return a;
    }
};

const auto corner = [](const auto& at) { return at.norm() < 0.5; };
constexpr std::array<int, 3> corner_index{0, 0, 0};

/// What conditions that cannot all be met say, in steps to a time.
template <class... Boundary> std::string refusal(double end, const Boundary&... each) {
    return complaint([&] {
        scene<2, conditions<Boundary...>> s{conditions{each...}};
        for (double t = 0; t < end; t += 1 / inverse_dt) {
            s.start(t);
            s.forces(t + 1 / inverse_dt);
        }
    });
}

const auto value = [](double u, double w) { return [=](const auto&, auto t) { return place<2>(u + t, w - 2 * t); }; };

}  // namespace

TEST_CASE("held_nodes: momentum and force take the values of their times; reactions say what that took") {
    scene<2, prescribed<decltype(corner), decltype(value(1, 2))>> s{{corner, value(1, 2)}};
    const std::size_t at = s.lattice.node_place(corner_index), other = s.lattice.node_place({1, 0, 0});
    const place<2> p(0.5, -4), f(7, 11);
    s.put(symbols::mv, at, p);
    s.put(symbols::mv, other, p);
    s.start(0.25);
    const place<2> start = 3 * place<2>(1.25, 1.5), end = 3 * place<2>(1.3, 1.4);
    CHECK((s.get(symbols::mv, at) - start).norm() < 1e-15);
    CHECK(s.get(symbols::mv, other) == p);
    REQUIRE(s.held.reactions().size() == 1);
    CHECK(s.held.reactions()[0].at == place<2>(0, 0));
    CHECK((s.held.reactions()[0].reaction - (start - p) * inverse_dt).norm() < 1e-13);

    s.put(symbols::f, at, f);
    s.put(symbols::f, other, f);
    s.forces(0.3);
    CHECK((s.get(symbols::mv, at) + s.get(symbols::f, at) / inverse_dt - end).norm() < 1e-15);
    CHECK(s.get(symbols::f, other) == f);
    const place<2> reaction = (start - p) * inverse_dt + (end - start) * inverse_dt - f;
    CHECK((s.held.reactions()[0].reaction - reaction).norm() < 1e-12);
    CHECK((s.held.reactions()[0].velocity - place<2>(1.3, 1.4)).norm() < 1e-15);

    s.held.finish(1 / inverse_dt);
    const double work = reaction.dot(place<2>(1.25, 1.5) + place<2>(1.3, 1.4)) / 2 / inverse_dt;
    CHECK(std::abs(s.held.work() - work) < 1e-13);
}

TEST_CASE("held_nodes: only the share that particles feel counts as a reaction") {
    scene<2, prescribed<decltype(corner), decltype(value(1, 2))>> s{{corner, value(1, 2)}};
    const std::size_t at = s.lattice.node_place(corner_index);
    for (const double share : {0., 0.25}) {
        s.put(symbols::mv, at, place<2>(1, 1));
        s.start(0., share);
        CHECK((s.held.reactions()[0].reaction - share * place<2>(2, 5) * inverse_dt).norm() < 1e-14);
    }
}

TEST_CASE("held_nodes: forces carry on the momentum that the start left, whatever its column holds by then") {
    const place<2> n(0.6, 0.8), f(7, 11);
    const auto forces_with = [&](const place<2>& column) {
        scene<2, prescribed<decltype(corner), decltype(value(1, 2)), place<2>>> s{{corner, value(1, 2), n}};
        const std::size_t at = s.lattice.node_place(corner_index);
        s.put(symbols::mv, at, place<2>(5, 6));
        s.start(0.);
        const place<2> p = s.get(symbols::mv, at);
        s.put(symbols::v, at, column);
        s.put(symbols::f, at, f);
        s.forces(0.05);
        const place<2> end = p + s.get(symbols::f, at) / inverse_dt;
        CHECK(std::abs(end.dot(n) - 3 * place<2>(1.05, 1.9).dot(n)) < 1e-14);
        return s.get(symbols::f, at);
    };
    CHECK(forces_with(place<2>(1, 2)) == forces_with(place<2>(-40, 0.3)));
}

TEST_CASE("held_nodes: directions across the normal are free") {
    const place<2> n(0.6, 0.8), t(-0.8, 0.6);
    scene<2, slip<decltype(corner), place<2>>> s{{corner, n}};
    const std::size_t at = s.lattice.node_place(corner_index);
    s.put(symbols::mv, at, place<2>(5, 6));
    s.start(0.);
    const place<2> p = s.get(symbols::mv, at);
    CHECK(std::abs(p.dot(n)) < 4e-15);
    CHECK(std::abs(p.dot(t) - place<2>(5, 6).dot(t)) < 4e-15);
    s.put(symbols::f, at, place<2>(7, 8));
    s.forces(0.05);
    CHECK(std::abs(s.get(symbols::f, at).dot(n)) < 4e-14);
    CHECK(std::abs(s.get(symbols::f, at).dot(t) - place<2>(7, 8).dot(t)) < 4e-14);
}

TEST_CASE("held_nodes: held components of an increment go, from it and from its sum") {
    const place<2> n(0.6, 0.8);
    scene<2, slip<decltype(corner), place<2>>> s{{corner, n}};
    const std::size_t at = s.lattice.node_place(corner_index);
    s.start(0.);
    const place<2> before = s.held.reactions()[0].reaction;
    for (const bool counts : {false, true}) {
        s.put(symbols::dv, at, place<2>(1, 1));
        s.put(symbols::v, at, place<2>(3, 4));
        s.held.increment<field::increment, field::velocity>(s.nodes, inverse_dt, counts);
        CHECK((s.get(symbols::dv, at) - (place<2>(1, 1) - 1.4 * n)).norm() < 1e-15);
        CHECK((s.get(symbols::v, at) - (place<2>(3, 4) - 1.4 * n)).norm() < 1e-15);
        const place<2> added = s.held.reactions()[0].reaction - before;
        CHECK((added + (counts ? 1.4 * 3 * inverse_dt : 0) * n).norm() < 1e-12);
    }
}

TEST_CASE("held_nodes: several conditions at a node, with inclined normals, are all met") {
    const place<2> n(1, 0), k = place<2>(1, 1).normalized();
    const conditions inclined{prescribed{corner, value(1, 2), n}, prescribed{corner, value(5, -3), k}};
    scene<2, std::remove_const_t<decltype(inclined)>> s{inclined};
    const std::size_t at = s.lattice.node_place(corner_index);
    s.start(0.5);
    const place<2> u = s.get(symbols::mv, at) / 3;
    CHECK(std::abs(u.dot(n) - place<2>(1.5, 1).dot(n)) < 1e-15);
    CHECK(std::abs(u.dot(k) - place<2>(5.5, -4).dot(k)) < 1e-15);

    const auto give = [](double c) { return [c](const auto&, auto t) { return place<3>(c + t, c * c, -c * t); }; };
    const place<3> a = place<3>(1, 0, 0), b = place<3>(1, 2, 0).normalized(), c = place<3>(-1, 1, 3).normalized();
    const conditions three{prescribed{corner, give(1), a}, prescribed{corner, give(2), b},
                           prescribed{corner, give(3), c}};
    scene<3, std::remove_const_t<decltype(three)>> solid{three};
    const std::size_t there = solid.lattice.node_place(corner_index);
    solid.start(0.5);
    const place<3> w = solid.get(symbols::mv, there) / 3;
    CHECK(std::abs(w.dot(a) - give(1)(w, 0.5).dot(a)) < 1e-14);
    CHECK(std::abs(w.dot(b) - give(2)(w, 0.5).dot(b)) < 1e-14);
    CHECK(std::abs(w.dot(c) - give(3)(w, 0.5).dot(c)) < 1e-14);
    REQUIRE(solid.held.reactions().size() == 1);
    CHECK((solid.held.reactions()[0].velocity - w).norm() < 1e-14);
}

TEST_CASE("held_nodes: a condition that repeats another is no conflict") {
    CHECK(refusal(1, fixed{corner}, slip{everywhere, place<2>(1, 0)}) == "nothing");
    CHECK(refusal(1, prescribed{corner, value(1, 2)}, prescribed{corner, value(1, 5), place<2>(1, 0)}) == "nothing");
}

TEST_CASE("held_nodes: conditions that disagree are refused, with the node's place, the time and the difference") {
    const std::string text = refusal(0.01, fixed{corner}, prescribed{corner, value(0.5, 0), place<2>(1, 0)});
    CAPTURE(text);
    CHECK(names(text, "boundary conditions disagree", "node at (0, 0)", "t = 0.05", "0.55", "disjoint"));
    CHECK(names(
        refusal(0.01, prescribed{corner, value(0, 0), place<2>(1, 0)}, prescribed{corner, value(0, 0), place<2>(0, 1)},
                prescribed{corner, value(1, 0), place<2>(0.6, 0.8)}),
        "disagree", "0.6"));
}

TEST_CASE("held_nodes: conditions that come to disagree are refused then") {
    const auto late = [](const auto& at, auto t) { return place<2>(t > 0.52 ? at[0] + 1 : 0, 0); };
    CHECK(refusal(0.4, fixed{corner}, prescribed{corner, late}) == "nothing");
    CHECK(names(refusal(1, fixed{corner}, prescribed{corner, late}), "disagree", "t = 0.55"));
}

TEST_CASE("held_nodes: a normal that is no unit vector is refused, with the condition's number and its length") {
    const std::string text = refusal(0, fixed{corner}, slip{everywhere, place<2>(0, 2)});
    CAPTURE(text);
    CHECK(names(text, "boundary condition 1", "normal at (0, 0)", "length 2", "unit vector"));
    CHECK(names(refusal(0, slip{everywhere, place<2>(0, 0)}), "boundary condition 0", "length 0"));
    CHECK(names(refusal(0, slip{everywhere, place<2>(NAN, 0)}), "boundary condition 0", "length"));
}

TEST_CASE("held_nodes: nodes that no particle reaches take no part") {
    scene<1, fixed<decltype(everywhere)>> s{{everywhere}};
    std::vector<char> reached(s.lattice.size(), 1);
    const std::size_t off = s.lattice.node_place({1, 0, 0}), on = s.lattice.node_place({2, 0, 0});
    reached[off] = 0;
    s.held.attend(reached);
    for (const std::size_t at : {off, on}) s.put(symbols::mv, at, place<1>(5.));
    s.start(0.);
    CHECK(s.get(symbols::mv, off)[0] == 5);
    CHECK(s.get(symbols::mv, on)[0] == 0);
    REQUIRE(s.held.reactions().size() == 3);
    CHECK(s.held.reactions()[1].reaction[0] == 0);
    CHECK(s.held.reactions()[2].reaction[0] == -5 * inverse_dt);
}

TEST_CASE("held_nodes: a node without mass is left alone, and takes no reaction") {
    scene<1, fixed<decltype(everywhere)>> s{{everywhere}};
    const std::size_t at = s.lattice.node_place({1, 0, 0});
    s.nodes.at<field::mass>(at) = 1e-310;
    s.start(0.);
    s.put(symbols::f, at, place<1>(5.));
    s.forces(0.);
    CHECK(s.get(symbols::f, at)[0] == 5);
    CHECK(s.held.reactions()[1].reaction[0] == 0);
}

TEST_CASE("held_nodes: without conditions there is nothing") {
    scene<1, unbounded> s{{}};
    CHECK(s.held.reactions().empty());
    CHECK(s.held.work() == 0);
}
