// expect: tamis: field::full_acceleration needs a full mass matrix; give fmpm<k> with k > 1
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, flip{}, read_out<field::full_acceleration>{}}; }
