#pragma once
#include "measurement.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

/// A scene with an exact answer, as the report runs it and tells of it.
struct report_scene {
    std::string name, title;
    /// For a reader who knows no code: what happens, and what the errors are.
    std::string about, error_is;
    /// Headings of the two parts of the error.
    std::string velocity_is = "velocity", other_is = "strain";
    /// Axes, and time in units of (domain/wave speed): they set how much work a run is.
    int dim = 1;
    std::vector<configuration> quick, full;
    std::function<outcome(const configuration&)> run;
    /// Families whose lines are drawn over the number of cells, and whose errors are told in a table.
    std::function<bool(const configuration&)> shown;
};

/// Particles times steps, up to a factor that is the scene's.
double work_of(const report_scene& scene, const configuration& what);

/// All combinations of what is listed.
struct sweep {
    std::vector<std::string> shapes;
    std::vector<std::pair<std::string, int>> updates;
    std::vector<std::string> stresses, particles;
    std::vector<int> per_cells;
    std::vector<double> courants;
    std::vector<int> cells;
    std::vector<std::string> boundaries = {"incremental"};
};
void add(std::vector<configuration>& to, const std::string& scene, const sweep& all);
/// ADMPM's own way to both lists. Its steps are much smaller than others', for its energy grows with every one.
void add_admpm(report_scene& scene, const std::vector<std::string>& particles, int per_cell,
               const std::vector<int>& cells, const std::vector<double>& courants = {0.1, 0.01, 0.001});

/// Each in a file of its own.
std::vector<report_scene> bar_report_scenes();
report_scene bi_material_report_scene();
report_scene gas_wave_report_scene();
report_scene shock_tube_report_scene();
/// Of a "sine" or a "step".
report_scene advection_report_scene(const std::string& profile);
report_scene manufactured_report_scene(int dim);
/// All of them, in the report's order.
std::vector<report_scene> report_scenes();
