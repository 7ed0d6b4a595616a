// Instructions of a FLIP step, for valgrind's callgrind (count_instructions.sh): of a 1D bar, held or moving, or of a
// 3D block, moving: instructions held|moving|block linear|quadratic <steps>.
#include <tamis/tamis.hpp>

#include "block.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

template <class Shape, class Motion> int run(long steps) {
    using namespace tamis;
    const auto ends = fixed{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    solver mpm{uniform_grid{{0.}, {1.}, 1. / 400}, Shape{}, flip{}, usl_minus{}, ends, Motion{}};
    auto bar = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    for (auto p : bar) p[symbols::v][0] = 1e-3 * (1 - p[symbols::x][0]);
    for (long k = 0; k < steps; ++k) mpm.step(bodies(bar), 1e-4);
    std::printf("%zu particles\n", bar.size());
    return 0;
}

template <class Shape> int run_block(long steps) {
    auto block = elastic_block<3, double>(12, Shape{}, tamis::flip{});
    for (long k = 0; k < steps; ++k) block.step();
    std::printf("%zu particles\n", block.particles());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: instructions held|moving|block linear|quadratic <steps>\n", stderr);
        return 2;
    }
    const std::string motion = argv[1], shape = argv[2];
    const long steps = std::atol(argv[3]);
    if (motion == "block")
        return shape == "linear" ? run_block<tamis::linear>(steps) : run_block<tamis::quadratic_spline>(steps);
    if (shape == "linear")
        return motion == "held" ? run<tamis::linear, tamis::held>(steps) : run<tamis::linear, tamis::moving>(steps);
    return motion == "held" ? run<tamis::quadratic_spline, tamis::held>(steps)
                            : run<tamis::quadratic_spline, tamis::moving>(steps);
}
