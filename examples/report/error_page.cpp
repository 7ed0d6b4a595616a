#include "error_page.hpp"

#include "analysis.hpp"
#include "error_plots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

constexpr double targets[] = {1e-2, 1e-3, 1e-4};

std::string number(const char* format, double value) {
    if (!std::isfinite(value)) return "-";
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}
/// 1.5e-3, without the zero that printf puts before a short exponent.
std::string short_exponent(std::string text) {
    const std::size_t e = text.find('e');
    if (e != std::string::npos && e + 2 < text.size() && text[e + 2] == '0') text.erase(e + 2, 1);
    return text;
}
std::string scientific(double value) { return short_exponent(number("%.1e", value)); }
std::string with_sign(double value) { return short_exponent(number("%+.1e", value)); }
/// Seconds with a unit that makes them easy to read.
std::string time(double seconds) {
    if (!std::isfinite(seconds)) return "-";
    if (seconds < 1e-3) return number("%.3g us", 1e6 * seconds);
    if (seconds < 1) return number("%.3g ms", 1e3 * seconds);
    return number("%.3g s", seconds);
}
std::string target_title(double target) { return short_exponent(number("%.0e", target)); }

std::vector<measurement> of_scene(const std::vector<measurement>& runs, const std::string& name) {
    std::vector<measurement> all;
    for (const measurement& run : runs)
        if (run.what.scene == name) all.push_back(run);
    return all;
}
std::vector<measurement> of_admpm(const std::vector<measurement>& runs) {
    std::vector<measurement> all;
    std::copy_if(runs.begin(), runs.end(), std::back_inserter(all),
                 [](const measurement& run) { return is_admpm(run.what); });
    return all;
}
double least_error(const std::vector<measurement>& runs) {
    double least = INFINITY;
    for (const measurement& run : runs)
        if (run.has_answer()) least = std::min(least, run.found.error);
    return least;
}

const std::vector<std::string> run_columns{"composition",          "cells", "error", "run time", "spread", "steps",
                                           "ns per particle-step", "energy"};
std::vector<std::string> row_of(const measurement& run) {
    return {run.what.composition(),
            std::to_string(run.what.cells),
            scientific(run.found.error),
            time(run.found.seconds),
            number("%.0f %%", 100 * run.spread()),
            std::to_string(run.found.steps),
            number("%.2f", run.ns_per_particle_step()),
            with_sign(run.found.energy_error)};
}

page::table_of best_table(const std::vector<measurement>& runs) {
    page::table_of best;
    best.caption = "The fastest run for a given error, and ADMPM's own way beside it.";
    best.columns = {"error at most", "fastest composition", "cells",        "error",
                    "run time",      "ADMPM's way",         "times as long"};
    best.numbers_from = 2;
    const auto admpm = of_admpm(runs);
    for (const double target : targets) {
        std::vector<std::string> row{target_title(target)};
        const auto k = fastest_within(runs, target);
        if (k) {
            const measurement& run = runs[*k];
            row.insert(row.end(), {run.what.composition(), std::to_string(run.what.cells), scientific(run.found.error),
                                   time(run.found.seconds)});
        } else
            row.insert(row.end(), {"none of these runs; least error " + scientific(least_error(runs)), "", "", ""});
        const auto old = fastest_within(admpm, target);
        if (admpm.empty())
            row.insert(row.end(), {"not run", ""});
        else if (old)
            row.insert(row.end(), {time(admpm[*old].found.seconds),
                                   k ? number("%.3g", admpm[*old].found.seconds / runs[*k].found.seconds) : ""});
        else
            row.insert(row.end(), {"not reached; least " + scientific(least_error(admpm)), ""});
        best.rows.push_back(row);
    }
    return best;
}

page::table_of orders_table(const report_scene& scene, const std::vector<measurement>& runs) {
    page::table_of table;
    table.columns = {"composition", "observed order",  "finest",
                     "error",       scene.velocity_is, scene.other_is,
                     "energy",      "run time",        "ns per particle-step"};
    table.caption =
        "Observed order (slope of log error over log cells, all resolutions with an error below 1), and the finest "
        "grid's "
        "errors. Energy: relative to the exact one.";
    for (const auto& family : families(runs)) {
        if (!scene.shown(family.front().what)) continue;
        const measurement* finest = nullptr;
        for (const measurement& run : family)
            if (run.has_answer() && (finest == nullptr || run.what.cells > finest->what.cells)) finest = &run;
        const auto order = observed_order(family);
        if (finest == nullptr) {
            table.rows.push_back(
                {family.front().what.composition(), "no run has an answer", "", "", "", "", "", "", ""});
            continue;
        }
        table.rows.push_back({finest->what.composition(), order ? number("%.2f", *order) : "-",
                              std::to_string(finest->what.cells), scientific(finest->found.error),
                              scientific(finest->found.error_velocity), scientific(finest->found.error_other),
                              with_sign(finest->found.energy_error), time(finest->found.seconds),
                              number("%.2f", finest->ns_per_particle_step())});
    }
    return table;
}

/// Of all scenes: which composition to take for which error.
page::table_of overview(const std::vector<report_scene>& scenes, const std::vector<measurement>& runs) {
    page::table_of table;
    table.columns = {"scene"};
    for (const double target : targets) table.columns.push_back("fastest for " + target_title(target));
    table.numbers_from = 4;
    for (const report_scene& scene : scenes) {
        const auto here = of_scene(runs, scene.name);
        if (here.empty()) continue;
        std::vector<std::string> row{scene.title};
        for (const double target : targets) {
            const auto k = fastest_within(here, target);
            if (!k) {
                row.push_back("none; least " + scientific(least_error(here)));
                continue;
            }
            const configuration& what = here[*k].what;
            row.push_back(time(here[*k].found.seconds) + ": " + what.shape + " " + update_title(what) + ", " +
                          std::to_string(what.cells) + " cells, " + what.particles);
        }
        table.rows.push_back(row);
    }
    return table;
}

}  // namespace

page error_page(const std::vector<report_scene>& scenes, const std::vector<measurement>& runs,
                const std::vector<std::vector<std::string>>& facts, bool complete) {
    page report("Tamis: error against run time");
    report.paragraph(
        "The Material Point Method moves particles through a grid. How it is put together (the grid's functions, how "
        "particles take their velocities from the grid, when they are strained) decides both how wrong an answer is "
        "and "
        "how long it takes. Here each scene has an exact answer, and is run by many compositions and resolutions; "
        "every "
        "run is a point with its error and its run time.");
    if (!complete)
        report.paragraph("This report was interrupted: it holds the runs that were done. `--resume` does the others.");
    report.facts(facts);
    std::vector<double> spreads;
    for (const measurement& run : runs)
        if (run.has_answer() && run.repeats > 1 && run.found.seconds > 0) spreads.push_back(run.spread());
    if (!spreads.empty()) {
        const double half = median(spreads);
        report.paragraph(
            "Half of the run times spread by less than " + number("%.0f %%", 100 * half) +
            (half > 0.2 ? ": the machine was busy with other work, so trust the errors and not the times." : "."));
    }
    report.heading("What to take");
    report.paragraph(
        "The fastest of all measured runs whose error is at most the one asked for. Run times are those of the "
        "stepping, "
        "on one core, without setting up.");
    report.table(overview(scenes, runs));
    report.heading("How to read it", 3);
    report.list({
        "In the first picture of a scene, left and low is better. Colours are updates, markers are shape functions. No "
        "other run is both faster and more accurate than one on the grey line, the Pareto front.",
        "The second picture has the error over the number of cells, for some of the compositions, all else the same.",
        "FLIP adds the grid's change of velocity to the particles; FMPM(k) and XPIC(k) replace it, with k terms of the "
        "full mass matrix's inverse. USL-, USAVG- and so on say when in a step particles are strained. Held particles "
        "stay where they are; moving ones follow the material.",
        "ADMPM's way is that of Perez 2021: linear functions, FLIP, lumped mass, and stress and strain by explicit "
        "Euler, "
        "whose energy grows at every step size.",
        "Times are medians of repeats; spread is their largest less their smallest, over the median.",
    });
    for (const report_scene& scene : scenes) {
        const auto here = of_scene(runs, scene.name);
        if (here.empty()) continue;
        report.heading(scene.title).paragraph(scene.about).paragraph(scene.error_is);
        report.figures(
            {{work_precision_svg(here), "Error against run time, all " + std::to_string(here.size()) +
                                            " runs. The grey line is the front that no run beats" +
                                            (of_admpm(here).empty() ? "." : "; crosses are ADMPM's way.")},
             {convergence_svg(scene, here),
              "Error over the number of cells (k above 2 dashed). Dotted lines show first and second order."}});
        report.table(best_table(here));
        page::table_of front{run_columns, {}, "The Pareto front, from the smallest error.", 1};
        auto order = pareto_front(here);
        for (auto k = order.rbegin(); k != order.rend(); ++k) front.rows.push_back(row_of(here[*k]));
        report.table(front);
        report.table(orders_table(scene, here));
        std::size_t failed = 0, wrong = 0;
        for (const measurement& run : here) {
            if (!run.has_answer())
                ++failed;
            else if (!(run.found.error < 1))
                ++wrong;
        }
        if (failed + wrong > 0)
            report.paragraph(
                std::to_string(failed) + " runs stopped with an error and " + std::to_string(wrong) +
                " were wrong by 100 % or more (unstable, or too coarse): they are in `errors.csv`, not in the "
                "pictures.");
    }
    return report;
}
