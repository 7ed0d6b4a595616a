// expect: tamis: slip{region, direction} has its arguments exchanged; give the region, a function of the place, first
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    const slip floor{point<2, double>(0, 1), [](const auto& at) { return at[1] <= 0; }};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, floor};
}
