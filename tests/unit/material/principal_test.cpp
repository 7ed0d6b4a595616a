#include <tamis/core/lane_functions.hpp>
#include <tamis/material/principal.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <random>

#include "catch.hpp"

using namespace tamis;
using tensor3 = Eigen::Matrix3d;

namespace {

/// Worst over lanes: of the tensor made again from its form, of axes that are not orthonormal, of values against
/// Eigen's; the first and last over the tensor's norm.
struct worst_of {
    double made = 0, axes = 0, values = 0;
};
template <class T, class Make> worst_of over(int count, const Make& make) {
    using full = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;
    constexpr int W = lane<T>::width;
    worst_of worst;
    for (int n = 0; n < count; ++n) {
        tensor3 given[W];
        full lanes_of;
        for (int l = 0; l < W; ++l) given[l] = make();
        for (int c = 0; c < 9; ++c) {
            double in[W];
            for (int l = 0; l < W; ++l) in[l] = given[l].data()[c];
            lanes_of.data()[c] = lane<T>::load(in);
        }
        const auto found = detail::principal(lanes_of);
        const auto again = found.with(found.values);
        for (int l = 0; l < W; ++l) {
            const auto in = [&](const T& a) {
                double out[W];
                lane<T>::store(out, a);
                return out[l];
            };
            tensor3 axes, made;
            std::array<double, 3> values{in(found.values[0]), in(found.values[1]), in(found.values[2])};
            for (int c = 0; c < 9; ++c) {
                axes.data()[c] = in(found.axes.data()[c]);
                made.data()[c] = in(again.data()[c]);
            }
            const double size = std::max(given[l].norm(), 1e-300);
            worst.made = std::max(worst.made, (made - given[l]).norm() / size);
            worst.axes = std::max(worst.axes, (axes.transpose() * axes - tensor3::Identity()).norm());
            std::sort(values.begin(), values.end());
            const Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<tensor3>(given[l]).eigenvalues();
            for (int k = 0; k < 3; ++k)
                worst.values =
                    std::max(worst.values, std::abs(values[static_cast<std::size_t>(k)] - expected[k]) / size);
        }
    }
    return worst;
}
template <class T> void is_right(int count, const auto& make) {
    const worst_of worst = over<T>(count, make);
    CHECK(worst.made < 1e-14);
    CHECK(worst.axes < 1e-14);
    CHECK(worst.values < 1e-14);
}

}  // namespace

TEST_CASE("principal: values and axes of symmetric tensors, in lanes and without") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto turned = [&](const Eigen::Vector3d& values) -> tensor3 {
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
        const tensor3 R = turn.toRotationMatrix(), made = R * values.asDiagonal() * R.transpose();
        return (made + made.transpose()) / 2;
    };
    const auto all = [&]<class T>(T) {
        is_right<T>(20000, [&] {
            tensor3 A;
            for (int c = 0; c < 9; ++c) A.data()[c] = any(random);
            return tensor3((A + A.transpose()) / 2);
        });
        // Equal and nearly equal ones, far apart, and of any size.
        is_right<T>(5000, [&] { return turned({1, 1, 1 + 1e-9 * any(random)}); });
        is_right<T>(5000, [&] { return turned({1, 1 + 1e-15, 2}); });
        is_right<T>(5000, [&] { return turned({1e-12, 1e-6, 1}); });
        is_right<T>(5000, [&] {
            return tensor3(std::pow(10, 100 * any(random)) * turned({any(random), any(random), 1}));
        });
        is_right<T>(10, [&] { return tensor3(tensor3::Identity()); });
        is_right<T>(10, [&] { return tensor3(tensor3::Zero()); });
        is_right<T>(10, [&] { return tensor3(tensor3::Ones()); });
    };
    all(0.);
    all(native_lanes::type<double>());
}

TEST_CASE("principal: a lane has the same bits whatever the others need, and what is not a number stays so") {
    using T = native_lanes::type<double>;
    using full = Eigen::Matrix<T, 3, 3, Eigen::DontAlign>;
    constexpr int W = lane<T>::width;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto filled = [&](const auto& of_lane) {
        full lanes_of;
        for (int c = 0; c < 9; ++c) {
            double in[W];
            for (int l = 0; l < W; ++l) in[l] = of_lane(l).data()[c];
            lanes_of.data()[c] = lane<T>::load(in);
        }
        return lanes_of;
    };
    const auto first_of = [](const T& a) {
        double out[W];
        lane<T>::store(out, a);
        return out[0];
    };
    for (int n = 0; n < 2000; ++n) {
        tensor3 nearly = tensor3::Identity(), rough;
        for (int c = 0; c < 9; ++c) rough.data()[c] = any(random);
        rough = (rough + rough.transpose()).eval();
        const double size = std::pow(10, -17 * std::abs(any(random)));
        nearly += size * rough;
        const auto alone = detail::principal(filled([&](int) { return nearly; })),
                   beside = detail::principal(filled([&](int l) { return l == 0 ? nearly : rough; }));
        for (std::size_t k = 0; k < 3; ++k) REQUIRE(first_of(alone.values[k]) == first_of(beside.values[k]));
        for (int c = 0; c < 9; ++c) REQUIRE(first_of(alone.axes.data()[c]) == first_of(beside.axes.data()[c]));
    }
    for (int c = 0; c < 9; ++c) {
        tensor3 broken = tensor3::Identity();
        broken.data()[c] = broken(c % 3, c / 3) = broken(c / 3, c % 3) = std::nan("");
        const auto found = detail::principal(filled([&](int) { return broken; }));
        for (const T& value : found.values) CHECK(std::isnan(first_of(value)));
    }
}
