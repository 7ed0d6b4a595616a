// The 3D step of every shape and update beside the one written by hand.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "by_hand_3d.hpp"
#include "ratios.hpp"

int main(int argc, char** argv) {
    using namespace tamis;
    constexpr int n = 32;
    ratio_run run;
    const auto by_hand_of = [&](auto number, const std::string& name, int cells) {
        using real = decltype(number);
        using block = by_hand::block_3d<real, space<3, native_lanes::type<real>>::width>;
        run.add(name, "", [=] { return hand_stepped<block>{std::make_unique<block>(cells)}; });
    };
    const std::string by_hand = "3D/by hand/quadratic/flip";
    by_hand_of(double(), by_hand, n);
    add_steps<3>(run, n, "3D", by_hand);
    run.add("3D/quadratic/flip/neo-Hookean", "3D/quadratic/flip",
            [] { return elastic_block<3, double, neo_hookean>(n, quadratic_spline{}, flip{}); });
    run.add("3D/quadratic/flip/one lane", "3D/quadratic/flip",
            [] { return elastic_block<3, double>(n, quadratic_spline{}, flip{}, one_lane{}); });
    // 33 thousand particles, which a core keeps at hand; two million, which are beyond the caches.
    for (const int cells : {16, 64}) {
        const std::string of = "/" + std::to_string(cells) + " cells", flip_of = "3D/linear/flip" + of;
        run.add(flip_of, "", [=] { return elastic_block<3, double>(cells, linear{}, flip{}); });
        run.add("3D/linear/fmpm(2)" + of, flip_of,
                [=] { return elastic_block<3, double>(cells, linear{}, fmpm<2>{}); });
        run.add("3D/linear/fmpm(4)" + of, flip_of,
                [=] { return elastic_block<3, double>(cells, linear{}, fmpm<4>{}); });
    }
    by_hand_of(double(), by_hand + "/64 cells", 64);
    run.add("3D/quadratic/flip/64 cells", by_hand + "/64 cells",
            [] { return elastic_block<3, double>(64, quadratic_spline{}, flip{}); });
    run.add("3D/quadratic/fmpm(2)/64 cells", "3D/quadratic/flip/64 cells",
            [] { return elastic_block<3, double>(64, quadratic_spline{}, fmpm<2>{}); });
    run.add("3D/quadratic/fmpm(4)/64 cells", "3D/quadratic/flip/64 cells",
            [] { return elastic_block<3, double>(64, quadratic_spline{}, fmpm<4>{}); });
    by_hand_of(float(), by_hand + "/64 cells, float", 64);
    run.add("3D/quadratic/flip/64 cells, float", by_hand + "/64 cells, float",
            [] { return elastic_block<3, float>(64, quadratic_spline{}, flip{}); });
    return run.run(argc, argv);
}
