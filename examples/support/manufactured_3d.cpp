#include "manufactured_run.hpp"

using namespace tamis;

const std::vector<manufactured::compiled>& manufactured::compiled_3d() {
    static const std::vector<compiled> all{
        {{"linear", "flip", "euler"}, run<3, linear, flip, euler>},
        {{"cpgimp", "flip", "usl-"}, run<3, cpgimp, flip, usl_minus>},
        {{"quadratic", "flip", "usl-"}, run<3, quadratic_spline, flip, usl_minus>},
        {{"quadratic", "fmpm", "usl-"}, run<3, quadratic_spline, fmpm<dynamic>, usl_minus>},
    };
    return all;
}
