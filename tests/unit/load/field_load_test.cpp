// A load that reads fields of its particles: the acceleration they carry is the one they get.
#include <tamis/tamis.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

struct pull : vector_field {
    static constexpr std::string_view name = "pull";
};
/// Each particle carries its own acceleration; it grows with time.
struct carried_pull {
    static constexpr bool by_fields = true;
    using on_particles = fields<const pull>;
    auto acceleration_of(auto p, double t) const {
        auto b = p[pull{}];
        using T = typename decltype(b)::Scalar;
        for (int d = 0; d < static_cast<int>(b.size()); ++d) b[d] = b[d] * constant<T>(1 + t);
        return b;
    }
};

const auto middle = [](const auto& at) { return (at - point<2, double>(0.5, 0.5)).norm() < 0.3; };
template <class Solver> auto stepped(Solver& mpm) {
    auto block = mpm.make_body(linear_elastic{.young = 10, .poisson = 0.3, .density = 1}, middle, per_cell{2});
    if constexpr (decltype(block)::has(pull{}))
        for (auto p : block) p[pull{}] = point<2, double>(3 * p[symbols::x][1], -2);
    for (int step = 0; step < 10; ++step) mpm.step(bodies(block), 0.01);
    return block;
}

}  // namespace

TEST_CASE("a load by fields is the same as one by places where particles have not moved far") {
    const uniform_grid grid{{0., 0.}, {1., 1.}, 0.1};
    solver by_fields{grid, loads{carried_pull{}, gravity{point<2, double>(0, 1)}}};
    const auto one = stepped(by_fields);
    solver by_places{grid, body_acceleration{[](const auto& x, const auto&, double t) {
                         return point<2, double>(3 * x[1] * (1 + t), -2 * (1 + t) + 1);
                     }}};
    const auto other = stepped(by_places);
    const auto momentum = total_momentum(one);
    CHECK((momentum - total_momentum(other)).norm() < 1e-3 * momentum.norm());

    // By what was given to each particle, to round-off: the sum over the steps of dt m b (1 + t).
    point<2, double> impulse = point<2, double>::Zero();
    for (const auto p : one) impulse += p[symbols::m] * (p[pull{}] * (0.1 + 0.01 * 0.45) + point<2, double>(0, 0.1));
    CHECK((momentum - impulse).norm() < 1e-13);
}
