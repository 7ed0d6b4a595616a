#include <tamis/tamis.hpp>

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0, .density = 2};

template <int D> uniform_grid<D, double> room() {
    if constexpr (D == 1)
        return {{0.}, {2.}, 0.25};
    else if constexpr (D == 2)
        return {{0., 0.}, {2., 2.}, 0.25};
    else
        return {{0., 0., 0.}, {2., 2., 2.}, 0.25};
}
/// The cube from 0.5 to 1.25.
constexpr auto cube = [](const auto& at) { return (at.array() > 0.5).all() && (at.array() < 1.25).all(); };

/// The loaded faces of a body: number, area, sum of the outward area vectors.
template <class Body> auto faces_of(const Body& body) {
    constexpr int D = Body::dim;
    struct {
        int count = 0;
        double area = 0;
        point<D, double> vector = point<D, double>::Zero();
    } all;
    for (const auto p : body)
        for (int k = 0; k < 2 * D; ++k) {
            const double area = p[field::faces<0>{}][k * p.W];
            all.count += area > 0 ? 1 : 0;
            all.area += area;
            all.vector[k / 2] += (k % 2 == 0 ? -1 : 1) * area;
        }
    return all;
}

template <int D, class Lanes> void pushes_a_side() {
    CAPTURE(D);
    const auto push = traction{[](const auto&, const auto& n) { return n[0] > 0.5; },
                               [](const auto& at, const auto& n, double t) {
                                   CHECK(std::abs(at[0] - 1.25) < 1e-12);
                                   CHECK(n[0] == 1);
                                   CHECK(t == 3);
                                   return (n * -4).eval();
                               }};
    solver mpm{room<D>(), push, Lanes{}};
    auto block = mpm.make_body(law, cube, per_cell{2});
    const auto faces = faces_of(std::as_const(block));
    CHECK(faces.count == std::pow(6, D - 1));
    const double area = std::pow(0.75, D - 1);
    CHECK(std::abs(faces.vector[0] - area) < 1e-14);
    mpm.start_at(3);
    mpm.step(bodies(block), 0.01);
    point<D, double> impulse = point<D, double>::Zero();
    impulse[0] = -4 * area * 0.01;
    CHECK((total_momentum(block) - impulse).norm() < 1e-15);
}

}  // namespace

TEMPLATE_TEST_CASE("traction: it pushes the side it names, in all dimensions", "", one_lane, native_lanes) {
    pushes_a_side<1, TestType>();
    pushes_a_side<2, TestType>();
    pushes_a_side<3, TestType>();
}

TEST_CASE("traction: pressure on the whole surface of any body adds up to nothing, and squeezes it") {
    const auto squeeze = traction{everywhere, [](const auto&, const auto& n, double) { return (-n).eval(); }};
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, 0.125}, squeeze};
    auto ring = mpm.make_body(
        law,
        [](const auto& at) {
            const double r = (at - point<2, double>(1, 1)).norm();
            return r < 0.7 && r > 0.3;
        },
        per_cell{3});
    CHECK(faces_of(std::as_const(ring)).vector.norm() < 1e-14);
    CHECK(faces_of(std::as_const(ring)).area > 8 * (0.7 + 0.3) * 0.9);
    mpm.step(bodies(ring), 0.01);
    CHECK(total_momentum(ring).norm() < 1e-16);
    CHECK(kinetic_energy(ring) > 0);
}

TEST_CASE("traction: points of any grid have their faces") {
    const auto squeeze = traction{everywhere, [](const auto&, const auto& n, double) { return (-n).eval(); }};
    solver mpm{uniform_grid{{0., 0.}, {2., 2.}, 0.125}, squeeze};
    std::vector<point<2, double>> points;
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 5; ++j) points.emplace_back(0.3 + 0.07 * i, 0.4 + 0.07 * j);
    const auto plate = mpm.make_body_at(law, points, 0.07 * 0.07);
    const auto faces = faces_of(plate);
    CHECK(faces.count == 24);
    CHECK(std::abs(faces.area - 24 * 0.07) < 1e-14);
}

TEST_CASE("traction: force and moment are those of the force at the face's centre") {
    const auto shear = traction{[](const auto&, const auto& n) { return n[0] > 0; },
                                [](const auto&, const auto&, double) { return point<2, double>(0.3, -2); }};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, quadratic_spline{}, one_lane{}, shear};
    using S = decltype(mpm)::S;
    auto one = mpm.make_body_at(law, {point<2, double>(0.93, 0.4)}, 0.01);
    const auto& store = std::as_const(one).store();
    const auto at = mpm.lattice().frame_of(store.tiles[0].at);
    const auto load = detail::loading_of<S, quadratic_spline>(mpm.load(), store.slots[0], at, 0);
    point<2, double> force = point<2, double>::Zero();
    matrix<2, double> moments = matrix<2, double>::Zero();
    each_near_node(mpm.lattice(), mpm.functions(), {0.93, 0.4}, [&](const auto& node) {
        const point<2, double> part = node.weight * load.force + load.couple * node.slope;
        force += part;
        moments += node.at * part.transpose();
    });
    const point<2, double> exact = 0.1 * point<2, double>(0.3, -2), face(0.98, 0.4);
    CHECK((force - exact).norm() < 1e-15);
    CHECK((moments - face * exact.transpose()).norm() < 1e-15);
}

TEST_CASE("traction: it follows its particles, and loses nothing where they cross nodes") {
    // A corner alone, in fast flight: its face runs ahead of it into cells where there is no particle.
    const auto push = traction{[](const auto&, const auto& n) { return n[0] > 0; },
                               [](const auto&, const auto&, double t) { return 1 + t; }};
    solver mpm{uniform_grid{{0.}, {4.}, 0.25}, linear{}, push};
    auto bar = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.5; }, per_cell{2});
    for (auto p : bar) p[v][0] = 3;
    double momentum = total_momentum(bar)[0];
    for (int k = 0; k < 60; ++k) {
        momentum += 0.01 * (1 + mpm.time());
        mpm.step(bodies(bar), 0.01);
        REQUIRE(std::abs(total_momentum(bar)[0] - momentum) < 1e-13);
    }
    CHECK(mpm.crossings() > 20);
}

TEMPLATE_TEST_CASE("particle force: chosen particles take it, and keep it where they go", "", one_lane, native_lanes) {
    const auto pull = particle_force{[](const auto& at) { return at[0] > 1.1; },
                                     [](const auto& at, double t) { return point<2, double>(0.5 + t, at[1]); }};
    solver mpm{room<2>(), pull, flip{}, TestType{}};
    auto block = mpm.make_body(law, cube, per_cell{2});
    int chosen = 0;
    for (const auto p : std::as_const(block)) chosen += p[field::chosen<0>{}] > 0 ? 1 : 0;
    CHECK(chosen == 6);
    for (int k = 0; k < 20; ++k) {
        point<2, double> momentum = total_momentum(block);
        for (const auto p : std::as_const(block))
            if (p[field::chosen<0>{}] > 0) momentum += 0.01 * point<2, double>(0.5 + mpm.time(), p[x][1]);
        mpm.step(bodies(block), 0.01);
        REQUIRE((total_momentum(block) - momentum).norm() < 1e-14);
    }
}

TEST_CASE("forces: a region without a particle or face is waited for, and named at the end of the run") {
    const auto nowhere = [](const auto&) { return false; };
    const auto run_with = [&](const auto& load) {
        solver mpm{room<2>(), load};
        mpm.when_warned(warnings_are::kept);
        auto block = mpm.make_body(law, cube, per_cell{2});
        integrate(mpm, bodies(block), {0, 0.01}, fixed_steps{1});
        REQUIRE(mpm.warnings().size() == 1);
        return mpm.warnings()[0];
    };
    const auto value = [](const auto& at, const auto&...) { return at; };
    CHECK(names(run_with(loads{gravity{point<2, double>(0, 1)}, traction{nowhere, value}}),
                "load 2, a traction, has no face in its region"));
    CHECK(names(run_with(particle_force{nowhere, value}), "load 1, a force on particles, has no particle"));
    // Another body may be the one that is loaded.
    solver mpm{room<2>(), traction{[](const auto& at) { return at[0] > 1.2 && at[0] < 1.3; }, value}};
    auto other = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.5; }, per_cell{2});
    auto block = mpm.make_body(law, cube, per_cell{2});
    CHECK(complaint([&] { mpm.step(bodies(other, block), 0.01); }) == "nothing");
}

namespace {

/// Points of a bar of 20 x 3 cells, in every cell 1 to 4 columns of them, or in strata at random, and their volumes.
struct uneven_points {
    std::vector<point<2, double>> at;
    std::vector<double> volume;
    explicit uneven_points(bool at_random) {
        unsigned state = 12345;
        const auto share = [&] { return (state = state * 1103515245u + 12345u) / 4294967296.; };
        const double h = 0.1;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 20; ++i) {
                const int n = at_random ? 2 : 1 + (i + 2 * j) % 4;
                for (int b = 0; b < 2; ++b)
                    for (int a = 0; a < n; ++a) {
                        const double r = at_random ? (a + share()) / n : (a + 0.5) / n,
                                     s = at_random ? (b + share()) / 2 : (b + 0.5) / 2;
                        at.push_back({(i + r) * h, (j + s) * h});
                        volume.push_back(h * h / (2 * n));
                    }
            }
    }
};

}  // namespace

TEST_CASE("traction: on uneven particles the areas of a side add up to its own") {
    const auto push = traction{[](const auto& at, const auto& n) { return n[0] > 0.5 && at[0] > 1.89; },
                               [](const auto&, const auto&, double) { return point<2, double>(5, 0); }};
    for (const bool at_random : {false, true}) {
        const uneven_points cloud(at_random);
        solver mpm{uniform_grid{{0., 0.}, {3., 0.3}, 0.1}, push};
        auto bar = mpm.make_body_at(law, cloud.at, cloud.volume);
        CHECK(std::abs(total_mass(bar) - 2 * 0.6) < 1e-12);
        CHECK(std::abs(faces_of(std::as_const(bar)).area - 0.3) < 1e-12);
        mpm.step(bodies(bar), 1e-4);
        CHECK(std::abs(total_momentum(bar)[0] / 1e-4 - 1.5) < 1e-9);
    }
}

TEST_CASE("traction: volumes that are set before the first step count, later ones do not") {
    const uneven_points cloud(false);
    solver mpm{uniform_grid{{0., 0.}, {3., 0.3}, 0.1},
               traction{[](const auto& at, const auto& n) { return n[0] > 0.5 && at[0] > 1.89; },
                        [](const auto&, const auto&, double) { return point<2, double>(5, 0); }}};
    auto bar = mpm.make_body_at(law, cloud.at, 0.1 * 0.1 / 4, fields<field::id>{});
    for (auto p : bar) {
        p[V] = cloud.volume[static_cast<std::size_t>(p[field::id{}])];
        p[m] = 2 * p[V];
    }
    mpm.step(bodies(bar), 1e-4);
    CHECK(std::abs(faces_of(std::as_const(bar)).area - 0.3) < 1e-12);
    for (auto p : bar) p[V] *= 1.1;
    mpm.step(bodies(bar), 1e-4);
    CHECK(std::abs(faces_of(std::as_const(bar)).area - 0.3) < 1e-12);
}

TEST_CASE("bodies of points take a volume and a density for each, and say what makes no sense") {
    solver mpm{room<2>()};
    const std::vector<point<2, double>> places{{0.3, 0.3}, {0.6, 0.3}, {0.9, 0.3}};
    const std::vector<double> volumes{1, 2, 3}, densities{4, 5, 6};
    auto both = mpm.make_body_at(law, places, volumes, densities, fields<field::id>{});
    for (const auto p : std::as_const(both)) {
        const auto k = static_cast<std::size_t>(p[field::id{}]);
        CHECK(p[V] == volumes[k]);
        CHECK(p[m] == volumes[k] * densities[k]);
    }
    auto one = mpm.make_body_at(law, places, 0.5, densities);
    CHECK(total_mass(one) == 7.5);
    CHECK(names(complaint([&] {
                    mpm.make_body_at(law, places, std::vector<double>{1, 2});
                }),
                "2 numbers are given as the particles' volume for 3 points"));
    CHECK(names(complaint([&] {
                    mpm.make_body_at(law, places, std::vector<double>{1, -2, 1});
                }),
                "volume is -2 at (0.6, 0.3)"));
    CHECK(names(complaint([&] { mpm.make_body_at(law, places, volumes, 0.); }), "density is 0"));
}

TEST_CASE("a load whose body comes later waits for it") {
    solver mpm{room<2>(), particle_force{[](const auto& at) { return at[0] > 1; },
                                         [](const auto&, double) { return point<2, double>(3, 0); }}};
    mpm.when_warned(warnings_are::kept);
    auto first = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.5 && at[1] < 0.5; }, per_cell{2});
    integrate(mpm, bodies(first), {0, 0.01}, fixed_steps{10});
    auto second = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1.25 && at[1] > 1; }, per_cell{2});
    integrate(mpm, bodies(first, second), {0.01, 0.02}, fixed_steps{10});
    std::size_t chosen = 0;
    for (const auto p : std::as_const(second)) chosen += p[field::chosen<0>{}] > 0 ? 1 : 0;
    CHECK(chosen > 0);
    CHECK(std::abs(total_momentum(second)[0] - 3 * static_cast<double>(chosen) * 0.01) < 1e-12);
    CHECK(mpm.idle_loads().empty());
}
