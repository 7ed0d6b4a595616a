// The plane between two clouds: against a minimum that is looked for by other means, and where it is known.
#include <tamis/contact/dividing_plane.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"

namespace {

constexpr double reach = 2.5, penalty = 1e-7, degree = 0.017453292519943295;
template <int D> using vector = typename tamis::detail::dividing_plane<D>::vector;
template <int D> struct member {
    double side;
    vector<D> at;
};
template <int D> using cloud = std::vector<member<D>>;

template <int D> vector<D> normal_of(const cloud<D>& all, double weight = penalty) {
    typename tamis::detail::dividing_plane<D>::points points;
    for (const member<D>& p : all) points.emplace_back(p.side, p.at);
    return tamis::detail::dividing_plane<D>(weight).normal(points);
}
template <int D> double degrees_off(const vector<D>& found, const vector<D>& right) {
    return std::acos(std::min(1., found.dot(right))) / degree;
}

/// The error that is to be least, as the paper has it, in long double.
long double error(const cloud<2>& all, const std::array<long double, 3>& plane, double weight) {
    long double sum = weight * (plane[0] * plane[0] + plane[1] * plane[1]);
    for (const auto& p : all) {
        const long double s = plane[0] * p.at[0] + plane[1] * p.at[1] + plane[2];
        const long double off = p.side - (2 / (1 + std::exp(-s)) - 1);
        sum += off * off;
    }
    return sum;
}
/// Its minimum by parabolas through three errors along directions that are improved as one goes (Powell 1964).
vector<2> direct_normal(const cloud<2>& all, double weight) {
    std::array<long double, 3> at{0, 1, 0};
    std::array<std::array<long double, 3>, 3> directions{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto moved = [](std::array<long double, 3> from, const std::array<long double, 3>& along, long double by) {
        for (std::size_t d = 0; d < 3; ++d) from[d] += by * along[d];
        return from;
    };
    const auto least_along = [&](const std::array<long double, 3>& along) {
        // By golden sections between bounds that enclose it.
        const auto f = [&](long double by) { return error(all, moved(at, along, by), weight); };
        long double step = 1e-3L, low = -step, high = step;
        while (f(2 * low) < f(low)) low *= 2;
        while (f(2 * high) < f(high)) high *= 2;
        low *= 2;
        high *= 2;
        const long double golden = (std::sqrt(5.L) - 1) / 2;
        for (int k = 0; k < 120; ++k) {
            const long double a = high - golden * (high - low), b = low + golden * (high - low);
            (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
        }
        at = moved(at, along, (low + high) / 2);
    };
    for (int round = 0; round < 60; ++round) {
        const auto before = at;
        for (const auto& along : directions) least_along(along);
        std::array<long double, 3> whole{at[0] - before[0], at[1] - before[1], at[2] - before[2]};
        const long double length = std::sqrt(whole[0] * whole[0] + whole[1] * whole[1] + whole[2] * whole[2]);
        if (length < 1e-13L) break;
        for (auto& part : whole) part /= length;
        directions = {directions[1], directions[2], whole};
        least_along(whole);
        if (round % 4 == 3) directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    }
    return vector<2>(static_cast<double>(at[0]), static_cast<double>(at[1])).normalized();
}

/// Rows of particles, four a cell, below and above a line through `on`, seen from the origin.
cloud<2> rows(const vector<2>& on, double turn, double shift) {
    const vector<2> along(std::cos(turn), std::sin(turn)), up(-along[1], along[0]);
    cloud<2> all;
    for (int i = -12; i < 12; ++i)
        for (int j = 0; j < 6; ++j)
            for (const double side : {-1., 1.}) {
                const vector<2> at =
                    on + (0.5 * i + 0.25 + (side > 0 ? shift : 0)) * along + side * (0.5 * j + 0.25) * up;
                if (at.norm() < reach) all.push_back({side, at});
            }
    return all;
}

}  // namespace

TEST_CASE("dividing_plane: the minimum is that which is found by errors alone") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> from(-0.4, 0.4);
    for (const double weight : {1e-1, 1e-3, 1e-5}) {
        const cloud<2> all = rows(vector<2>(from(random), from(random)), 0.3, from(random));
        CHECK((normal_of<2>(all, weight) - direct_normal(all, weight)).norm() < 1e-5);
    }
    cloud<2> mixed = rows(vector<2>(0.1, 0.2), -0.2, 0.1);
    mixed[3].side = -mixed[3].side;  // no plane divides these
    CHECK((normal_of<2>(mixed, 1e-3) - direct_normal(mixed, 1e-3)).norm() < 1e-5);
}

TEST_CASE("dividing_plane: between rows of particles it is right to a fifth of a degree, whatever their turn") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> from(-0.5, 0.5);
    double worst = 0;
    for (int k = 0; k < 300; ++k) {
        const double turn = 6.28 * from(random);
        const cloud<2> all = rows(vector<2>(from(random), from(random)), turn, from(random) / 2);
        worst = std::max(worst, degrees_off<2>(normal_of<2>(all), vector<2>(-std::sin(turn), std::cos(turn))));
    }
    CHECK(worst < 0.2);
}

TEST_CASE("dividing_plane: above a plane a disk of rings is met along its radius") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> from(-0.5, 0.5);
    double worst = 0;
    for (int k = 0; k < 200; ++k) {
        const vector<2> touch(from(random), from(random));
        const double radius = 5, first = from(random);
        cloud<2> all;
        const auto add = [&](double side, const vector<2>& at) {
            if (at.norm() < reach) all.push_back({side, at});
        };
        for (int i = -12; i < 12; ++i)
            for (int j = 0; j < 6; ++j) add(-1, touch + vector<2>(0.5 * i + first, -0.25 - 0.5 * j));
        for (int ring = 0; ring < 8; ++ring) {
            const double r = radius - 0.25 - 0.5 * ring, count = std::round(12.6 * r);
            for (double n = 0; n < count; ++n) {
                const double angle = (n + first + 0.37 * ring) * 6.283185307179586 / count;
                add(1, touch + vector<2>(r * std::sin(angle), radius - r * std::cos(angle)));
            }
        }
        worst = std::max(worst, degrees_off<2>(normal_of<2>(all), vector<2>(0, 1)));
    }
    CHECK(worst < 1.5);
}

TEST_CASE("dividing_plane: in three dimensions, and in one") {
    const vector<3> up = vector<3>(0.2, -0.3, 1).normalized();
    cloud<3> all;
    for (int i = -5; i < 5; ++i)
        for (int j = -5; j < 5; ++j)
            for (int k = -5; k < 5; ++k) {
                const vector<3> at(0.5 * i + 0.2, 0.5 * j + 0.3, 0.5 * k + 0.1);
                if (at.norm() < reach) all.push_back({at.dot(up) < 0.1 ? -1. : 1., at});
            }
    CHECK(degrees_off<3>(normal_of<3>(all), up) < 8);  // the surface is a stair
    CHECK(normal_of<1>({{-1, vector<1>(0.3)}, {1, vector<1>(0.8)}}) == vector<1>(1));
    CHECK(normal_of<1>({{1, vector<1>(0.3)}, {-1, vector<1>(0.8)}}) == vector<1>(-1));
}

TEST_CASE("dividing_plane: clouds exchanged turn it round, and of an empty one there is none") {
    cloud<2> all = rows(vector<2>(0.2, -0.1), 0.7, 0.2);
    const vector<2> normal = normal_of<2>(all);
    for (auto& p : all) p.side = -p.side;
    CHECK((normal_of<2>(all) + normal).norm() < 1e-12);
    std::erase_if(all, [](const auto& p) { return p.side > 0; });
    CHECK(normal_of<2>(all).isZero(0));
    CHECK(normal_of<2>({}).isZero(0));
    // A row that ends: its last particles, and none beside them, above a floor that goes on.
    cloud<2> corner;
    for (int i = -5; i < 5; ++i)
        for (int j = 0; j < 4; ++j) {
            const vector<2> below(0.5 * i + 0.25, -0.25 - 0.5 * j), above(0.5 * i - 0.15, 0.25 + 0.5 * j);
            if (below.norm() < reach) corner.push_back({-1, below});
            if (above[0] < 0 && above.norm() < reach) corner.push_back({1, above});
        }
    CHECK(degrees_off<2>(normal_of<2>(corner), vector<2>(0, 1)) < 1.2);
}
