// What compile_time.sh compiles besides one_solver.cpp: the same, beside a file that has the step.
#include "of_many.hpp"

int main() {
    using namespace tamis;
    solver_of_many mpm{uniform_grid{{0., 0., 0.}, {1., 1., 1.}, 1. / 16}, quadratic_spline{}, flip{}};
    const linear_elastic law{.young = 1e4, .poisson = 0.3, .density = 1000};
    body_of_many body = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.25 && at[0] < 0.75; }, per_cell{2});
    mpm.step(bodies(body), 1e-4);
}
