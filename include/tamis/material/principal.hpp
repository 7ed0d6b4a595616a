#pragma once
#include <tamis/core/lanes.hpp>
#include <tamis/core/unroll.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <limits>

namespace tamis::detail {

/// Principal values of a symmetric 3x3 tensor, in no order, and the unit vectors of their axes, the columns of `axes`.
template <class T> struct principal_form {
    std::array<T, 3> values;
    Eigen::Matrix<T, 3, 3, Eigen::DontAlign> axes;

    /// The tensor of the same axes with other principal values.
    auto with(const std::array<T, 3>& other) const {
        Eigen::Matrix<T, 3, 3, Eigen::DontAlign> all;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j) {
                T sum = other[0] * axes(i, 0) * axes(j, 0);
                for (int k = 1; k < 3; ++k) sum += other[static_cast<std::size_t>(k)] * axes(i, k) * axes(j, k);
                all(i, j) = all(j, i) = sum;
            }
        return all;
    }
};

/// One rotation of Jacobi's method in the plane of axes p and q, by which A_pq becomes 0; the smaller of the two
/// angles. None is made where it is no larger than `least` already.
template <int P, int Q, class T>
TAMIS_INLINE void turn_in_plane(std::array<std::array<T, 3>, 3>& A, principal_form<T>& found, const T& least) {
    using std::abs;
    using std::sqrt;
    constexpr std::size_t p = P, q = Q, r = 3 - P - Q;
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2);
    const T d = A[q][q] - A[p][p];
    const auto turns = abs(A[p][q]) > least;
    const T apq = select(turns, A[p][q], zero);
    const T below = abs(d) + sqrt(T(d * d + constant<T>(4) * apq * apq));
    const T size = two * apq / select(turns, below, one);
    const T t = select(d < zero, zero - size, size);
    const T c = one / sqrt(T(one + t * t)), s = t * c;
    A[p][p] -= t * apq;
    A[q][q] += t * apq;
    A[p][q] = A[q][p] = zero;
    const T arp = A[r][p], arq = A[r][q];
    A[r][p] = A[p][r] = c * arp - s * arq;
    A[r][q] = A[q][r] = s * arp + c * arq;
    for (int i = 0; i < 3; ++i) {
        const T vp = found.axes(i, P), vq = found.axes(i, Q);
        found.axes(i, P) = c * vp - s * vq;
        found.axes(i, Q) = s * vp + c * vq;
    }
}

/// Jacobi's method: five rounds at most leave, of any symmetric tensor, less than round-off beside the diagonal,
/// whether principal values are equal, nearly equal or far apart (Golub & Van Loan, *Matrix Computations*, 8.5). What
/// is below round-off turns nothing, so a lane has the same bits however many rounds the others need.
template <class Tensor> auto principal(const Tensor& given) {
    using T = typename Tensor::Scalar;
    std::array<std::array<T, 3>, 3> A;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) A[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = given(i, j);
    principal_form<T> found;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) found.axes(i, j) = constant<T>(i == j ? 1 : 0);
    using std::abs;
    using std::max;
    // Rotations keep the norm: what is small beside it now is small beside it later.
    const T size = abs(A[0][0]) + abs(A[1][1]) + abs(A[2][2]) + abs(A[0][1]) + abs(A[0][2]) + abs(A[1][2]);
    const T least = constant<T>(std::numeric_limits<typename lane<T>::real>::epsilon() / 64) * size;
    for (int round = 0; round < 5; ++round) {
        const T largest = max(T(max(T(abs(A[0][1])), T(abs(A[0][2])))), T(abs(A[1][2])));
        if (!lane<T>::any(largest > least)) break;
        turn_in_plane<0, 1>(A, found, least);
        turn_in_plane<0, 2>(A, found, least);
        turn_in_plane<1, 2>(A, found, least);
    }
    // What is not a number anywhere is none in all values.
    const T none = constant<T>(0) * size;
    found.values = {A[0][0] + none, A[1][1] + none, A[2][2] + none};
    return found;
}

}  // namespace tamis::detail
