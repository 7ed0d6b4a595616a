#include "error_plots.hpp"

#include "analysis.hpp"
#include "page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace {

/// Errors from here on are no answer, and would take the room of the others.
constexpr double worst = 1;

bool can_be_drawn(const measurement& run) { return run.has_answer() && run.found.error > 0 && run.found.error < worst; }

/// Colours that the colour-blind can tell apart (Okabe & Ito 2008).
struct group {
    const char *title, *colour;
};
group group_of(const configuration& what) {
    if (is_admpm(what)) return {"ADMPM's way", "#000000"};
    if (what.update == "galerkin" && what.order == 0) return {"lumped mass", "#0072b2"};
    if (what.update == "galerkin") return {"full mass(k)", "#d55e00"};
    if (what.update == "flip") return {"FLIP", "#0072b2"};
    if (what.update == "fmpm") return {"FMPM(k)", "#d55e00"};
    if (what.update == "xpic") return {"XPIC(k)", "#009e73"};
    return {"others", "#999999"};
}
/// gnuplot's number of a filled marker.
struct marker {
    const char* title;
    int point;
};
marker marker_of(const configuration& what) {
    if (is_admpm(what)) return {"", 2};
    if (what.shape == "linear") return {"linear", 7};
    if (what.shape == "quadratic") return {"quadratic", 9};
    if (what.shape == "cubic") return {"cubic", 5};
    return {"GIMP", 13};
}

const char* const axes =
    "set logscale xy\nset format '10^{%T}'\nset grid xtics ytics lt 1 lw 0.6 lc rgb '#dddddd'\nset border lw 1.2\nset "
    "mxtics 1\nset mytics 1\n"
    "set ylabel 'relative error' offset 1,0\n";

/// The smallest powers of ten around all values.
std::string range_of(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    std::ostringstream all;
    all << "[1e" << std::floor(std::log10(*low) - 1e-9) << ":1e" << std::ceil(std::log10(*high) + 1e-9) << "]";
    return all.str();
}

}  // namespace

std::string work_precision_svg(const std::vector<measurement>& runs) {
    std::map<std::pair<std::string, int>, std::ostringstream> points;
    std::map<std::string, std::string> colours;
    std::map<std::string, int> markers;
    std::set<std::string> drawn;
    std::vector<double> errors;
    for (const measurement& run : runs) {
        if (!can_be_drawn(run)) continue;
        const group g = group_of(run.what);
        const marker m = marker_of(run.what);
        colours[g.title] = g.colour;
        if (*m.title != '\0') markers[m.title] = m.point;
        errors.push_back(run.found.error);
        // Points that would cover each other are drawn once.
        std::ostringstream place;
        place << g.title << m.point << ' ' << std::lround(std::log10(run.found.seconds) / 0.05) << ' '
              << std::lround(std::log10(run.found.error) / 0.05);
        if (!drawn.insert(place.str()).second) continue;
        points[{g.title, m.point}] << run.found.seconds << ' ' << run.found.error << '\n';
    }
    std::ostringstream script;
    script << axes << "set xlabel 'run time (s)'\nset key above horizontal maxrows 3 width -2 samplen 1\n";
    if (errors.empty()) {
        script << "set label 'no run has an error below 1' at graph 0.5,0.5 center\nset yrange [1e-4:1]\n"
               << "set xrange [1e-4:1]\nplot NaN notitle";
        return svg_by_gnuplot(script.str());
    }
    script << "set yrange " << range_of(errors) << '\n';
    int number = 0;
    std::ostringstream plots;
    for (const auto& [key, text] : points) {
        script << "$d" << number << " << EOD\n" << text.str() << "EOD\n";
        plots << (number > 0 ? ", " : "") << "$d" << number << " using 1:2 with points pt " << key.second << " ps "
              << (key.second == 2 ? 0.9 : 0.6) << " lw 1.5 lc rgb '" << colours[key.first] << "' notitle";
        ++number;
    }
    script << "$front << EOD\n";
    for (const std::size_t k : pareto_front(runs, worst))
        script << runs[k].found.seconds << ' ' << runs[k].found.error << '\n';
    script << "EOD\n";
    plots << ", $front using 1:2 with lines lw 2 lc rgb '#444444' title 'Pareto front'";
    plots << ", $front using 1:2 with points pt 6 ps 1.2 lw 1.5 lc rgb '#444444' notitle";
    for (const auto& [title, colour] : colours)
        plots << ", NaN with points pt " << (title == "ADMPM's way" ? 2 : 5) << " ps 1.2 lw 1.5 lc rgb '" << colour
              << "' title \"" << title << '"';
    for (const auto& [title, point] : markers)
        plots << ", NaN with points pt " << point << " ps 0.9 lc rgb '#777777' title '" << title << "'";
    script << "plot " << plots.str();
    return svg_by_gnuplot(script.str());
}

std::string convergence_svg(const report_scene& scene, const std::vector<measurement>& runs) {
    std::ostringstream script, plots;
    script << axes << "unset format x\nset xlabel 'cells along an axis'\n"
           << "set samples 2\nset key above horizontal maxrows 8 samplen 2 Left reverse\n";
    std::vector<double> errors;
    std::set<int> cells;
    int number = 0;
    double first = 0;
    for (const auto& family : families(runs)) {
        const configuration& what = family.front().what;
        if (!scene.shown(what)) continue;
        std::ostringstream data;
        for (const measurement& run : family) {
            cells.insert(run.what.cells);
            if (!can_be_drawn(run)) continue;
            data << run.what.cells << ' ' << run.found.error << '\n';
            errors.push_back(run.found.error);
        }
        if (data.str().empty()) continue;
        const group g = group_of(what);
        script << "$d" << number << " << EOD\n" << data.str() << "EOD\n";
        plots << (number > 0 ? ", " : "") << "$d" << number << " using 1:2 with linespoints pt "
              << marker_of(what).point << " ps 0.8 lw 1.5 dt " << (what.order > 2 ? 2 : 1) << " lc rgb '" << g.colour
              << "' title \"" << what.shape << ' ' << (is_admpm(what) ? "ADMPM's way" : update_title(what)) << '"';
        ++number;
    }
    if (errors.empty()) {
        script << "set label 'no run has an error below 1' at graph 0.5,0.5 center\nset yrange [1e-4:1]\n"
               << "set xrange [1:100]\nplot NaN notitle";
        return svg_by_gnuplot(script.str());
    }
    first = *std::max_element(errors.begin(), errors.end());
    script << "set yrange " << range_of(errors) << "\nset xrange [" << *cells.begin() / 1.2 << ':'
           << *cells.rbegin() * 1.2 << "]\nset xtics (";
    for (const int n : cells) script << (n == *cells.begin() ? "" : ",") << n;
    script << ")\n";
    plots << ", " << first << " * " << *cells.begin() << " / x with lines dt 3 lw 1.2 lc rgb '#888888' title 'order 1'"
          << ", " << first << " * (" << *cells.begin()
          << " / x)**2 with lines dt 4 lw 1.2 lc rgb '#888888' title 'order 2'";
    script << "plot " << plots.str();
    return svg_by_gnuplot(script.str(), {540, 520});
}
