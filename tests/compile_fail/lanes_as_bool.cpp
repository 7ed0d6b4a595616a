// expect: tamis: a comparison of lanes is used as one bool, but a law or load sees several particles at once
#include <tamis/tamis.hpp>

using namespace tamis;

/// Stiffer in tension.
struct jelly {
    double density;
    using on_particles = fields<const field::stress>;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        const Tensor D = (L + L.transpose()) / 2;
        if (D(0, 0) > 0) return p[symbols::sigma] + 2 * dt * D;
        return p[symbols::sigma] + dt * D;
    }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}};
    auto body = mpm.make_body(jelly{1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
