#pragma once
#include <tamis/core/config.hpp>

#include <utility>

namespace tamis::detail {

template <int... I, class Kernel>
TAMIS_INLINE constexpr void unroll_sequence(std::integer_sequence<int, I...>, Kernel&& kernel) {
    (kernel(std::integral_constant<int, I>{}), ...);
}

/// kernel(0), ..., kernel(N - 1) with compile-time indices: a run-time index would keep small matrices out of
/// registers.
template <int N, class Kernel> TAMIS_INLINE constexpr void unroll(Kernel&& kernel) {
    unroll_sequence(std::make_integer_sequence<int, N>{}, kernel);
}

constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

}  // namespace tamis::detail
