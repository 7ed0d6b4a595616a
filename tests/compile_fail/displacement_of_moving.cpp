// expect: tamis: field::displacement is kept by total_lagrangian{} only
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body =
        mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2}, fields<field::displacement>{});
}
