// expect: tamis: total_lagrangian knows particles by their first places, where bodies that meet later do not touch
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, total_lagrangian{}, contact{frictionless{}}}; }
