// expect: tamis: the law has no stress(p, grad_v, dt) that can be called
#include <tamis/tamis.hpp>

using namespace tamis;

struct jelly {
    double density;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(const Tensor& L) const { return L; }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
