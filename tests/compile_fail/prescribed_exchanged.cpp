// expect: tamis: prescribed{region, velocity, direction} has its arguments in another order, or a plain vector
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, prescribed{everywhere, point<2, double>(0, 1)}}; }
