// expect: tamis: an argument of loads{...} is no load
#include <tamis/tamis.hpp>

using namespace tamis;

struct wind {
    double speed;
};

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, loads{grid_damping{1.}, wind{1}}}; }
