// expect: tamis: a policy touches a field it did not declare; add it to the policy's on_particles or on_nodes list
#include <tamis/tamis.hpp>

using namespace tamis;

struct jelly {
    double density;
    double wave_speed() const { return 1; }
    // The velocity is stored, for others; this law did not ask for it.
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto) const { return L * p[symbols::v][0]; }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
