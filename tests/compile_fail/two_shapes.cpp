// expect: tamis: two policies of one role were given to solver{...}; keep one of them
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, quadratic_spline{}}; }
