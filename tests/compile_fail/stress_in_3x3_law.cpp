// expect: tamis: a law of 3x3 tensors cannot go on from field::stress, which lacks the part out of the plane
#include <tamis/tamis.hpp>

using namespace tamis;

struct jelly {
    double density;
    using on_particles = fields<const field::stress>;
    static constexpr bool three_by_three = true;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const { return p[symbols::sigma] + dt * L; }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
