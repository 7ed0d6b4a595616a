// Two elastic disks of different stiffness and equal mass meet head on and part again. They share one velocity field,
// which is contact enough: at nodes that both reach they move as one, so they neither interpenetrate nor slide.
#include <tamis/tamis.hpp>

#include <cstdio>

int main() {
    using namespace tamis;
    using namespace tamis::symbols;

    const auto disk = [](double cx, double cy) {
        return [=](const auto& at) { return std::hypot(at[0] - cx, at[1] - cy) < 0.2; };
    };
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.025}, quadratic_spline{}, fmpm<2>{}, usl_plus{}};

    auto soft =
        mpm.make_body(linear_elastic{.young = 500, .poisson = 0.3, .density = 1e3}, disk(0.3, 0.3), per_cell{2});
    auto hard =
        mpm.make_body(linear_elastic{.young = 5000, .poisson = 0.3, .density = 1e3}, disk(0.7, 0.7), per_cell{2});
    for (auto p : soft) p[v].setConstant(+0.1);
    for (auto p : hard) p[v].setConstant(-0.1);

    std::puts("time (s)   soft disk at x (m)   hard disk at x (m)   kinetic (J)   elastic (J)");
    const auto print = [&](double t) {
        std::printf("%8.3f   %18.6f   %18.6f   %11.6f   %11.6f\n", t, mean(soft, x)[0], mean(hard, x)[0],
                    kinetic_energy(soft) + kinetic_energy(hard), elastic_energy(soft) + elastic_energy(hard));
    };
    integrate(mpm, bodies(soft, hard), {0, 3}, fixed_steps{1500}, every(250, print));
}
