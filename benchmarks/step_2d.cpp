// The 2D step of every shape and update.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "ratios.hpp"

int main(int argc, char** argv) {
    using namespace tamis;
    ratio_run run;
    add_steps<2>(run, 128, "2D", "");
    // A million particles: beyond the caches.
    const auto large = [&](const auto& functions, const std::string& shape) {
        const std::string flip_step = "2D/" + shape + "/flip/512 cells";
        run.add(flip_step, "", [=] { return elastic_block<2, double>(512, functions, flip{}); });
        run.add("2D/" + shape + "/fmpm(2)/512 cells", flip_step,
                [=] { return elastic_block<2, double>(512, functions, fmpm<2>{}); });
        run.add("2D/" + shape + "/fmpm(4)/512 cells", flip_step,
                [=] { return elastic_block<2, double>(512, functions, fmpm<4>{}); });
    };
    large(linear{}, "linear");
    large(quadratic_spline{}, "quadratic");
    return run.run(argc, argv);
}
