// expect: tamis: the first argument of solver{...} is the grid, the policies come after it in any order
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{flip{}, uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
}
