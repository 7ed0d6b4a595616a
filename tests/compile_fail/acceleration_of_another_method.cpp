// expect: tamis: field::full_acceleration knows of conditions by increments only
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, fmpm<2>{}, boundary_method::velocity{},
               read_out<field::full_acceleration>{}};
}
