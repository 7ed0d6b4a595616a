#include "stability_command.hpp"

#include "extreme_cases.hpp"
#include "page.hpp"
#include "provenance.hpp"
#include "stability_map.hpp"

#include <tamis/core/error.hpp>
#include <tamis/observe/atomic_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

namespace {

struct stability_options {
    bool quick = false, full = false;
    std::string out;
};

std::string fixed_number(double value, int digits = 3) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}
std::string quoted(std::string text) {
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return '"' + text + '"';
}

void write_tables(const std::filesystem::path& folder, const std::vector<map_row>& map,
                  const std::vector<run_check>& runs, const std::vector<extreme_outcome>& cases) {
    tamis::atomic_file map_file(folder / "stability_map.csv"), runs_file(folder / "stability_runs.csv"),
        cases_file(folder / "extreme_cases.csv");
    map_file.out() << "shape,stress,update,k,per_cell,inner,free_end\n";
    for (const auto& r : map)
        map_file.out() << r.shape << ',' << r.stress << ',' << r.update << ',' << r.k << ',' << r.per_cell << ','
                       << r.inner << ',' << r.free_end << '\n';
    runs_file.out() << "composition,per_cell,offset,by_eigenvalues,by_runs\n";
    for (const auto& r : runs)
        runs_file.out() << quoted(r.composition) << ',' << r.per_cell << ',' << r.offset << ',' << r.predicted << ','
                        << r.by_runs << '\n';
    cases_file.out() << "case,expected,observed,passed,why\n";
    for (const auto& c : cases)
        cases_file.out() << quoted(c.name) << ',' << quoted(c.expected) << ',' << quoted(c.observed) << ','
                         << (c.passed ? "yes" : "no") << ',' << quoted(c.why) << '\n';
    map_file.commit();
    runs_file.commit();
    cases_file.commit();
}

/// Colours over shape and stress order (rows) and update (columns).
std::string heat_map(const std::vector<map_row>& map, int per_cell, bool free_end) {
    std::vector<std::string> rows, columns;
    std::ostringstream data;
    const auto place = [](std::vector<std::string>& of, const std::string& name) {
        const auto at = std::find(of.begin(), of.end(), name);
        if (at != of.end()) return at - of.begin();
        of.push_back(name);
        return static_cast<std::ptrdiff_t>(of.size()) - 1;
    };
    for (const auto& r : map) {
        if (r.per_cell != per_cell || r.update == "xpic") continue;
        const auto y = place(rows, r.shape + ", " + r.stress);
        const auto x = place(columns, r.update == "flip" ? "FLIP" : std::to_string(r.k));
        const double value = free_end ? r.free_end : r.inner;
        data << x << ' ' << -y << ' ' << value << ' ' << fixed_number(value, 2) << '\n';
    }
    std::ostringstream script;
    script << "unset key\nset xtics rotate by 0 (";
    for (std::size_t k = 0; k < columns.size(); ++k) script << (k ? "," : "") << '"' << columns[k] << "\" " << k;
    script << ")\nset ytics (";
    for (std::size_t k = 0; k < rows.size(); ++k)
        script << (k ? "," : "") << '"' << rows[k] << "\" " << -static_cast<int>(k);
    script << ")\nset tics scale 0\nset xlabel 'k of FMPM(k)'\nset cbrange [0:1.4]\nunset colorbox\n"
              "set palette defined (0 '#b2182b', 0.35 '#f4a582', 0.7 '#f7f7f7', 1.4 '#4393c3')\n"
              "set xrange [-0.5:"
           << static_cast<double>(columns.size()) - 0.5 << "]\nset yrange [" << 0.5 - static_cast<double>(rows.size())
           << ":0.5]\n$d << EOD\n"
           << data.str() << "EOD\nplot $d using 1:2:3 with image pixels, $d using 1:2:4 with labels font ',15'\n";
    return svg_by_gnuplot(script.str(), {640, 420});
}

std::string runs_plot(const std::vector<run_check>& runs) {
    std::ostringstream script;
    script << "set key top left\nset xlabel 'by eigenvalues'\nset ylabel 'by runs'\nset size square\n"
              "set xrange [0:2.1]\nset yrange [0:2.1]\n$d << EOD\n";
    for (const auto& r : runs) script << r.predicted << ' ' << r.by_runs << '\n';
    script << "EOD\nplot x with lines lc '#999999' title 'equal', $d with points pt 7 ps 0.6 lc '#0072b2' title "
              "'compositions'\n";
    return svg_by_gnuplot(script.str());
}

page stability_page(const std::vector<map_row>& map, const std::vector<run_check>& runs,
                    const std::vector<known_value>& known, const std::vector<cure>& cures,
                    const std::vector<extreme_outcome>& cases, const std::string& command) {
    page report("How large a step may be, and what happens at the edge");
    report.paragraph(
        "Explicit time steps are stable up to a limit: the Courant number c dt/h, with wave speed c, step dt and cell "
        "size h, must stay below it, or the smallest disturbance grows until the numbers mean nothing. The limit "
        "depends on every part of a method: shape functions, update (FLIP, XPIC(k), FMPM(k)), stress order, particles "
        "per cell, and where the particles are in their cells. This report gives it for each, checks it by runs, and "
        "then tries cases that often break such programs.");
    report.facts(provenance(command));

    report.heading("The map");
    report.paragraph(
        "Each number is the Courant number up to which nothing grows at the worst place of the particles in their "
        "cells. It comes from the method itself: the library steps a bar with every particle disturbed by one, which "
        "is the step's matrix; its eigenvalues say what grows. Inside a body this is done wave by wave. The library "
        "ships the table, takes 0.9 of it for automatic steps, refuses steps beyond the inner limit, and warns between "
        "the two. Stress orders `usl+` and `usavg+` have the numbers of `usf`.");
    report.figures(
        {{heat_map(map, 2, false), "Inside a body, 2 particles per cell."},
         {heat_map(map, 2, true),
          "Where a body ends free. With linear functions and usl- or usavg- there is no limit above zero: it "
          "falls with the root of the lightest node's mass. Shown for a hundredth of an inner node's."}});
    page::table_of table{
        {"shape", "stress", "update", "inside: 1 per cell", "2", "3", "4", "free end: 1", "2", "3", "4"},
        {},
        "All compositions.",
        3};
    for (std::size_t k = 0; k + 3 < map.size(); k += 4) {
        std::vector<std::string> row{map[k].shape, map[k].stress, map[k].update_title()};
        for (std::size_t n = 0; n < 4; ++n) row.push_back(fixed_number(map[k + n].inner));
        for (std::size_t n = 0; n < 4; ++n) row.push_back(fixed_number(map[k + n].free_end));
        table.rows.push_back(row);
    }

    report.heading("Known values");
    page::table_of values{{"composition", "theory", "exact", "found", "met"}, {}, "", 2};
    for (const auto& one : known)
        values.rows.push_back(
            {one.what, one.theory, fixed_number(one.exact), fixed_number(one.found), one.met() ? "yes" : "NO"});
    report.table(values);

    report.heading("The map against runs");
    double worst = 0;
    page::table_of checks{
        {"composition", "per cell", "offset", "by eigenvalues", "by runs", "difference (%)"}, {}, "", 1};
    for (const auto& r : runs) {
        const double off = 100 * (r.by_runs / r.predicted - 1);
        worst = std::max(worst, std::abs(off));
        checks.rows.push_back({r.composition, std::to_string(r.per_cell), short_number(r.offset),
                               fixed_number(r.predicted), fixed_number(r.by_runs), short_number(off)});
    }
    report.paragraph(
        "Free bars of 6 cells with a rough start, 4000 steps of plain numbers: does the energy grow 1e4-fold? "
        "Bisection to 0.4 %. Largest difference of " +
        std::to_string(runs.size()) + ": " + short_number(worst) +
        " %. Runs find a little more where growth is too slow for 4000 steps.");
    report.figures({{runs_plot(runs), "Critical Courant numbers by both ways."}});
    report.table(checks);

    report.heading("The weak spot");
    report.paragraph(
        "Where a body ends, a node beyond its last particle may have next to no mass. Linear functions push it with "
        "the "
        "full slope 1/h all the same, so its velocity is the particle's force over nearly nothing; USL- strains the "
        "particle by that velocity at once. A step multiplies the particle's stress by 1 - k C^2/(n s), n particles "
        "per cell, s the node's share of an inner node's mass, k the order: it grows beyond C^2 = 2 n s/k. Splines "
        "have "
        "slopes that fall with their values, and keep a limit: 1/sqrt(k) for quadratic ones, 0.71/sqrt(k) for GIMP "
        "with 2 per "
        "cell, which is why FMPM(16) failed at a Courant number of 0.2. The cure is to strain by velocities that "
        "particles had: "
        "`usl+`, `usavg+` or `usf`, which lose 0 to 17 % of their limit at free ends up to k = 4.");

    page::table_of orders{
        {"stress order", "critical number", "wave: velocity error", "strain error", "energy", "time of a step"},
        {},
        "FMPM(4), linear functions, 2 particles per cell. Critical number: free bar whose lightest node has 1e-4 of an "
        "inner "
        "one's mass. Wave: between held ends, 50 cells, at 2.25 s (period 2 s) with a Courant number of 0.1; errors "
        "over the "
        "amplitude. Time over that of usl-.",
        1};
    for (const auto& one : cures)
        orders.rows.push_back({one.stress, fixed_number(one.critical), short_number(one.velocity_error),
                               short_number(one.strain_error), short_number(one.energy_change),
                               short_number(one.time_ratio)});
    report.table(orders);

    report.heading("Extreme cases");
    const auto failed = std::count_if(cases.begin(), cases.end(), [](const auto& c) { return !c.passed; });
    report.paragraph(std::to_string(cases.size()) + " cases; " + std::to_string(failed) +
                     " did not do what must happen, and are told as failures.");
    page::table_of outcomes{{"case", "must happen", "happened", "", "why"}, {}, "", 5};
    for (const auto& c : cases) {
        if (!c.passed) outcomes.marked.push_back(outcomes.rows.size());
        outcomes.rows.push_back({c.name, c.expected, c.observed, c.passed ? "passed" : "FAILED", c.why});
    }
    report.table(outcomes);

    report.heading("All numbers");
    report.table(table);
    report.heading("What is not covered");
    report.list(
        {"Bodies that flow fast through their cells, large strains, viscosity and contact have limits of their own.",
         "In two and three dimensions waves along an axis decide, at the numbers of one dimension; checked wave by "
         "wave for linear and quadratic functions, with one exception (one particle per cell in 3D: 0.816 of it).",
         "Corners of free bodies in two and three dimensions have smaller numbers than the ends of a bar, by up to a "
         "fifth for "
         "squares of two cells and more than a quarter for cubes, the more the less compressible the body is "
         "(docs/stability.md).",
         "Own shapes and updates, explicit Euler, and exact mass matrices are not in the table: their limit is 1, "
         "which proves nothing."});
    return report;
}

int report_stability(const stability_options& o) {
    if (!has_gnuplot())
        throw tamis::error(
            "gnuplot draws the pictures of the report and is not installed; install it (Debian, Ubuntu: gnuplot-nox)");
    const std::filesystem::path folder(o.out);
    std::filesystem::create_directories(folder);
    const auto map = shipped_map();
    const auto known = known_values();
    const auto orders = cures();
    const auto runs = checks_by_runs(o.full, [](std::size_t done, std::size_t all, const std::string& what) {
        std::fprintf(stderr, "\r%zu of %zu: %-40s", done + 1, all, what.c_str());
    });
    std::vector<extreme_outcome> outcomes;
    for (const auto& one : extreme_cases()) {
        if (!one.quick && !o.full) continue;
        std::fprintf(stderr, "\r%-60s", one.name.c_str());
        try {
            outcomes.push_back(one.run());
        } catch (const std::exception& e) {
            outcomes.push_back({one.name, "an answer", e.what(), false, "It threw."});
        }
    }
    std::fprintf(stderr, "\r%-60s\r", "");
    write_tables(folder, map, runs, outcomes);
    const std::string command = std::string("tamis_report stability --") + (o.full ? "full" : "quick") + " --out DIR";
    stability_page(map, runs, known, orders, outcomes, command).write(folder / "stability.html");
    std::printf("%s\n", (folder / "stability.html").string().c_str());
    return 0;
}

}  // namespace

void add_stability_command(CLI::App& app, int& exit_code) {
    auto* command = app.add_subcommand("stability", "Critical Courant numbers by composition, and extreme cases");
    auto options = std::make_shared<stability_options>();
    auto* quick = command->add_flag("--quick", options->quick, "Less than a minute (default)");
    command->add_flag("--full", options->full, "All compositions and cases: some minutes")->excludes(quick);
    command->add_option("--out", options->out, "Folder for the page and its tables")->required();
    command->callback([options, &exit_code] {
        try {
            exit_code = report_stability(*options);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "tamis_report: %s\n", e.what());
            exit_code = 1;
        }
    });
}
