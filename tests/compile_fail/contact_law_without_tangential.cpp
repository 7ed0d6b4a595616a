// expect: tamis: the contact law has no tangential(normal, stick)
#include <tamis/tamis.hpp>

using namespace tamis;

struct glue {};

int main() { solver mpm{uniform_grid{{0.}, {1.}, 0.1}, contact{glue{}}}; }
