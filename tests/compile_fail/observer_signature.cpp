// expect: tamis: an observer of integrate is called with the time, f(double t), or with a progress_state; this one
// takes neither
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    integrate(mpm, bodies(body), {0, 1}, courant{0.2}, [](const char*) {});
}
