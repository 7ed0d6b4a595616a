#pragma once
#include <tamis/core/lanes.hpp>

namespace tamis {

/// Dimension and scalar of a computation. T is what kernels compute with: lanes of `real`.
template <int Dim, class T> struct space {
    static_assert(Dim >= 1 && Dim <= 3, "tamis: the dimension is 1, 2 or 3");
    static constexpr int dim = Dim;
    static constexpr int width = lane<T>::width;
    using scalar = T;
    using real = typename lane<T>::real;
    // Eigen aligns 2-vectors of double to 16 bytes, which would leave holes between the columns of a slot.
    static constexpr int align = width == 1 ? static_cast<int>(Eigen::DontAlign) : 0;
    using vector = Eigen::Matrix<T, Dim, 1, align>;
    using tensor = Eigen::Matrix<T, Dim, Dim, align>;
};

/// A point or vector of the problem, as users see it.
template <int Dim, class Real> using point = Eigen::Matrix<Real, Dim, 1, Eigen::DontAlign>;
/// A tensor of the problem, as users see it.
template <int Dim, class Real> using matrix = Eigen::Matrix<Real, Dim, Dim, Eigen::DontAlign>;

}  // namespace tamis
