// A composition that knows of no conditions does without what only they read: nothing may come of it.
#include "laws/sameness.hpp"

using namespace laws;

namespace {

/// A stirred body in free flight after some steps; `policies` may hold nodes, but hold none.
template <int D, class... Policies> auto flown(const Policies&... policies) {
    solver mpm{box<D>(12, 8), policies...};
    auto block = stirred_block<D>(mpm);
    for (int k = 0; k < 20; ++k) mpm.step(bodies(block), 1. / 256);
    return snapshot(std::as_const(block));
}

template <int D, class Shape, class Transfer> void is_as_if_nothing_were_held(Shape shape, Transfer transfer) {
    CAPTURE(D, Shape::name, Transfer::name);
    CHECK(flown<D>(shape, transfer) == flown<D>(shape, transfer, no_walls<D>()));
}

}  // namespace

TEST_CASE("a free body moves, bit for bit, as one whose conditions hold no node: every number of terms") {
    is_as_if_nothing_were_held<2>(linear{}, fmpm<2>{});
    is_as_if_nothing_were_held<2>(linear{}, fmpm<3>{});
    is_as_if_nothing_were_held<2>(quadratic_spline{}, fmpm<4>{});
    is_as_if_nothing_were_held<2>(linear{}, fmpm<dynamic>{2});
    is_as_if_nothing_were_held<2>(linear{}, fmpm<dynamic>{5});
    is_as_if_nothing_were_held<2>(quadratic_spline{}, xpic<3>{});
    is_as_if_nothing_were_held<1>(linear{}, fmpm<4>{});
    is_as_if_nothing_were_held<3>(linear{}, fmpm<2>{});
}
