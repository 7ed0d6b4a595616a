#include "manufactured_run.hpp"

using namespace tamis;

const std::vector<manufactured::compiled>& manufactured::compiled_2d() {
    static const std::vector<compiled> all{
        {{"linear", "flip", "euler"}, run<2, linear, flip, euler>},
        {{"linear", "flip", "usl-"}, run<2, linear, flip, usl_minus>},
        {{"cpgimp", "flip", "usl-"}, run<2, cpgimp, flip, usl_minus>},
        {{"cpgimp", "fmpm", "usl-"}, run<2, cpgimp, fmpm<dynamic>, usl_minus>},
        {{"quadratic", "flip", "usl-"}, run<2, quadratic_spline, flip, usl_minus>},
        {{"quadratic", "xpic", "usl-"}, run<2, quadratic_spline, xpic<dynamic>, usl_minus>},
        {{"quadratic", "fmpm", "usl-"}, run<2, quadratic_spline, fmpm<dynamic>, usl_minus>},
        {{"cubic", "flip", "usl-"}, run<2, cubic_spline, flip, usl_minus>},
    };
    return all;
}
