// expect: tamis: step is called with the bodies in one bundle: mpm.step(bodies(a, b), dt)
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    mpm.step(body, 0.01);
}
