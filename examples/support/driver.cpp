#include "driver.hpp"
#include "report.hpp"

#include <tamis/observe/atomic_file.hpp>

#include <cstdio>
#include <exception>
#include <iostream>
#include <optional>

namespace {

void run(const bar_scene& scene, const bar_options& o) {
    std::optional<tamis::atomic_file> summary;
    try {
        if (!o.summary.empty()) summary.emplace(o.summary);
    } catch (const tamis::error& e) {
        throw bad_option(std::string("--summary: ") + e.what());
    }
    const bar_result result = run_bar(scene, o);
    check_measures(scene, o, result);
    print_table(std::cout, scene, o, result);
    if (summary) {
        summary->out() << summary_of(scene, o, result);
        summary->commit();
    }
    if (!std::cout.flush())
        throw tamis::error("the table could not be written to the standard output; is the disk full?");
}

}  // namespace

int run_scene(const bar_scene& scene, int argc, const char* const* argv) {
    const auto say = [&](const std::exception& e) { std::fprintf(stderr, "%s: %s\n", scene.name.c_str(), e.what()); };
    try {
        bar_options options(scene);
        if (read_options(options, scene, argc, argv)) run(scene, options);
        return 0;
    } catch (const bad_option& e) {
        say(e);
        return 2;
    } catch (const std::exception& e) {
        say(e);
        return 1;
    }
}
