#include "report_scene.hpp"

#include <cmath>
#include <iterator>

double work_of(const report_scene& scene, const configuration& what) {
    return std::pow(what.cells, scene.dim + 1) * std::pow(what.per_cell, scene.dim) / what.courant *
           (1 + 0.4 * what.order);
}

void add(std::vector<configuration>& to, const std::string& scene, const sweep& all) {
    for (const auto& shape : all.shapes)
        for (const auto& [update, order] : all.updates)
            for (const auto& stress : all.stresses)
                for (const auto& boundary : all.boundaries)
                    for (const auto& particles : all.particles)
                        for (const int per_cell : all.per_cells)
                            for (const double courant : all.courants)
                                for (const int cells : all.cells)
                                    to.push_back({scene, shape, update, order, stress, boundary, particles, cells,
                                                  per_cell, courant});
}

void add_admpm(report_scene& scene, const std::vector<std::string>& particles, int per_cell,
               const std::vector<int>& cells, const std::vector<double>& courants) {
    for (auto* list : {&scene.quick, &scene.full})
        add(*list, scene.name, {{"linear"}, {{"flip", 0}}, {"euler"}, particles, {per_cell}, courants, cells});
}
