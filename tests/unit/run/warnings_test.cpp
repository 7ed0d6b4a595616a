#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "unit/complaint.hpp"

#include <string>
#include <vector>

using namespace tamis;

namespace {

using vec = point<2, double>;
const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
const uniform_grid<2, double> box{{0., 0.}, {2., 1.}, 0.25};

}  // namespace

TEST_CASE("warnings: a region that ends beyond the grid is told of, one without an end there is not") {
    const auto told = [](const auto& region) {
        solver mpm{box};
        mpm.when_warned(warnings_are::kept);
        auto body = mpm.make_body(law, region, per_cell{2});
        return mpm.warnings().empty() ? std::string("nothing") : mpm.warnings()[0];
    };
    CHECK(names(told([](const auto& at) { return (at - vec(1, 0.5)).norm() < 0.75; }), "beyond the grid"));
    CHECK(names(told([](const auto& at) { return at[0] > 1 && at[0] < 2.5; }), "beyond the grid, at (2.0"));
    CHECK(told([](const auto& at) { return at[0] < 1 && at[1] < 0.5; }) == "nothing");
    CHECK(told([](const auto& at) { return at[0] > 0 && at[0] < 2 && at[1] >= 0 && at[1] <= 1; }) == "nothing");
    CHECK(told([](const auto& at) { return (at - vec(1, 0.5)).norm() < 0.4; }) == "nothing");
    CHECK(told(everywhere) == "nothing");
    // A region need not know of places beyond the grid.
    CHECK(told([](const auto& at) {
              if (at[0] < 0 || at[0] > 2 || at[1] < 0 || at[1] > 1) throw std::out_of_range("no such voxel");
              return true;
          }) == "nothing");
}

TEST_CASE("warnings: conditions that hold no node are told of at the first step, each kind once") {
    const auto nowhere = slip{[](const auto& at) { return at[1] < -0.1; }, vec(0, 1)};
    const auto floor = slip{[](const auto& at) { return at[1] <= 0; }, vec(0, 1)};
    solver mpm{box, conditions{floor, nowhere}};
    std::vector<warning> told;
    auto body = mpm.make_body(
        law, [](const auto& at) { return at[0] < 1; }, per_cell{2});
    const auto listen = [&](const warning& one) { told.push_back(one); };
    integrate(mpm, bodies(body), {0, 0.01}, fixed_steps{2}, listen);
    integrate(mpm, bodies(body), {0.01, 0.02}, fixed_steps{2}, listen);
    REQUIRE(told.size() == 1);
    CHECK(told[0].kind == warning_kind::idle_condition);
    CHECK(names(told[0].sentence, "hold no node of the grid: 1"));
    CHECK(mpm.warnings() == std::vector<std::string>{told[0].sentence});
}

TEST_CASE("warnings: bodies that overlap are told of, neighbours are not") {
    const auto told = [](double from) {
        solver mpm{box};
        mpm.when_warned(warnings_are::kept);
        auto left = mpm.make_body(
            law, [](const auto& at) { return at[0] < 1; }, per_cell{2});
        std::vector<vec> places;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 8; ++j) places.push_back(vec(from + 0.125 * i, 0.0625 + 0.125 * j));
        auto right = mpm.make_body_at(law, places, 0.125 * 0.125);
        mpm.step(bodies(left, right), 1e-3);
        return mpm.warnings().empty() ? std::string("nothing") : mpm.warnings()[0];
    };
    CHECK(told(1.0625) == "nothing");
    CHECK(told(1.01) == "nothing");  // 0.07 apart
    CHECK(names(told(0.99), "bodies 0 and 1 overlap", "0.0525 apart"));
    CHECK(names(told(0.4375), "bodies 0 and 1 overlap", "0 apart"));
}

TEST_CASE("warnings: they are told to a listener, kept, or thrown") {
    const auto disk = [](const auto& at) { return (at - vec(1, 0.5)).norm() < 0.75; };
    solver strict{box};
    strict.when_warned(warnings_are::errors);
    CHECK(names(complaint([&] { strict.make_body(law, disk, per_cell{1}); }), "beyond the grid"));
    solver heard{box};
    std::vector<std::string> told;
    heard.when_warned([&](const warning& what) { told.push_back(what.sentence); });
    heard.make_body(law, disk, per_cell{1});
    heard.make_body(law, disk, per_cell{1});
    CHECK(told.size() == 1);
    CHECK(told == heard.warnings());
}
