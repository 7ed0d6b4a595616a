// The report of error against run time: what it concludes from runs, and that nothing measured is lost or run twice.
#include "report/analysis.hpp"
#include "report/error_command.hpp"
#include "report/results_file.hpp"

#include <tamis/core/error.hpp>

#include "catch.hpp"
#include "scratch.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

namespace {

measurement run_of(double error, double seconds, int cells = 10) {
    measurement run;
    run.what.scene = "made_up";
    run.what.cells = cells;
    run.found = {error, error / 2, error, -1e-3, seconds, 100, 20};
    run.seconds_least = run.seconds_most = seconds;
    run.repeats = 3;
    return run;
}
measurement failed(const std::string& why) {
    measurement run = run_of(0, 0);
    run.failure = why;
    return run;
}

/// A scene of four runs that counts how often it is run.
report_scene counting(int& runs) {
    report_scene scene;
    scene.name = "made_up";
    add(scene.quick, scene.name, {{"linear"}, {{"flip", 0}}, {"usl-"}, {"held"}, {2}, {0.1, 0.2}, {10, 20}});
    scene.run = [&runs](const configuration& what) {
        ++runs;
        if (what.cells == 20 && what.courant == 0.2) throw tamis::error("it grew, beyond all\nbounds");
        return outcome{1. / what.cells, 0.5, 0.25, 0, 1, 1000, 20};
    };
    return scene;
}
const auto silent = [](std::size_t, std::size_t, double, const configuration&) {};

}  // namespace

TEST_CASE("report: the Pareto front is what no run beats in error and time") {
    const std::vector<measurement> runs{run_of(1e-2, 1),   run_of(1e-3, 5),  run_of(2e-3, 6),    run_of(1e-2, 0.5),
                                        run_of(5e-2, 0.5), run_of(1e-4, 40), failed("unstable"), run_of(2, 0.01),
                                        run_of(1e-4, 40),  run_of(0.5, 0.1)};
    CHECK(pareto_front(runs) == std::vector<std::size_t>{9, 3, 1, 5});
    CHECK(pareto_front({failed("unstable")}).empty());
    CHECK(*fastest_within(runs, 1e-2) == 3);
    CHECK(*fastest_within(runs, 1e-3) == 1);
    CHECK(!fastest_within(runs, 1e-5));
}

TEST_CASE("report: the observed order is the slope over the resolutions") {
    std::vector<measurement> family;
    for (const int n : {10, 20, 40, 80}) family.push_back(run_of(3 * std::pow(n, -1.75), 1, n));
    family.push_back(failed("unstable"));
    CHECK_THAT(*observed_order(family), Catch::Matchers::WithinAbs(1.75, 1e-12));
    CHECK(!observed_order({family[0]}));
    CHECK(!observed_order({family[0], family[0]}));
    // Whoever has errors of 100 % at the coarse end has no order there.
    family.push_back(run_of(7, 1, 5));
    CHECK_THAT(*observed_order(family), Catch::Matchers::WithinAbs(1.75, 1e-12));
}

TEST_CASE("report: medians, families and names") {
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 3, 2}) == 2.5);
    std::vector<measurement> runs{run_of(1, 1, 10), run_of(1, 1, 20), run_of(1, 1, 40)};
    runs[1].what.courant = 0.5;
    const auto all = families(runs);
    REQUIRE(all.size() == 2);
    CHECK(all[0].size() == 2);
    configuration what = runs[0].what;
    what.update = "fmpm";
    what.order = 4;
    CHECK(what.composition() == "linear, FMPM(4), USL-, moving, 2 per cell, Courant 0.1");
}

TEST_CASE("report: a resumed run does what is missing, and only that") {
    const scratch_folder folder("error_report_resume");
    const auto file = folder / "errors.csv";
    int runs = 0;
    const report_scene scene = counting(runs);
    std::atomic<bool> stop{false};
    {
        results_file results(file, "a processor, a compiler", false);
        const bool complete =
            run_all({scene}, false, results, stop,
                    [&](std::size_t done, std::size_t, double, const configuration&) { stop = done == 1; });
        CHECK(!complete);
        CHECK(results.runs().size() == 2);
    }
    const int before = runs;
    stop = false;
    results_file results(file, "a processor, a compiler", true);
    CHECK(run_all({scene}, false, results, stop, silent));
    REQUIRE(results.runs().size() == 4);
    // Two more: one of a second, which is run twice, and one that fails at once.
    CHECK(runs == before + 3);
    const int whole = runs;
    CHECK(run_all({scene}, false, results, stop, silent));
    CHECK(runs == whole);
    CHECK(results.runs()[3].failure == "it grew, beyond all\nbounds");
}

TEST_CASE("report: the table comes back as it was written, and others are refused") {
    const scratch_folder folder("error_report_table");
    const auto file = folder / "errors.csv";
    {
        results_file results(file, "a processor, 2 cores", false);
        results.add(run_of(1.25e-3, 0.0123456789));
        measurement other = failed("too long a step, it says");
        other.what.update = "fmpm";
        other.what.order = 4;
        results.add(other);
        results.save();
    }
    const auto read = [&](const std::string& machine) { return results_file(file, machine, true).runs(); };
    const auto runs = read("a processor, 2 cores");
    REQUIRE(runs.size() == 2);
    CHECK(runs[0].what == run_of(1, 1).what);
    CHECK(runs[0].found.error == 1.25e-3);
    CHECK_THAT(runs[0].found.seconds, Catch::Matchers::WithinRel(0.0123456789, 1e-8));
    CHECK(runs[0].found.steps == 100);
    CHECK(runs[1].failure == "too long a step; it says");
    CHECK(runs[1].what.order == 4);

    const auto refused = [&](const std::string& machine, bool resume, const std::string& why) {
        try {
            results_file(file, machine, resume);
        } catch (const tamis::error& e) {
            CAPTURE(e.what());
            CHECK(std::string(e.what()).find(why) != std::string::npos);
            return;
        }
        FAIL("the table was taken, though " << why);
    };
    refused("a processor, 2 cores", false, "--resume");
    refused("another", true, "was measured on");
    std::ofstream(file, std::ios::app) << "made_up,linear,flip\n";
    refused("a processor, 2 cores", true, "line 4 has 3 cells");
    std::ofstream(file) << "something else\n";
    refused("a processor, 2 cores", true, "is not a table of this program");
}
