#pragma once
#include <tamis/core/values.hpp>

namespace tamis::detail {

/// A tensor times the slope of a weight, multiplied out where it is added to something. Lives as long as its factors.
template <class S, class Tensor, class Slope> struct tensor_on_slope {
    const Tensor& t;
    const Slope& g;

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector all = S::vector::Constant(typename S::scalar(typename S::real(0)));
        all += *this;
        return all;
    }

    TAMIS_INLINE friend void operator+=(typename S::vector& to, const tensor_on_slope& product) {
        product.g.multiply(product.t, to, [](auto& sum, const auto&... a) TAMIS_INLINE_LAMBDA { sum += (a * ...); });
    }
    TAMIS_INLINE friend void operator-=(typename S::vector& to, const tensor_on_slope& product) {
        product.g.multiply(product.t, to, [](auto& sum, const auto&... a) TAMIS_INLINE_LAMBDA { sum -= (a * ...); });
    }
};

/// Slope of a weight that is a product over the axes. Times a tensor, it keeps what is the same along a row of nodes
/// apart, so that it is computed once a row.
template <class S> struct slope_of {
    using T = typename S::scalar;
    T dx, wx, w, d1, d2;  // slope and weight along x; weight over y and z, and its slopes

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector g;
        if constexpr (S::dim == 1)
            g[0] = dx;
        else {
            g[0] = dx * w;
            g[1] = wx * d1;
            if constexpr (S::dim == 3) g[2] = wx * d2;
        }
        return g;
    }
    TAMIS_INLINE T operator[](int d) const {
        const typename S::vector g = *this;
        return g[d];
    }
    template <class Tensor>
    friend TAMIS_INLINE tensor_on_slope<S, Tensor, slope_of> operator*(const Eigen::MatrixBase<Tensor>& t,
                                                                       const slope_of& g) {
        return {t.derived(), g};
    }
    /// to += sign t g, components in two fused operations.
    template <class Tensor, class Fused>
    TAMIS_INLINE void multiply(const Tensor& t, typename S::vector& to, Fused add) const {
        unroll<S::dim>([&](auto index) TAMIS_INLINE_LAMBDA {
            constexpr int c = index;
            if constexpr (S::dim == 1)
                add(to[c], t(c, 0), dx);
            else {
                add(to[c], T(t(c, 0) * w), dx);
                if constexpr (S::dim == 2)
                    add(to[c], T(t(c, 1) * d1), wx);
                else
                    add(to[c], T(t(c, 1) * d1 + t(c, 2) * d2), wx);
            }
        });
    }
};

/// As slope_of, of the sum of all weights of a row, which does not change along x.
template <class S> struct slope_of_row {
    using T = typename S::scalar;
    T d1, d2;

    TAMIS_INLINE operator typename S::vector() const {
        typename S::vector g;
        g[0] = T(typename S::real(0));
        if constexpr (S::dim > 1) g[1] = d1;
        if constexpr (S::dim == 3) g[2] = d2;
        return g;
    }
    template <class Tensor>
    friend TAMIS_INLINE tensor_on_slope<S, Tensor, slope_of_row> operator*(const Eigen::MatrixBase<Tensor>& t,
                                                                           const slope_of_row& g) {
        return {t.derived(), g};
    }
    template <class Tensor, class Fused>
    TAMIS_INLINE void multiply(const Tensor& t, typename S::vector& to, Fused add) const {
        static_assert(S::dim > 1);
        unroll<S::dim>([&](auto index) TAMIS_INLINE_LAMBDA {
            constexpr int c = index;
            if constexpr (S::dim == 2)
                add(to[c], T(t(c, 1) * d1));
            else  // as for the nodes of the row: compilers make it once
                add(to[c], T(t(c, 1) * d1 + t(c, 2) * d2));
        });
    }
};

}  // namespace tamis::detail
