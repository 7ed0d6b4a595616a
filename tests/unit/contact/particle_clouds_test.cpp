// Clouds are the particles within reach of a node, in sides of a cell, with what they have become.
#include <tamis/tamis.hpp>

#include <cmath>
#include <set>
#include <utility>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;
constexpr double h = 0.1;
const uniform_grid<2, double> box{{-0.3, 0.2}, {1.1, 1.2}, h};
const auto left = [](const auto& at) { return at[0] < 0.4 && at[1] < 0.7; };
const auto right = [](const auto& at) { return at[0] > 0.4 && at[0] < 0.9 && at[1] < 0.8; };

template <class Solver, class... Body> void sees_all(const Solver& mpm, double reach, const Body&... bodies) {
    using lattice_type = std::remove_cvref_t<decltype(mpm.lattice())>;
    using shape = std::remove_cvref_t<decltype(mpm.functions())>;
    using S = typename std::tuple_element_t<0, std::tuple<Body...>>::space_type;
    const lattice_type& lattice = mpm.lattice();
    detail::particle_clouds<S, shape> clouds;
    for (int again = 0; again < 2; ++again) {
        const std::array<int, 3> nodes[] = {{6 + again, 2, 0}, {7, 5, 0}, {9, 4, 0}};
        clouds.begin(lattice, sizeof...(Body), reach);
        for (const auto& node : nodes) clouds.attend(lattice, lattice.node_place(node));
        clouds.end();
        std::size_t body = 0;
        (clouds.add(lattice, body++, bodies.store()), ...);
        for (const auto& node : nodes) {
            const place at = box.lower() + h * place(node[0], node[1]);
            body = 0;
            const auto check = [&](const auto& b) {
                std::multiset<std::pair<long, long>> expected, found;
                const auto add = [](auto& to, const auto& offset) {
                    to.insert({std::lround(1e6 * offset[0]), std::lround(1e6 * offset[1])});
                };
                for (const auto p : b) {
                    const place offset = (p[x] - at) / h;
                    if (offset.cwiseAbs().maxCoeff() < reach) add(expected, offset);
                }
                clouds.each(lattice, body++, lattice.node_place(node),
                            [&](const auto&, const auto& offset) { add(found, offset); });
                CHECK(found == expected);
            };
            (check(bodies), ...);
        }
    }
}

}  // namespace

TEST_CASE("particle_clouds: they hold the particles of each body near each node, and no others") {
    const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};
    solver moving{box};
    sees_all(moving, 1.62, moving.make_body(law, left, per_cell{3}), moving.make_body(law, right, per_cell{2}));
    solver at_rest{box, linear{}, held{}};
    sees_all(at_rest, 2.43, at_rest.make_body(law, left, per_cell{2}), at_rest.make_body(law, right, per_cell{3}));
}

TEST_CASE("particle_clouds: a particle reaches as far as its deformed domain does") {
    solver mpm{box};
    auto body = mpm.make_body(neo_hookean{.young = 1, .poisson = 0.3, .density = 1}, left, per_cell{2});
    const double turn = 0.4;
    matrix<2, double> rotation, stretch;
    rotation << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    stretch << 2, 0, 0, 0.5;
    for (auto p : body) p[F] = rotation * stretch;
    using S = decltype(body)::space_type;
    detail::particle_clouds<S, quadratic_spline> clouds;
    const std::size_t node = mpm.lattice().node_place({6, 2, 0});
    clouds.begin(mpm.lattice(), 1, 1.);
    clouds.attend(mpm.lattice(), node);
    clouds.end();
    clouds.add(mpm.lattice(), 0, std::as_const(body).store());
    int seen = 0;
    clouds.each(mpm.lattice(), 0, node, [&](const auto& p, const auto&) {
        ++seen;
        // Half a particle's side is a quarter of a cell's.
        CHECK(std::abs(p.extent(rotation.col(0)) - 0.5) < 1e-12);
        CHECK(std::abs(p.extent(rotation.col(1)) - 0.125) < 1e-12);
    });
    CHECK(seen > 4);
}
