#pragma once
#include <tamis/core/lanes.hpp>

namespace tamis::detail {

/// base^exponent for a positive base, lane by lane; NaN where it is negative. A function of its own: exponentials and
/// logarithms of lanes are long, and to compile them anew for every pass of every composition would take longer than a
/// call costs.
template <class T> TAMIS_NOINLINE T power(const T& base, double exponent) {
    return exponential(T(constant<T>(exponent) * logarithm(base)));
}

}  // namespace tamis::detail
