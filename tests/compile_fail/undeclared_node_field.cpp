// expect: tamis: a policy reads a node field it did not declare; add it to the policy's on_nodes list
#include <tamis/tamis.hpp>

using namespace tamis;

/// Forgets to declare the acceleration.
struct half_flip {
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::velocity>;
    static constexpr double start_share() { return 0; }
    auto velocity(auto p, auto near, auto dt) const { return (p[symbols::v] + dt * near.sum(symbols::a)).eval(); }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

int main() {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, transfer<lumped_mass, half_flip>{}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2});
    mpm.step(bodies(body), 0.01);
}
