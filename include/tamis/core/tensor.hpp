#pragma once
#include <tamis/core/lanes.hpp>
#include <tamis/core/unroll.hpp>

namespace tamis::detail {

/// Determinant of a 1 x 1, 2 x 2 or 3 x 3 matrix of lanes or of plain numbers.
template <class Tensor> TAMIS_INLINE typename Tensor::Scalar determinant(const Tensor& a) {
    constexpr int D = Tensor::RowsAtCompileTime;
    static_assert(D >= 1 && D <= 3 && Tensor::ColsAtCompileTime == D);
    if constexpr (D == 1)
        return a(0, 0);
    else if constexpr (D == 2)
        return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0);
    else
        return a(0, 0) * (a(1, 1) * a(2, 2) - a(1, 2) * a(2, 1)) - a(0, 1) * (a(1, 0) * a(2, 2) - a(1, 2) * a(2, 0)) +
               a(0, 2) * (a(1, 0) * a(2, 1) - a(1, 1) * a(2, 0));
}

/// det A A^-T of a 1 x 1, 2 x 2 or 3 x 3 matrix of lanes or of plain numbers.
template <class Tensor> TAMIS_INLINE Tensor cofactor(const Tensor& a) {
    constexpr int D = Tensor::RowsAtCompileTime;
    static_assert(D >= 1 && D <= 3 && Tensor::ColsAtCompileTime == D);
    Tensor c;
    if constexpr (D == 1)
        c(0, 0) = constant<typename Tensor::Scalar>(1);
    else if constexpr (D == 2) {
        c(0, 0) = a(1, 1);
        c(0, 1) = -a(1, 0);
        c(1, 0) = -a(0, 1);
        c(1, 1) = a(0, 0);
    } else
        unroll<9>([&](auto k) TAMIS_INLINE_LAMBDA {
            constexpr int i = k % 3, j = k / 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
        });
    return c;
}

/// `value` on the diagonal, 0 beside it, whatever the value.
template <class Tensor> TAMIS_INLINE Tensor isotropic(const typename Tensor::Scalar& value) {
    constexpr int D = Tensor::RowsAtCompileTime;
    static_assert(Tensor::ColsAtCompileTime == D);
    Tensor all;
    unroll<D * D>([&](auto k) TAMIS_INLINE_LAMBDA {
        constexpr int i = k % D, j = k / D;
        all(i, j) = i == j ? value : constant<typename Tensor::Scalar>(0);
    });
    return all;
}

}  // namespace tamis::detail
