#include <tamis/run/critical_table.hpp>
#include <tamis/stability/critical.hpp>
#include <tamis/stability/stability.hpp>
#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "catch.hpp"

using namespace tamis;

namespace {

std::vector<point<1, double>> places_of(const stability::bar& set) {
    std::vector<point<1, double>> places;
    for (int p = 0; p < set.cells * set.per_cell; ++p)
        places.push_back(point<1, double>(4 + set.offset + (p + 0.5) / set.per_cell));
    return places;
}

/// The table's row, and the same recomputed, with 2 particles per cell.
template <class Shape, class Update, class Order>
void check_row(int row, int k, const Shape& shape, const Update& update, const Order& order) {
    const auto now = stability::critical_numbers(2, k, shape, update, order);
    const detail::critical_row& then = detail::critical_table[row];
    CAPTURE(row, now.inner, now.free_end);
    // Rounded down to thousandths.
    CHECK(std::abs(now.inner - 0.0005 - then.inner[1] / 1000.) < 0.0011);
    CHECK(std::abs(now.free_end - 0.0005 - then.free_end[1] / 1000.) < 0.0011);
}

}  // namespace

TEST_CASE("critical: held particles' steps are those of moving ones around a body at rest") {
    const stability::bar set{4, 2, 0.3, true};
    const auto check = [&](const auto&... policies) {
        const Eigen::MatrixXd J = stability::jacobian(set, 0.4, policies...);
        const Eigen::MatrixXd R = stability::responses<1>(places_of(set), 0.5, 12, 0, 0, 8, 0.4, policies...);
        // J has the velocities first, R each particle's values together.
        double largest = 0;
        for (int i = 0; i < 16; ++i)
            for (int j = 0; j < 16; ++j)
                largest = std::max(largest, std::abs(J(i, j) - R(i % 8 * 2 + i / 8, j % 8 * 2 + j / 8)));
        CHECK(largest < 1e-12);
        CHECK(R.cwiseAbs().maxCoeff() > 0.5);
    };
    check(linear{}, fmpm<dynamic>{4}, usl_minus{});
}

TEST_CASE("critical: limits of the endless lattice") {
    const auto of = [](int k) {
        return stability::critical_inner(2, 0, stability::reach_of<linear>(k), 2, linear{}, fmpm<dynamic>{k},
                                         usl_minus{});
    };
    const double flip_limit = stability::critical_inner(2, 0, 4, 2, linear{}, flip{}, usl_minus{});
    CHECK(std::abs(flip_limit - std::sqrt(4. / 7)) < 2e-4);
    CHECK(std::abs(of(64) - 0.5) < 5e-4);
    CHECK(of(1) > of(2));
}

TEST_CASE("critical: waves along an axis bound the step in two dimensions too") {
    const stability::lattice_step<2> step(stability::lattice<2>{2, 0, 0.3}, 3, linear{}, flip{}, usl_minus{});
    const auto growth_of = [&](double x, double y, double courant) {
        return stability::spectral_radius_of(step.of_wave({x, y}), courant) - 1;
    };
    const double pi = std::numbers::pi, limit = std::sqrt(4. / 7);
    CHECK(growth_of(pi, 0, 0.99 * limit) < 1e-5);
    CHECK(growth_of(pi, 0, 1.01 * limit) > 1e-3);
    for (const double y : {pi / 4, pi / 2, pi}) CHECK(growth_of(pi, y, 0.99 * limit) < 1e-5);
}

TEST_CASE("critical: the shipped table is what the analysis gives") {
    REQUIRE(std::size(detail::critical_table) == 12 * detail::critical_updates);
    constexpr int fmpm_4 = 5 + 3;
    REQUIRE(detail::critical_fmpm[3] == 4);
    check_row(0, 0, linear{}, flip{}, usl_minus{});
    check_row(fmpm_4, 4, linear{}, fmpm<dynamic>{4}, usl_minus{});
    check_row(detail::critical_shape<quadratic_spline> + fmpm_4, 4, quadratic_spline{}, fmpm<dynamic>{4}, usl_minus{});
    check_row(detail::critical_shape<ugimp> + detail::critical_updates, 0, ugimp{2}, flip{}, usavg_minus{});
}

TEST_CASE("critical: blends have numbers between those of FLIP and PIC") {
    const auto check = [](const auto& shape, const auto& update, const auto& order) {
        const auto of = [&](int k, const auto& of_update) {
            return stability::critical_numbers(2, k, shape, of_update, order);
        };
        const auto by_flip = of(0, flip{}), by_pic = of(1, pic{}), found = of(1, update);
        constexpr double found_to = 2e-4;
        CHECK(found.inner > std::min(by_flip.inner, by_pic.inner) - found_to);
        CHECK(found.inner < std::max(by_flip.inner, by_pic.inner) + found_to);
        CHECK(found.free_end > std::min(by_flip.free_end, by_pic.free_end) - found_to);
        solver mpm{uniform_grid{{0.}, {4.}, 0.25}, shape, update, order};
        const auto taken = detail::critical_of<typename decltype(mpm)::composition_type>(update, 2);
        REQUIRE(taken);
        CHECK(taken->inner < found.inner);
        CHECK(taken->inner > 0.85 * found.inner);
        CHECK(taken->at_free_end < found.free_end);
    };
    check(linear{}, blend{0.5}, usl_minus{});
    check(linear{}, blend{0.99}, usf{});
    check(quadratic_spline{}, graphics_blend{0.9}, usl_minus{});
}

TEST_CASE("critical: steps of FLIP with FMPM(k) now and then grow no faster than either") {
    const auto check = [](int k, long period, const auto& shape) {
        solver mpm{uniform_grid{{0.}, {4.}, 0.25}, shape, periodic_fmpm<dynamic>{k, period}, usl_minus{}};
        const auto taken = detail::critical_of<typename decltype(mpm)::composition_type>(mpm.scheme(), 2);
        REQUIRE(taken);
        double largest = 0;
        for (const double offset : {0., 0.1, 0.25}) {
            const auto step_of = [&](int order, const auto& update) {
                const int reach = stability::reach_of<std::decay_t<decltype(shape)>>(order);
                return stability::lattice_step<1>(stability::lattice<1>{2, offset}, reach, shape, update, usl_minus{});
            };
            const auto by_flip = step_of(0, flip{}), by_fmpm = step_of(k, fmpm<dynamic>{k});
            for (int n = 1; n <= 16; ++n) {
                const double wave = std::numbers::pi * n / 16;
                const auto between = by_flip.of_wave({wave}), last = by_fmpm.of_wave({wave});
                const auto product = [&](double courant) {
                    auto matrix = last(courant).eval();
                    for (long step = 1; step < period; ++step) matrix = (matrix * between(courant)).eval();
                    return matrix;
                };
                largest = std::max(largest, stability::spectral_radius_of(product, std::min(1., taken->inner)));
            }
        }
        CHECK(largest < 1 + 1e-4);
    };
    for (const long period : {2L, 5L, 20L}) {
        check(2, period, linear{});
        check(4, period, linear{});
        check(4, period, quadratic_spline{});
    }
}
