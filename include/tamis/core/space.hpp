#pragma once
#include <tamis/core/lanes.hpp>

#include <type_traits>

namespace tamis {

/// Dimension and scalar of a computation. T is what kernels compute with: lanes of `real`.
template <int Dim, class T> struct space {
    static_assert(Dim >= 1 && Dim <= 3, "tamis: the dimension is 1, 2 or 3");
    /// Number of dimensions.
    static constexpr int dim = Dim;
    /// Number of lanes.
    static constexpr int width = lane<T>::width;
    /// What kernels compute with.
    using scalar = T;
    /// The number in a lane.
    using real = typename lane<T>::real;
    /// Alignment of small matrices: Eigen's own, to their size, would leave holes between the columns of a slot.
    static constexpr int align = static_cast<int>(Eigen::DontAlign);
    /// Dim numbers.
    using vector = Eigen::Matrix<T, Dim, 1, align>;
    /// Dim x Dim numbers.
    using tensor = Eigen::Matrix<T, Dim, Dim, align>;
    /// A tensor of three axes in every dimension.
    using tensor_3x3 = Eigen::Matrix<T, 3, 3, align>;
};

/// A point or vector of the problem, as users see it.
template <int Dim, class Real> using point = Eigen::Matrix<Real, Dim, 1, Eigen::DontAlign>;
/// A tensor of the problem, as users see it.
template <int Dim, class Real> using matrix = Eigen::Matrix<Real, Dim, Dim, Eigen::DontAlign>;

namespace detail {

/// A point from what a user's function gives: a vector of any number type, or a plain number in 1D.
template <int Dim, class Real, class Value> point<Dim, Real> as_point(const Value& value) {
    if constexpr (Dim == 1 && std::is_convertible_v<Value, Real>)
        return point<Dim, Real>(static_cast<Real>(value));
    else {
        static_assert(
            static_cast<int>(Value::SizeAtCompileTime) == Dim,
            "tamis: a vector of another dimension than the grid's; give as many components as the grid has axes");
        if constexpr (std::is_same_v<typename Value::Scalar, Real>)
            return point<Dim, Real>(value);
        else
            return point<Dim, Real>(value.template cast<Real>());
    }
}
/// The same, of the kind of a given point.
template <class Point, class Value> Point as_point_like(const Point&, const Value& value) {
    return as_point<static_cast<int>(Point::SizeAtCompileTime), typename Point::Scalar>(value);
}

}  // namespace detail
}  // namespace tamis
