// Points of the report's fronts, pinned by their errors (not by their times): what a composition gives for its
// resolution must not get worse unseen.
#include "report/report_scene.hpp"
#include "require.hpp"

#include <tamis/core/error.hpp>

#include "catch.hpp"

#include <algorithm>
#include <set>

namespace {

const std::vector<report_scene>& scenes() {
    static const std::vector<report_scene> all = report_scenes();
    return all;
}
double error_of(const configuration& what) {
    const auto scene =
        std::find_if(scenes().begin(), scenes().end(), [&](const report_scene& one) { return one.name == what.scene; });
    REQUIRE(scene != scenes().end());
    // The report runs it: a pinned point that is not in its list pins nothing.
    CAPTURE(what.scene, what.composition(), what.cells);
    CHECK(std::find(scene->quick.begin(), scene->quick.end(), what) != scene->quick.end());
    return scene->run(what).error;
}

}  // namespace

TEST_CASE("report: points of the fronts") {
    struct point {
        configuration what;
        double error;
    };
    const std::string usl = "usl-", imposed = "incremental";
    const point points[] = {
        {{"standing_wave", "quadratic", "fmpm", 2, usl, imposed, "held", 25, 2, 0.5}, 6.105e-4},
        {{"standing_wave", "quadratic", "fmpm", 4, usl, imposed, "held", 100, 2, 0.5}, 1.498e-5},
        {{"standing_wave", "linear", "flip", 0, usl, imposed, "held", 100, 2, 0.5}, 3.876e-4},
        {{"reflection", "linear", "fmpm", 2, usl, imposed, "held", 200, 2, 0.5}, 1.641e-2},
        {{"bi_material", "linear", "fmpm", 2, usl, imposed, "held", 400, 2, 0.5}, 1.029e-2},
        {{"gas_wave", "linear", "fmpm", 4, usl, imposed, "held", 75, 2, 0.5}, 7.087e-2},
        {{"advection_sine", "quadratic", "galerkin", 4, "-", imposed, "held", 50, 2, 0.25}, 1.377e-3},
        {{"manufactured_2d", "cpgimp", "fmpm", 2, usl, imposed, "moving", 16, 2, 0.2}, 1.402e-2},
    };
    for (const point& one : points) {
        CAPTURE(one.what.scene, one.what.composition(), one.what.cells);
        CHECK_THAT(error_of(one.what), Catch::Matchers::WithinRel(one.error, 0.01));
    }
}

TEST_CASE("report: every scene has runs in both modes, none of them twice") {
    CHECK(scenes().size() == 10);
    for (const report_scene& scene : scenes())
        for (const auto* list : {&scene.quick, &scene.full}) {
            CAPTURE(scene.name, list == &scene.full);
            std::vector<std::string> texts;
            for (const configuration& what : *list) texts.push_back(what.text());
            std::sort(texts.begin(), texts.end());
            CHECK(texts.size() >= 20);
            CHECK(std::adjacent_find(texts.begin(), texts.end()) == texts.end());
            CHECK(std::any_of(list->begin(), list->end(), [&](const configuration& c) { return scene.shown(c); }));
        }
}

TEST_CASE("report: every composition that it asks for is compiled") {
    for (const report_scene& scene : scenes()) {
        std::set<std::string> seen;
        for (const auto* list : {&scene.quick, &scene.full})
            for (configuration what : *list) {
                what.cells = scene.quick.front().cells;
                what.per_cell = 2;
                what.courant = 0.5;
                if (!seen.insert(what.text()).second) continue;
                CAPTURE(what.text());
                try {
                    // Not inside CHECK, which would take what is thrown for a failure.
                    const auto found = scene.run(what);
                    CHECK(found.steps > 0);
                } catch (const unusable_option& e) {
                    FAIL(e.what());
                } catch (const tamis::error&) {
                    // Some are unstable at half of the limit, which is an answer.
                }
            }
        CHECK(seen.size() >= 3);
    }
}
