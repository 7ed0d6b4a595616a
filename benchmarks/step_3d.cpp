// The 3D step of every shape and update beside the one written by hand.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "by_hand_3d.hpp"
#include "ratios.hpp"

int main(int argc, char** argv) {
    constexpr int n = 32, width = tamis::space<3, tamis::native_lanes::type<double>>::width;
    using block = by_hand::block_3d<double, width>;
    ratio_run run;
    run.add("3D/by hand/quadratic/flip", "", [=] { return hand_stepped<block>{std::make_unique<block>(n)}; });
    add_steps<3>(run, n, "3D", "3D/by hand/quadratic/flip");
    // Two million particles: beyond the caches.
    run.add("3D/by hand/quadratic/flip/64 cells", "", [] { return hand_stepped<block>{std::make_unique<block>(64)}; });
    run.add("3D/quadratic/flip/64 cells", "3D/by hand/quadratic/flip/64 cells",
            [] { return elastic_block<3, double>(64, tamis::quadratic_spline{}, tamis::flip{}); });
    return run.run(argc, argv);
}
