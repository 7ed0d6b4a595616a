// expect: tamis: a body was made by a solver of other policies
#include <tamis/tamis.hpp>

using namespace tamis;

int main() {
    solver one{uniform_grid{{0.}, {1.}, 0.1}, linear{}, usl_minus{}};
    solver other{uniform_grid{{0.}, {1.}, 0.1}, linear{}, usl_plus{}};
    auto body = one.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    other.step(bodies(body), 0.01);
}
