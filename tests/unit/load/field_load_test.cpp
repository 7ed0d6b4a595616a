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

}  // namespace

TEST_CASE("a load by fields gives each particle what it carries, and adds up with others") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, loads{carried_pull{}, gravity{point<2, double>(0, 1)}}};
    const auto middle = [](const auto& at) { return (at - point<2, double>(0.5, 0.5)).norm() < 0.3; };
    auto block = mpm.make_body(linear_elastic{.young = 10, .poisson = 0.3, .density = 1}, middle, per_cell{2});
    for (auto p : block) p[pull{}] = point<2, double>(3 * p[symbols::x][1], -2);
    double grown = 0;
    for (int step = 0; step < 10; ++step) {
        grown += 0.01 * (1 + mpm.time());
        mpm.step(bodies(block), 0.01);
    }
    point<2, double> impulse = point<2, double>::Zero();
    for (const auto p : std::as_const(block)) impulse += p[symbols::m] * (p[pull{}] * grown + point<2, double>(0, 0.1));
    CHECK((total_momentum(std::as_const(block)) - impulse).norm() < 1e-13);
    CHECK(impulse.norm() > 0.01);
}
