// A field, a law, a shape and a condition of your own: plain structs, no base class, no macro, no registration.
#include <tamis/tamis.hpp>

#include <cstdio>
using namespace tamis;
using namespace tamis::symbols;

struct temperature : scalar_field {
    static constexpr std::string_view name = "temperature";
};
inline constexpr temperature theta;

/// A rate-form solid that softens as it warms, and warms by the work done on it.
struct warm_solid {
    double young, density, softening, heat;
    using on_particles = fields<const field::stress, temperature>;

    double wave_speed() const { return std::sqrt(young / density); }
    template <class Tensor> Tensor stress(auto p, const Tensor& grad_v, auto dt) const {
        using std::exp;
        const Tensor rate = (grad_v + grad_v.transpose()) / 2;
        p[theta] += dt * p[sigma].cwiseProduct(rate).sum() / (density * heat);
        return p[sigma] + dt * young * exp(-softening * p[theta]) * rate;
    }
};

/// The left face is driven back and forth; the other faces are free.
struct piston {
    double speed, omega;
    bool holds(const auto& at) const { return at[0] <= 0; }
    auto velocity(const auto& at, auto t) const { return at * 0 + speed * std::sin(omega * t) * at.Unit(0); }
};

/// Generalized interpolation (uGIMP): tents averaged over particles of half-width l <= 1/2 cells.
struct gimp {
    double l = 0.25;
    static constexpr int support = 3;
    static constexpr double shift = 0.5;
    template <class T> axis_weights<T, 3> on_axis(const T& r) const {
        const auto value = [&](T d, T q) { return select(d < 1 - l, 1 - d, select(q > 0, q * q / (4 * l), T(0))); };
        const auto slope = [&](T d, T q) { return select(d < 1 - l, T(-1), select(q > 0, -q / (2 * l), T(0))); };
        const T left = r + 0.5, right = 1.5 - r, q_left = 1 + l - left, q_right = 1 + l - right;
        const T w0 = value(left, q_left), w2 = value(right, q_right);
        const T d0 = slope(left, q_left), d2 = -slope(right, q_right);
        return {{w0, 1 - w0 - w2, w2}, {d0, -d0 - d2, d2}};
    }
};

int main() {
    solver mpm{uniform_grid{{0., -0.1}, {1., 0.6}, 0.05}, gimp{}, flip{}, usavg_minus{}, piston{0.05, 10}};
    const auto block_at = [](const auto& at) { return at[0] < 0.8 && at[1] > 0 && at[1] < 0.5; };
    const warm_solid law{.young = 100, .density = 1, .softening = 0.1, .heat = 1};
    auto block = mpm.make_body(law, block_at, per_cell{2});
    const auto print = [&](double t) {
        std::printf("%6.3f s  temperature %.6e  kinetic %.6e J\n", t, mean(block, theta), kinetic_energy(block));
    };
    integrate(mpm, bodies(block), {0, 2}, courant{0.2}, every(200, print));
}
