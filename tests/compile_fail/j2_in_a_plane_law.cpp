// expect: tamis: j2 computes with 3x3 tensors; a law that calls it says
#include <tamis/tamis.hpp>

using namespace tamis;

struct damaged : j2 {
    static constexpr bool three_by_three = false;
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        return Tensor(j2::stress(p, L, dt) / 2);
    }
};

int main() {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}};
    auto body = mpm.make_body(damaged{{.young = 1, .density = 1, .yield = 1}}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
