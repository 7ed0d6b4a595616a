// expect: tamis: this shape's functions change when particles are strained, and must be the same throughout a step
#include <tamis/tamis.hpp>

using namespace tamis;

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, cpgimp{2}, usf{}}; }
