#include "report_scene.hpp"

std::vector<report_scene> report_scenes() {
    std::vector<report_scene> all = bar_report_scenes();
    all.push_back(bi_material_report_scene());
    all.push_back(gas_wave_report_scene());
    all.push_back(shock_tube_report_scene());
    for (const char* profile : {"sine", "step"}) all.push_back(advection_report_scene(profile));
    all.push_back(manufactured_report_scene(2));
    all.push_back(manufactured_report_scene(3));
    return all;
}
