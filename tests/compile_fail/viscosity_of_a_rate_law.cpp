// expect: tamis: newtonian adds to the stress that a law makes of other fields, but this law adds to the stress itself
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(newtonian<ideal_gas>{{1.4, 1, 1}, 0.1}, everywhere, per_cell{2});
}
