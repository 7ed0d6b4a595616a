#pragma once
#include "two_bars.hpp"

#include <cstddef>
#include <string>

/// Two bars that meet at 1/2, with the composition by names: shape linear or quadratic, update flip or fmpm (of
/// `order` terms), particles moving or held; USL-.
struct bi_material_options : two_bars {
    std::string shape = "quadratic", update = "flip", particles = "moving";
    int order = 2;
};
using bi_material_result = two_bars_result;
/// Throws `tamis::error` if the run fails.
bi_material_result run_bi_material(const bi_material_options& options);
