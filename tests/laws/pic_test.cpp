#include "laws/sameness.hpp"

using namespace laws;

namespace {

/// A stirred, loaded body between swaying walls, after some steps.
template <int D, class Composed> auto after_steps(const Composed& composed, int steps) {
    const auto grid = box<D>(7, 5);
    const walls<D> swaying{[&](const place<D>& at) { return at[0] <= grid.lower()[0]; },
                           [](const place<D>& at, double t) { return place<D>((at * std::sin(9 * t)).eval()); }};
    const place<D> g = place<D>::Constant(-0.5);
    auto mpm = composed.on(grid, swaying, g);
    auto block = block_in(mpm, [](const place<D>& at) { return at.sum() < 0.9; });
    stir(block, 0.6, 0.5);
    for (int step = 0; step < steps; ++step) mpm.step(bodies(block), 0.01);
    return snapshot(std::as_const(block));
}

template <int D, class Fmpm, class Shape, class Order> void pic_is(Fmpm fmpm_of_one, Shape shape, Order order) {
    CAPTURE(D, Shape::name, Order::name);
    CHECK(after_steps<D>(composed{shape, pic{}, order, held{}}, 25) ==
          after_steps<D>(composed{shape, fmpm_of_one, order, held{}}, 25));
}

}  // namespace

TEST_CASE("PIC is FMPM(1): where particles are held, whole runs are the same, bit for bit") {
    pic_is<1>(fmpm<1>{}, linear{}, usl_minus{});
    pic_is<1>(fmpm<dynamic>{1}, quadratic_spline{}, usf{});
    pic_is<2>(fmpm<1>{}, cubic_spline{}, usl_plus{});
}

TEST_CASE("PIC is FMPM(1): where particles move, the velocities of the first step are the same, bit for bit") {
    const auto by_pic = after_steps<2>(composed{quadratic_spline{}, pic{}, usl_minus{}}, 1);
    const auto by_fmpm = after_steps<2>(composed{quadratic_spline{}, fmpm<1>{}, usl_minus{}}, 1);
    using body = composed<quadratic_spline, pic, usl_minus>::solver_type<2>::body_for<linear_elastic, origin>;
    constexpr auto velocity = static_cast<std::size_t>(body::store_type::slot::first<field::velocity>());
    constexpr auto position = static_cast<std::size_t>(body::store_type::components);
    REQUIRE(by_pic.size() == by_fmpm.size());
    bool moved_otherwise = false;
    for (const auto& [where, p] : by_pic) {
        const auto& q = by_fmpm.at(where);
        for (std::size_t d = 0; d < 2; ++d) {
            CHECK(p[velocity + d] == q[velocity + d]);
            moved_otherwise = moved_otherwise || p[position + d] != q[position + d];
        }
    }
    CHECK(moved_otherwise);
}
