// expect: tamis: an argument of solver{...} is no policy
#include <tamis/tamis.hpp>

using namespace tamis;

struct wind {
    double speed;
};

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, wind{1}}; }
