#pragma once
#include <tamis/shape/axis_weights.hpp>

#include <cmath>

#include "catch.hpp"

/// Node k of a particle's N, in cell sides from the start of the particle's cell.
template <class Shape> double node_place(int k) { return k - tamis::detail::ghosts<Shape> + Shape::shift; }

/// What every shape function of one axis must have, checked over a cell.
template <class Shape> void check_functions(const Shape& shape) {
    constexpr int N = Shape::support;
    STATIC_REQUIRE(tamis::ShapeFunction<Shape>);
    for (int j = 0; j <= 40; ++j) {
        const double r = j / 40.;
        CAPTURE(r);
        const auto at = shape.on_axis(r);
        double sum = 0, place = 0, slopes = 0, place_slope = 0;
        for (int k = 0; k < N; ++k) {
            CHECK(at.w[k] >= 0);
            sum += at.w[k];
            place += at.w[k] * node_place<Shape>(k);
            slopes += at.dw[k];
            place_slope += at.dw[k] * node_place<Shape>(k);
        }
        // Constants and linear functions come out as they are, with their slopes.
        CHECK(std::abs(sum - 1) < 1e-15);
        CHECK(std::abs(place - r) < 1e-15);
        CHECK(std::abs(slopes) < 1e-15);
        CHECK(std::abs(place_slope - 1) < 1e-15);
        // The other way round the cell is the same cell.
        const auto mirrored = shape.on_axis(1 - r);
        for (int k = 0; k < N; ++k) {
            CHECK(std::abs(at.w[k] - mirrored.w[N - 1 - k]) < 1e-15);
            CHECK(std::abs(at.dw[k] + mirrored.dw[N - 1 - k]) < 1e-15);
        }
        // Splines up to the cubic: a central difference misses by h^2 times the third derivative, at most 3, over 6.
        constexpr double h = 1e-4;
        const auto above = shape.on_axis(r + h), below = shape.on_axis(r - h);
        for (int k = 0; k < N; ++k) CHECK(std::abs((above.w[k] - below.w[k]) / (2 * h) - at.dw[k]) < h * h);
    }
    // From cell to cell, functions go on where they were.
    const auto end = shape.on_axis(1.), start = shape.on_axis(0.);
    CHECK(std::abs(end.w[0]) < 1e-15);
    CHECK(std::abs(start.w[N - 1]) < 1e-15);
    for (int k = 1; k < N; ++k) CHECK(std::abs(end.w[k] - start.w[k - 1]) < 1e-15);
}

/// Do slopes go on from cell to cell, too?
template <class Shape> bool slopes_are_continuous(const Shape& shape) {
    const auto end = shape.on_axis(1.), start = shape.on_axis(0.);
    bool yes = std::abs(end.dw[0]) < 1e-15 && std::abs(start.dw[Shape::support - 1]) < 1e-15;
    for (int k = 1; k < Shape::support; ++k) yes = yes && std::abs(end.dw[k] - start.dw[k - 1]) < 1e-15;
    return yes;
}
