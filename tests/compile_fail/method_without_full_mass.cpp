// expect: tamis: boundary methods differ only for a full mass matrix; give fmpm<k> with k > 1
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, flip{}, boundary_method::velocity{}}; }
