// The 1D step of every shape and update, and ADMPM's driven bar beside the one written by hand.
#include <tamis/tamis.hpp>

#include "block.hpp"
#include "by_hand_1d.hpp"
#include "ratios.hpp"

namespace {

/// Left end fixed, right end at 0.01 sin 10t.
struct driven_ends {
    bool holds(const auto& at) const { return at[0] <= 0 || at[0] >= 1; }
    template <class Point> Point velocity(const Point& at, auto t) const {
        return Point::Constant(at[0] <= 0 ? 0.0 : 0.01 * std::sin(10 * t));
    }
};

template <class Motion> void add_bar(ratio_run& run, const std::string& name, int nodes, int per_cell, double dt) {
    using namespace tamis;
    const bool moves = Motion::moves;
    run.add(name + "/by hand", "", [=] {
        return hand_stepped<by_hand::bar_1d>{std::make_unique<by_hand::bar_1d>(nodes, per_cell, dt, moves)};
    });
    run.add(name, name + "/by hand", [=] {
        const auto policies = std::tuple{linear{}, flip{}, euler{}, driven_ends{}, Motion{}};
        return std::apply(
            [=](const auto&... policy) {
                using solver_type = solver<uniform_grid<1, double>, std::decay_t<decltype(policy)>...>;
                auto mpm = std::make_unique<solver_type>(uniform_grid{{0.}, {1.}, 1. / (nodes - 1)}, policy...);
                const linear_elastic law{.young = 1, .poisson = 0, .density = 1};
                using body_type = decltype(mpm->make_body(law, everywhere, tamis::per_cell{per_cell}));
                auto body = std::make_unique<body_type>(mpm->make_body(law, everywhere, tamis::per_cell{per_cell}));
                return stepped<solver_type, body_type>{std::move(mpm), std::move(body), dt};
            },
            policies);
    });
}

}  // namespace

int main(int argc, char** argv) {
    ratio_run run;
    // Small steps: particles must not leave the box, nor change cells, however long the timing runs.
    add_bar<tamis::moving>(run, "1D/bar of 50 cells, moving", 51, 2, 1e-9);
    add_bar<tamis::held>(run, "1D/bar of 50 cells, held", 51, 2, 1e-5);
    add_bar<tamis::moving>(run, "1D/bar of 200 cells, moving", 201, 4, 1e-9);
    add_bar<tamis::held>(run, "1D/bar of 200 cells, held", 201, 4, 1e-6);
    add_steps<1>(run, 512, "1D", "");
    return run.run(argc, argv);
}
