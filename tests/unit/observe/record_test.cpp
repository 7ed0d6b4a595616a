#include <tamis/tamis.hpp>

#include "catch.hpp"

using namespace tamis;

TEST_CASE("density and strain come from the law, or from the fields where they are stored") {
    using namespace tamis::symbols;
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, linear{}, flip{}};
    const linear_elastic law{.young = 3, .poisson = 0.25, .density = 2};
    matrix<2, double> strain;
    strain << 0.01, 0.002, 0.002, -0.03;
    const auto strain_at = [&](const auto&) { return strain; };

    auto told = mpm.make_body(law, everywhere, per_cell{1});
    set_strain_of(told, strain_at);
    auto stored = mpm.make_body(law, everywhere, per_cell{1}, fields<field::density, field::strain>{});
    set_strain_of(stored, strain_at);
    auto deformed = mpm.make_body(law, everywhere, per_cell{1}, fields<field::deformation>{});
    for (auto p : deformed) p[F] = matrix<2, double>::Identity() * 2;

    const auto first = [](const auto& body) { return record_of(body, *body.begin()); };
    for (const auto& r : {first(std::as_const(told)), first(std::as_const(stored))}) {
        CHECK((r.strain - strain).norm() < 1e-15);
        CHECK(std::abs(r.density - 2 / 0.98) < 1e-14);
        CHECK(std::abs(r.mass - 2 / 16.) < 1e-15);
    }
    CHECK(std::abs(first(std::as_const(deformed)).density - 0.5) < 1e-15);
}

TEST_CASE("a node's record is the mass-weighted mean over the particles in its reach") {
    using namespace tamis::symbols;
    solver mpm{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}};
    auto bar = mpm.make_body_at(linear_elastic{.young = 1, .density = 1},
                                {point<1, double>(0.3), point<1, double>(0.45)}, 0.1);
    double next = 1;
    for (auto p : bar) {
        p[m] = p[x][0] < 0.4 ? 1 : 3;
        p[v][0] = next++;
        p[sigma](0, 0) = p[x][0] < 0.4 ? 0.5 : 0.25;
    }
    double speed_near = 0, speed_far = 0;
    for (const auto p : std::as_const(bar)) (p[x][0] < 0.4 ? speed_near : speed_far) = p[v][0];

    const auto nodes = node_records(mpm.lattice(), mpm.functions(), bodies(bar));
    REQUIRE(nodes.size() == 2);
    const double w_near = 0.8, w_far = 0.2;
    CHECK(nodes[0].index[0] == 1);
    CHECK(std::abs(nodes[0].mean.mass - (w_near * 1 + w_far * 3)) < 1e-14);
    CHECK(std::abs(nodes[0].mean.velocity[0] - (w_near * speed_near + w_far * 3 * speed_far) / (w_near + w_far * 3)) <
          1e-14);
    CHECK(std::abs(nodes[0].mean.stress(0, 0) - (w_near * 0.5 + w_far * 3 * 0.25) / (w_near + w_far * 3)) < 1e-14);
    CHECK(std::abs(nodes[0].internal_force[0] - (0.1 * 0.5 + 0.1 * 0.25) / 0.25) < 1e-14);
    CHECK(std::abs(nodes[1].internal_force[0] + nodes[0].internal_force[0]) < 1e-14);
    CHECK(nodes[1].mean.position[0] == 0.5);
}
