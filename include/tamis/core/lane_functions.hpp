#pragma once
#include <tamis/core/lane_vector.hpp>

#include <cmath>
#include <limits>

#if TAMIS_VECTOR_BYTES > 0
namespace tamis {

/// f(number) of every lane, one after the other: for functions that have no form for vectors.
template <class Real, int W, class F> lane_vector<Real, W> lanewise(lane_vector<Real, W> a, const F& f) {
    auto raw = a.get();
    for (int l = 0; l < W; ++l) raw[l] = f(raw[l]);
    return lane_vector<Real, W>(raw);
}

namespace detail {

/// Parts of a floating-point number of IEEE 754 with `digits` binary digits after the point.
template <class Real> struct number_format {
    static constexpr bool is_double = sizeof(Real) == 8;
    using bits = std::conditional_t<is_double, std::uint64_t, std::uint32_t>;
    static constexpr int digits = is_double ? 52 : 23;
    static constexpr bits bias = is_double ? 1023 : 127;
    /// Added to a number of less than 2^(digits - 1), it leaves the nearest whole number in the last digits.
    static constexpr Real to_whole = is_double ? Real(6755399441055744.) : Real(12582912.);
    // log 2, the first part with zeros at its end, so that its product with an exponent is exact.
    static constexpr Real log_2_first = is_double ? Real(6.93147180369123816490e-01) : Real(6.9314575195e-01);
    static constexpr Real log_2_rest = is_double ? Real(1.90821492927058770002e-10) : Real(1.4286068203e-06);
    static constexpr Real infinity = std::numeric_limits<Real>::infinity();
};

/// e^a = 2^k e^r, |r| <= (log 2) / 2, with the power series of e^r. Within two units in the last place.
template <class Real, int W> lane_vector<Real, W> exponential_of(const lane_vector<Real, W>& a) {
    using format = number_format<Real>;
    using T = lane_vector<Real, W>;
    using bits = typename raw_vector<Real, W>::bits;
    // Beyond these the result is 0 or infinity, also by what follows.
    constexpr Real least = format::is_double ? Real(-746) : Real(-104), most = format::is_double ? Real(710) : Real(89);
    // In this order what is no number stays.
    const T x = min(T(most), max(T(least), a));
    const T shifted = x * T(Real(1.44269504088896340736)) + T(format::to_whole);
    const T k = shifted - T(format::to_whole);
    const T r = (x - k * T(format::log_2_first)) - k * T(format::log_2_rest);
    constexpr int terms = format::is_double ? 13 : 7;
    T sum(Real(1));
    for (int n = terms; n > 0; --n) sum = sum * r * T(Real(1) / Real(n)) + T(Real(1));
    // 2^k in two factors: its exponent may be one that no number has. 4096 keeps shifts away from signs.
    constexpr typename format::bits offset = format::is_double ? 4096 : 512;
    const bits whole =
        __builtin_bit_cast(bits, shifted.get()) - __builtin_bit_cast(bits, T(format::to_whole).get()) + offset;
    const bits half = (whole >> 1) - offset / 2;
    const bits rest = whole - offset - half;
    const auto power = [](const bits& exponent) {
        return T(__builtin_bit_cast(typename T::raw, (exponent + format::bias) << format::digits));
    };
    // What was no number took part in no comparison, and is none still.
    return sum * power(half) * power(rest);
}

/// log a = e log 2 + log(1 + f) for a = 2^e (1 + f), 1 + f between the roots of 1/2 and 2. With s = f / (2 + f),
/// log(1 + f) = f - (f^2 / 2 - s (f^2 / 2 + R)), R = 2/3 s^2 + 2/5 s^4 + ... Within two units in the last place.
template <class Real, int W> lane_vector<Real, W> logarithm_of(const lane_vector<Real, W>& a) {
    using format = number_format<Real>;
    using T = lane_vector<Real, W>;
    using raw = typename T::raw;
    using bits = typename raw_vector<Real, W>::bits;
    constexpr Real tiny = std::numeric_limits<Real>::min();
    constexpr Real to_normal = Real(format::is_double ? 18014398509481984. : 33554432.);  // 2^54, 2^25
    const auto subnormal = a < T(tiny);
    const T x = select_lanes(subnormal, a * T(to_normal), a);
    const T least_exponent = select_lanes(subnormal, T(Real(format::is_double ? 54 : 25)), T(Real(0)));
    // From sqrt(1/2) on the exponent counts as one more.
    constexpr typename format::bits root_of_half = format::is_double ? 0x3FE6A09E667F3BCDull : 0x3F3504F3u;
    constexpr typename format::bits one = format::bias << format::digits;
    const bits from_root = __builtin_bit_cast(bits, x.get()) - root_of_half + one;
    const bits exponent = from_root >> format::digits;  // + bias
    const T m(__builtin_bit_cast(raw, __builtin_bit_cast(bits, x.get()) - (exponent << format::digits) + one));
    // A whole number in the last digits of a number.
    constexpr typename format::bits as_number = (format::bias + format::digits) << format::digits;
    constexpr Real first_of_those = format::is_double ? Real(4503599627370496.) : Real(8388608.);
    const T e =
        T(__builtin_bit_cast(raw, exponent | as_number)) - T(first_of_those + Real(format::bias)) - least_exponent;
    const T f = m - T(Real(1)), s = f / (T(Real(2)) + f), z = s * s, half_square = T(Real(0.5)) * f * f;
    constexpr int terms = format::is_double ? 11 : 5;
    T series(Real(0));
    for (int n = terms; n > 0; --n) series = (series + T(Real(2) / Real(2 * n + 1))) * z;
    const T found =
        e * T(format::log_2_first) - ((half_square - (s * (half_square + series) + e * T(format::log_2_rest))) - f);
    const T outside = select_lanes(a == T(Real(0)), T(-format::infinity), T(std::numeric_limits<Real>::quiet_NaN()));
    return select_lanes(a > T(Real(0)), select_lanes(a < T(format::infinity), found, a), outside);
}

}  // namespace detail

/// Functions of lanes, for laws. exp and log work on all lanes at once, as sqrt, abs, min and max do; the others go
/// from lane to lane.
/// @{
template <class Real, int W> lane_vector<Real, W> exp(const lane_vector<Real, W>& a) {
    return detail::exponential_of(a);
}
template <class Real, int W> lane_vector<Real, W> log(const lane_vector<Real, W>& a) { return detail::logarithm_of(a); }
#define TAMIS_EACH_LANE(name)                                                               \
    template <class Real, int W> lane_vector<Real, W> name(const lane_vector<Real, W>& a) { \
        return lanewise(a, [](Real x) { return std::name(x); });                            \
    }
TAMIS_EACH_LANE(sin)
TAMIS_EACH_LANE(cos)
TAMIS_EACH_LANE(tan)
TAMIS_EACH_LANE(atan)
TAMIS_EACH_LANE(sinh)
TAMIS_EACH_LANE(cosh)
TAMIS_EACH_LANE(tanh)
TAMIS_EACH_LANE(cbrt)
TAMIS_EACH_LANE(floor)
#undef TAMIS_EACH_LANE
/// @}
/// base^exponent of every lane.
/// @{
template <class Real, int W>
lane_vector<Real, W> pow(const lane_vector<Real, W>& base, const lane_vector<Real, W>& exponent) {
    int l = 0;
    return lanewise(base, [&](Real x) { return std::pow(x, exponent.get(l++)); });
}
template <class Real, int W> lane_vector<Real, W> pow(const lane_vector<Real, W>& base, Real exponent) {
    return lanewise(base, [&](Real x) { return std::pow(x, exponent); });
}
/// @}

}  // namespace tamis
#endif
