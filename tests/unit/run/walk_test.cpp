#include <tamis/tamis.hpp>

#include <map>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
    static constexpr std::string_view unit = "K";
};
struct heat_flow : vector_field {
    static constexpr std::string_view name = "heat_flow";
};
struct out_of_plane : symmetric_3x3_field {
    static constexpr std::string_view name = "out_of_plane";
};
const linear_elastic law{.young = 1, .poisson = 0.2, .density = 1};

const auto pull = traction{[](const auto& at) { return at[0] > 0.9; },
                           [](const auto&, const auto&, double) { return point<2, double>(1, 0); }};

/// What the walk tells of a body: "name[components] unit: component, component"
template <class Body> std::vector<std::string> told(const Body& body) {
    std::vector<std::string> all;
    each_stored_field(body, [&](auto field) {
        std::string one = std::string(field.name) + '[' + std::to_string(field.components) + "] " + field.unit() + ':';
        for (int c = 0; c < field.components; ++c) one += ' ' + field.component(c);
        all.push_back(one);
    });
    return all;
}

}  // namespace

TEST_CASE("walk: every stored field with its name, components and unit, in the order of storage") {
    solver line{uniform_grid{{0.}, {1.}, 0.25}, linear{}, flip{}};
    CHECK(told(line.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{1},
                              fields<out_of_plane>{})) ==
          std::vector<std::string>{"position[1] m: ", "mass[1] kg: ", "velocity[1] m/s: ", "volume[1] m: ",
                                   "stress[1] Pa: ", "out_of_plane[3] : xx yy zz"});
    solver plane{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, linear{}, flip{}, pull};
    CHECK(told(plane.make_body(
              law, everywhere, per_cell{1},
              fields<temperature, heat_flow, field::density, field::deformation, field::id, field::volume>{})) ==
          std::vector<std::string>{"position[2] m: x y", "mass[1] kg: ", "velocity[2] m/s: x y",
                                   "volume[1] m^2: ", "stress[3] Pa: xx yy xy", "faces[4] : 0 1 2 3",
                                   "temperature[1] K: ", "heat_flow[2] : x y",
                                   "density[1] kg/m^2: ", "deformation[4] 1: xx xy yx yy", "id[1] : "});
    solver box{uniform_grid{{0.f, 0.f, 0.f}, {1.f, 1.f, 1.f}, 0.25f}, quadratic_spline{}, pic{}, held{}};
    CHECK(told(box.make_body(law, everywhere, per_cell{1}, fields<field::deformation, out_of_plane>{})) ==
          std::vector<std::string>{"position[3] m: x y z", "mass[1] kg: ", "velocity[3] m/s: x y z", "volume[1] m^3: ",
                                   "stress[6] Pa: xx yy zz xy xz yz", "deformation[9] 1: xx xy xz yx yy yz zx zy zz",
                                   "out_of_plane[6] : xx yy zz xy xz yz"});
}

TEST_CASE("walk: values are those of the particle, under the names of their columns") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, linear{}, flip{}, pull};
    auto block =
        mpm.make_body(law, everywhere, per_cell{1}, fields<temperature, heat_flow, field::deformation, out_of_plane>{});
    double k = 0;
    for (auto p : block) {
        k += 1;
        p[temperature{}] = 10 * k;
        p[heat_flow{}] << 11 * k, 12 * k;
        p[sigma] = (matrix<2, double>() << 13 * k, 14 * k, 14 * k, 15 * k).finished();
        p[F] << 16 * k, 17 * k, 18 * k, 19 * k;
        p[out_of_plane{}] = (matrix<3, double>() << 20 * k, 23 * k, 0, 23 * k, 21 * k, 0, 0, 0, 22 * k).finished();
    }
    k = 0;
    int faces = 0;
    for (const auto p : std::as_const(block)) {
        k += 1;
        std::map<std::string, double> all;
        each_stored_field(block, [&](auto field) {
            const auto values = field.values(p);
            STATIC_REQUIRE(values.size() == static_cast<std::size_t>(field.components));
            for (int c = 0; c < field.components; ++c) all[field.column(c)] = values[static_cast<std::size_t>(c)];
        });
        CHECK(all.at("position_x") == p[x][0]);
        CHECK(all.at("position_y") == p[x][1]);
        CHECK(all.at("mass") == p[m]);
        CHECK(all.at("temperature") == 10 * k);
        CHECK(all.at("heat_flow_x") == 11 * k);
        CHECK(all.at("heat_flow_y") == 12 * k);
        CHECK(all.at("stress_xx") == 13 * k);
        CHECK(all.at("stress_xy") == 14 * k);
        CHECK(all.at("stress_yy") == 15 * k);
        CHECK(all.at("deformation_xx") == 16 * k);
        CHECK(all.at("deformation_xy") == 17 * k);
        CHECK(all.at("deformation_yx") == 18 * k);
        CHECK(all.at("deformation_yy") == 19 * k);
        CHECK(all.at("out_of_plane_xx") == 20 * k);
        CHECK(all.at("out_of_plane_yy") == 21 * k);
        CHECK(all.at("out_of_plane_zz") == 22 * k);
        CHECK(all.at("out_of_plane_xy") == 23 * k);
        // The upper side of x, 1/4 long, where the traction acts.
        CHECK(all.at("faces_1") == (p[x][0] > 0.8 ? 0.25 : 0));
        faces += all.at("faces_1") > 0 ? 1 : 0;
    }
    CHECK(faces == 4);
}

TEST_CASE("walk: held particles have a place, and no weights") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, cubic_spline{}, flip{}, held{}};
    const auto block = mpm.make_body(law, everywhere, per_cell{2});
    for (const auto p : block)
        each_stored_field(block, [&](auto field) {
            CHECK(field.name != "weights");
            if constexpr (std::same_as<typename decltype(field)::field_type, field::position>) {
                CHECK(field.values(p)[0] == p[x][0]);
                CHECK(field.values(p)[1] == p[x][1]);
            }
        });
}
