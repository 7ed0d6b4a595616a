// expect: tamis: the dimension is 1, 2 or 3
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0., 0., 0., 0.}, {1., 1., 1., 1.}, 0.1}}; }
