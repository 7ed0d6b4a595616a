// expect: tamis: the corners of uniform_grid{lower, upper, spacing} have unlike numbers of components; give each one
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    const uniform_grid grid{{0, 0}, {1, 1, 1}, 0.1};
    solver mpm{grid};
}
