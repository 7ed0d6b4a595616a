// expect: tamis: make_body(law, region, per_cell{n}) has its arguments exchanged; give the law first
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(everywhere, linear_elastic{.young = 1, .density = 1}, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
