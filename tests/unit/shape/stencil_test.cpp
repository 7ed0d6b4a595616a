#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>
#include <tamis/shape/held_weights.hpp>
#include <tamis/shape/stencil.hpp>

#include "unit/shape/functions.hpp"

using namespace tamis;
using detail::stencil;

namespace {

template <class Shape> using line = stencil<space<1, double>, Shape::support>;

enum class wall { low, high };

/// Weights at place r of the cell at a wall.
template <class Shape> line<Shape> at_wall(wall side, double r, double inverse_spacing = 1) {
    line<Shape> st;
    space<1, double>::vector local;
    local[0] = r;
    st.set(Shape{}, local, inverse_spacing);
    detail::wall_lanes<space<1, double>> walls{{side == wall::low ? 1. : 0.}, {side == wall::high ? 1. : 0.}};
    st.fold(walls);
    return st;
}

/// Places of a wall's cell that are in the box: for cells centred on nodes, half of them.
template <class Shape, class F> void for_places_beside(wall side, F f) {
    const double first = side == wall::low ? Shape::shift : 0, last = side == wall::high ? 1 - Shape::shift : 1;
    for (int j = 0; j <= 20; ++j) f(first + (last - first) * j / 20);
}

template <class Shape> void folded_functions_are_complete(wall side) {
    constexpr int N = Shape::support;
    const int ghost = side == wall::low ? 0 : N - 1;
    for_places_beside<Shape>(side, [&](double r) {
        CAPTURE(N, r);
        const line<Shape> st = at_wall<Shape>(side, r);
        double sum = 0, place = 0, slopes = 0, place_slope = 0;
        for (int k = 0; k < N; ++k) {
            sum += st.axis[0].w[k];
            place += st.axis[0].w[k] * node_place<Shape>(k);
            slopes += st.axis[0].dw[k];
            place_slope += st.axis[0].dw[k] * node_place<Shape>(k);
        }
        CHECK(std::abs(sum - 1) < 2e-15);
        CHECK(std::abs(place - r) < 2e-15);
        CHECK(std::abs(slopes) < 2e-15);
        CHECK(std::abs(place_slope - 1) < 2e-15);
        if (detail::ghosts < Shape >> 0) {
            CHECK(st.axis[0].w[ghost] == 0);
            CHECK(st.axis[0].dw[ghost] == 0);
        }
        constexpr double h = 1e-4;
        const line<Shape> above = at_wall<Shape>(side, r + h), below = at_wall<Shape>(side, r - h);
        for (int k = 0; k < N; ++k)
            CHECK(std::abs((above.axis[0].w[k] - below.axis[0].w[k]) / (2 * h) - st.axis[0].dw[k]) < h * h);
    });
}

template <int Dim, class Shape> void tensor_product() {
    using S = space<Dim, double>;
    constexpr int N = Shape::support;
    const double inverse_spacing = 4;
    stencil<S, N> st;
    typename S::vector local;
    for (int d = 0; d < Dim; ++d) local[d] = 0.2 + 0.3 * d;
    st.set(Shape{}, local, inverse_spacing);
    typename S::tensor stress;
    for (int c = 0; c < Dim * Dim; ++c) stress.data()[c] = 1 + c * c;
    axis_weights<double, N> axis[Dim];
    for (int d = 0; d < Dim; ++d) axis[d] = Shape{}.on_axis(local[d]);

    for (int r = 0; r < detail::power(N, Dim - 1); ++r) {
        const auto across = st.row(r);
        for (int a = 0; a < N; ++a) {
            const int k[3] = {a, r % N, r / N};
            double w = 1, slope[Dim];
            for (int d = 0; d < Dim; ++d) {
                w *= axis[d].w[k[d]];
                slope[d] = inverse_spacing;
                for (int e = 0; e < Dim; ++e) slope[d] *= d == e ? axis[e].dw[k[e]] : axis[e].w[k[e]];
            }
            CHECK(std::abs(st.weight(a, across) - w) < 1e-16);
            const auto slopes = st.slope(a, across);
            const typename S::vector as_vector = slopes, stretched = stress * slopes;
            for (int d = 0; d < Dim; ++d) CHECK(std::abs(as_vector[d] - slope[d]) < 1e-15);
            CHECK((stretched - stress * as_vector).norm() < 1e-15 * stress.norm());
        }
    }
}

/// Made of places, folded at walls, and recalled from what was kept.
template <int Dim, class Shape> void weights_without_slopes_are_the_same() {
    using S = space<Dim, double>;
    using weights = detail::held_weights<Shape>;
    constexpr int N = Shape::support;
    typename S::vector local;
    detail::wall_lanes<S> walls;
    for (int d = 0; d < Dim; ++d) {
        local[d] = 0.6 + 0.15 * d;
        walls.low[d] = 1;
        walls.high[d] = 0;
    }
    stencil<S, N> with;
    stencil<S, N, false> without, back;
    with.set(Shape{}, local, 8.);
    without.set(Shape{}, local, 8.);
    with.fold(walls);
    without.fold(walls);
    typename weights::template value<S> kept;
    weights::template keep<S>(kept, with);
    weights::template recall<S>(back, kept, 8.);
    STATIC_REQUIRE(sizeof(without) == sizeof(double) * Dim * N);
    for (int r = 0; r < detail::power(N, Dim - 1); ++r)
        for (int a = 0; a < N; ++a) {
            CHECK(without.weight(a, without.row(r)) == with.weight(a, with.row(r)));
            CHECK(back.weight(a, back.row(r)) == with.weight(a, with.row(r)));
        }
}

template <int Dim, class Shape> void kept_weights_come_back() {
    using S = space<Dim, double>;
    using weights = detail::held_weights<Shape>;
    STATIC_REQUIRE(weights::template components<S> == Dim * Shape::support * (std::is_same_v<Shape, linear> ? 1 : 2));
    for (const double low : {0., 1.}) {
        typename S::vector local;
        detail::wall_lanes<S> walls;
        for (int d = 0; d < Dim; ++d) {
            local[d] = 0.6 + 0.15 * d;
            walls.low[d] = low;
            walls.high[d] = 0;
        }
        stencil<S, Shape::support> st, back;
        st.set(Shape{}, local, 8.);
        st.fold(walls);
        typename weights::template value<S> kept;
        weights::template keep<S>(kept, st);
        weights::template recall<S>(back, kept, 8.);
        for (int d = 0; d < Dim; ++d) {
            for (int k = 0; k < Shape::support; ++k) {
                CHECK(back.axis[d].w[k] == st.axis[d].w[k]);
                CHECK(back.axis[d].dw[k] == st.axis[d].dw[k]);
            }
            const double place = weights::template place<S>(d, [&](int c) { return kept[c]; });
            CHECK(std::abs(place - local[d]) < 1e-15);
        }
    }
}

}  // namespace

TEST_CASE("stencil: folded at a wall, functions sum to one and give places back, by nodes inside alone") {
    for (const wall side : {wall::low, wall::high}) {
        folded_functions_are_complete<linear>(side);
        folded_functions_are_complete<quadratic_spline>(side);
        folded_functions_are_complete<cubic_spline>(side);
    }
}

TEST_CASE("stencil: in the half cell at a wall quadratic splines are the linear functions") {
    for_places_beside<quadratic_spline>(wall::low, [](double r) {
        const auto st = at_wall<quadratic_spline>(wall::low, r, 10);
        const double from_wall = r - 0.5;
        CHECK(std::abs(st.axis[0].w[1] - (1 - from_wall)) < 1e-15);
        CHECK(std::abs(st.axis[0].w[2] - from_wall) < 1e-15);
        CHECK(std::abs(st.axis[0].dw[1] + 10) < 1e-14);
        CHECK(std::abs(st.axis[0].dw[2] - 10) < 1e-14);
    });
}

TEST_CASE("stencil: at the wall itself the wall's node has all the weight") {
    CHECK(std::abs(at_wall<quadratic_spline>(wall::low, 0.5).axis[0].w[1] - 1) < 1e-16);
    CHECK(std::abs(at_wall<quadratic_spline>(wall::high, 0.5).axis[0].w[1] - 1) < 1e-16);
    CHECK(std::abs(at_wall<cubic_spline>(wall::low, 0).axis[0].w[1] - 1) < 1e-15);
    CHECK(std::abs(at_wall<cubic_spline>(wall::high, 1).axis[0].w[2] - 1) < 1e-15);
}

TEST_CASE("stencil: a grid of one cell is folded at both walls") {
    space<1, double>::vector local;
    local[0] = 0.3;
    line<cubic_spline> st;
    st.set(cubic_spline{}, local, 1.);
    st.fold({{1.}, {1.}});
    CHECK(st.axis[0].w[0] == 0);
    CHECK(std::abs(st.axis[0].w[1] - 0.7) < 1e-15);
    CHECK(std::abs(st.axis[0].w[2] - 0.3) < 1e-15);
    CHECK(st.axis[0].w[3] == 0);
}

TEST_CASE("stencil: weights are products over the axes, slopes are per unit of length") {
    tensor_product<1, cubic_spline>();
    tensor_product<2, quadratic_spline>();
    tensor_product<3, linear>();
    tensor_product<3, cubic_spline>();
}

TEST_CASE("held_weights: what was kept comes back, and with it the place") {
    kept_weights_come_back<1, linear>();
    kept_weights_come_back<3, linear>();
    kept_weights_come_back<2, quadratic_spline>();
    kept_weights_come_back<2, cubic_spline>();
}

TEST_CASE("stencil: without slopes the weights are the same, and nothing is kept beside them") {
    weights_without_slopes_are_the_same<1, linear>();
    weights_without_slopes_are_the_same<2, quadratic_spline>();
    weights_without_slopes_are_the_same<3, quadratic_spline>();
    weights_without_slopes_are_the_same<3, cubic_spline>();
}
