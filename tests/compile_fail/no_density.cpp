// expect: tamis: the law has no density; give it a member `double density`
#include <tamis/tamis.hpp>

using namespace tamis;

struct jelly {
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto dt) const { return dt * L; }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{}, everywhere, per_cell{2});
}
