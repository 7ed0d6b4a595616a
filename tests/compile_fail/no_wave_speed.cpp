// expect: tamis: the law has no wave speed, from which time steps are chosen; give it a member function
#include <tamis/tamis.hpp>

using namespace tamis;

struct jelly {
    double density;
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto dt) const { return dt * L; }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{1}, everywhere, per_cell{2});
}
