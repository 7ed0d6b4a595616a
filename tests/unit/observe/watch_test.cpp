#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "scratch.hpp"

#include <limits>

using namespace tamis;
using namespace tamis::symbols;

TEST_CASE("a watch counts cell crossings between its reports") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{}};
    auto bar = mpm.make_body(
        linear_elastic{.young = 1e-6, .density = 1}, [](const auto& at) { return at[0] < 0.5; }, per_cell{1});
    set_velocity_of(bar, [](const auto&) { return 1.0; });
    std::vector<watch_report> reports;
    // From the middle of the cells all five particles cross at 0.05 s and 0.15 s.
    integrate(mpm, bodies(bar), {0, 0.18}, fixed_steps{18},
              every(9, watch(mpm, bodies(bar), [&](const watch_report& r) { reports.push_back(r); })));
    REQUIRE(reports.size() == 2);
    CHECK(reports[0].step == 9);
    CHECK(reports[1].step == 18);
    CHECK(reports[0].crossings == 5);
    CHECK(reports[1].crossings == 5);
    CHECK(reports[0].bad.empty());
}

TEST_CASE("a watch names particles that are not numbers") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{}, held{}};
    auto quiet = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] < 0.5; }, per_cell{1});
    auto loud = mpm.make_body(
        linear_elastic{.young = 1, .density = 1}, [](const auto& at) { return at[0] > 0.7; }, per_cell{1});
    for (auto p : loud)
        if (p[x][0] > 0.9) p[sigma](0, 0) = std::numeric_limits<double>::quiet_NaN();
    std::ostringstream out;
    watch look(mpm, bodies(quiet, loud), out);
    look(progress_state{7, 10, 0.25, {0, 1}});
    CHECK(out.str() == "step 7, t = 0.25: particle 2 of body 1 at (0.95): its stress is not a finite number\n");

    std::vector<watch_report> reports;
    watch tell(mpm, bodies(quiet, loud), [&](const watch_report& r) { reports.push_back(r); });
    tell(progress_state{7, 10, 0.25, {0, 1}});
    REQUIRE(reports.size() == 1);
    REQUIRE(reports[0].bad.size() == 1);
    CHECK(reports[0].bad[0].body == 1);
    CHECK(reports[0].bad[0].field == "stress");
}

TEST_CASE("a watch is silent when there is nothing to tell") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, flip{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{1});
    std::ostringstream out;
    integrate(mpm, bodies(bar), {0, 0.1}, fixed_steps{10}, watch(mpm, bodies(bar), out));
    CHECK(out.str().empty());
}
