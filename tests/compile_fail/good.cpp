#include <tamis/tamis.hpp>

int main() {
    using namespace tamis;
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, quadratic_spline{}, fmpm<2>{}, usl_minus{}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .poisson = 0.3, .density = 1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
