#include <tamis/core/space.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "catch.hpp"

using namespace tamis;

namespace {

template <class T> constexpr int width = lane<T>::width;
template <class T> using numbers = std::array<typename lane<T>::real, static_cast<std::size_t>(width<T>)>;

template <class T> T from(const numbers<T>& a) { return lane<T>::load(a.data()); }
template <class T> numbers<T> to(const T& a) {
    numbers<T> out;
    lane<T>::store(out.data(), a);
    return out;
}
template <class T> numbers<T> some(int start) {
    numbers<T> a;
    for (std::size_t l = 0; l < a.size(); ++l)
        a[l] = static_cast<typename lane<T>::real>((start + 7 * int(l)) % 11 - 5);
    return a;
}

/// Exponentials, those of numbers that are none included: empty lanes may have them.
template <class T> void exponential_of_all() {
    using real = typename lane<T>::real;
    const real infinity = std::numeric_limits<real>::infinity();
    for (const real a : {real(0), real(1.5), real(-80), real(20000), real(-20000), infinity, -infinity}) {
        const real expected = std::exp(a);
        CAPTURE(a, width<T>);
        for (const real found : to(T(detail::exponential(T(a)))))
            CHECK((found == expected || std::abs(found / expected - 1) < 4 * std::numeric_limits<real>::epsilon()));
    }
    const T none = detail::exponential(T(std::numeric_limits<real>::quiet_NaN()));
    for (const real found : to(none)) CHECK(std::isnan(found));
}
template <class T> void lanes_are_independent() {
    using real = typename lane<T>::real;
    const auto a = some<T>(1), b = some<T>(4);
    const T x = from<T>(a), y = from<T>(b);
    CHECK(to(x) == a);
    const auto chosen = to(T(select(x < y, x + y, y)));
    const auto order = to(lane<T>::iota());
    bool any = false;
    for (std::size_t l = 0; l < a.size(); ++l) {
        CHECK(chosen[l] == (a[l] < b[l] ? a[l] + b[l] : b[l]));
        CHECK(order[l] == static_cast<real>(l));
        CHECK(to(constant<T>(0.5))[l] == real(0.5));
        any = any || a[l] > real(4);
    }
    CHECK(lane<T>::any(x > T(real(4))) == any);
    CHECK_FALSE(lane<T>::any(x != x));

    using tensor = typename space<2, T>::tensor;
    tensor m;
    m << x, y, y, x;
    const tensor square = m * m;
    for (std::size_t l = 0; l < a.size(); ++l) {
        CHECK(to(square(0, 0))[l] == a[l] * a[l] + b[l] * b[l]);
        CHECK(to(square(1, 0))[l] == 2 * a[l] * b[l]);
    }
}

#if TAMIS_XSIMD
template <class T, int K> void shifted_by() {
    const auto a = some<T>(3);
    const auto up = to(lane<T>::template up<K>(from<T>(a)));
    const auto over = to(lane<T>::template over<K>(from<T>(a)));
    for (int l = 0; l < width<T>; ++l) {
        const auto at = [](int k) { return static_cast<std::size_t>(k); };
        CHECK(up[at(l)] == (l < K ? 0 : a[at(l - K)]));
        CHECK(over[at(l)] == (l < K ? a[at(width<T> - K + l)] : 0));
    }
    const auto b = some<T>(8);
    const auto slid = to(lane<T>::template slide<K>(from<T>(a), from<T>(b)));
    for (int l = 0; l < width<T>; ++l) {
        const auto k = static_cast<std::size_t>(K + l), w = static_cast<std::size_t>(width<T>);
        CHECK(slid[static_cast<std::size_t>(l)] == (k < w ? a[k] : b[k - w]));
    }
}
template <class T> void shifts_lose_nothing() {
    [&]<int... K>(std::integer_sequence<int, K...>) { (shifted_by<T, K + 1>(), ...); }
    (std::make_integer_sequence<int, (width<T> < 4 ? width<T> : 4)>{});
}
template <class Real, std::size_t W> void lanes_of_width() {
    using T = xsimd::make_sized_batch_t<Real, W>;
    if constexpr (!std::is_void_v<T>) {
        STATIC_REQUIRE(std::is_same_v<typename lanes<int{W}>::template type<Real>, T>);
        STATIC_REQUIRE(width<T> == int{W});
        lanes_are_independent<T>();
        shifts_lose_nothing<T>();
        exponential_of_all<T>();
    }
}
#endif

}  // namespace

TEST_CASE("lanes: a plain number is one lane") {
    STATIC_REQUIRE(width<double> == 1);
    STATIC_REQUIRE(std::is_same_v<lanes<1>::type<float>, float>);
    STATIC_REQUIRE(std::is_same_v<one_lane::type<long double>, long double>);
    lanes_are_independent<float>();
    lanes_are_independent<double>();
    lanes_are_independent<long double>();
    exponential_of_all<double>();
    CHECK(lane<double>::floor(2.5) == 2);
    CHECK(lane<double>::floor(-0.5) == -1);
    CHECK(lane<float>::floor(-3.f) == -3);
}

#if TAMIS_XSIMD
TEST_CASE("lanes: vectors compute what their lanes would, at every width of this processor") {
    STATIC_REQUIRE(width<native_lanes::type<float>> == 2 * width<native_lanes::type<double>>);
    lanes_of_width<double, 2>();
    lanes_of_width<double, 4>();
    lanes_of_width<double, 8>();
    lanes_of_width<float, 4>();
    lanes_of_width<float, 8>();
    lanes_of_width<float, 16>();
}
#endif
