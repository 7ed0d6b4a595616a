#include <tamis/core/tensor.hpp>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace tamis;

TEST_CASE("tensor: the determinant is that of Eigen") {
    const Eigen::Matrix3d a = (Eigen::Matrix3d() << 2, -1, 0.5, 3, 4, -2, 1, 0.25, 5).finished();
    CHECK_THAT(detail::determinant(a), Catch::Matchers::WithinRel(a.determinant(), 1e-12));
    const Eigen::Matrix2d b = a.topLeftCorner<2, 2>();
    CHECK_THAT(detail::determinant(b), Catch::Matchers::WithinRel(b.determinant(), 1e-12));
    CHECK(detail::determinant(Eigen::Matrix<double, 1, 1>(a(0, 0))) == 2);
}

TEST_CASE("tensor: isotropic is a number on the diagonal and 0 beside it, whatever the number") {
    CHECK(detail::isotropic<Eigen::Matrix3d>(2.5) == 2.5 * Eigen::Matrix3d::Identity());
    CHECK(detail::isotropic<Eigen::Matrix<float, 2, 2>>(-3) == -3.f * Eigen::Matrix2f::Identity());
    CHECK(detail::isotropic<Eigen::Matrix<double, 1, 1>>(7)(0, 0) == 7);
    const Eigen::Matrix2d none = detail::isotropic<Eigen::Matrix2d>(std::numeric_limits<double>::quiet_NaN());
    CHECK(none(0, 1) == 0);
    CHECK(std::isnan(none(1, 1)));
}
