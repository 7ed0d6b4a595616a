#include <tamis/core/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

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

#if TAMIS_VECTOR_BYTES > 0
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
/// Within units in the last place of the standard's, over all exponents, and of what is no ordinary number.
template <class T, class Ours, class Theirs> void as_the_standard(Ours ours, Theirs theirs, double least, double most) {
    using real = typename lane<T>::real;
    using limits = std::numeric_limits<real>;
    std::vector<real> all{real(0),
                          real(1),
                          limits::min(),
                          limits::denorm_min(),
                          limits::max(),
                          limits::infinity(),
                          -limits::infinity(),
                          real(-1),
                          limits::quiet_NaN()};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> between(least, most), near_one(0.7, 1.5);
    for (int k = 0; k < 20000; ++k) {
        const double power = between(random);
        all.push_back(static_cast<real>(power));
        all.push_back(
            static_cast<real>(std::exp2(std::min(std::abs(power), limits::max_exponent - 1.) * (k % 2 ? 1 : -1))));
        all.push_back(static_cast<real>(near_one(random)));
    }
    double worst = 0;
    for (const real a : all) {
        const real found = to(T(ours(T(a))))[std::size_t(width<T> - 1)], expected = theirs(a);
        CAPTURE(a, found, expected, width<T>);
        if (std::isnan(expected) || std::isinf(expected) || expected == 0)
            CHECK((found == expected || (std::isnan(found) && std::isnan(expected))));
        else
            worst = std::max(worst, static_cast<double>(std::abs(found - expected)) /
                                        std::max(double(limits::denorm_min()),
                                                 double(limits::epsilon()) * double(std::abs(expected))));
    }
    CHECK(worst < 2);
    CHECK(worst > 0);
}
template <class T> void functions_of_lanes() {
    using real = typename lane<T>::real;
    constexpr bool is_double = sizeof(real) == 8;
    as_the_standard<T>([](T a) { return exp(a); }, [](real a) { return std::exp(a); }, is_double ? -760 : -110,
                       is_double ? 720 : 95);
    as_the_standard<T>([](T a) { return log(a); }, [](real a) { return std::log(a); }, is_double ? -1080 : -150,
                       is_double ? 1030 : 130);
    const auto a = some<T>(1), b = some<T>(4);
    const T x = from<T>(a), y = from<T>(b);
    for (std::size_t l = 0; l < a.size(); ++l) {
        CHECK(to(T(abs(x)))[l] == std::abs(a[l]));
        CHECK(to(T(min(x, y)))[l] == std::min(a[l], b[l]));
        CHECK(to(T(max(x, y)))[l] == std::max(a[l], b[l]));
        CHECK(to(T(sqrt(x * x)))[l] == std::sqrt(a[l] * a[l]));
        CHECK(to(T(pow(abs(x), real(2.5))))[l] == std::pow(std::abs(a[l]), real(2.5)));
        CHECK(to(T(pow(abs(x), y)))[l] == std::pow(std::abs(a[l]), b[l]));
        CHECK(to(T(sin(x)))[l] == std::sin(a[l]));
        CHECK(to(T(-x))[l] == -a[l]);
        CHECK(to(T(x / (y * y + T(real(1)))))[l] == a[l] / (b[l] * b[l] + 1));
        for (const auto& [mask, expected] : {std::pair{x < y, a[l] < b[l]},
                                             {x <= y, a[l] <= b[l]},
                                             {x > y, a[l] > b[l]},
                                             {x >= y, a[l] >= b[l]},
                                             {x == y, a[l] == b[l]},
                                             {x != y, a[l] != b[l]},
                                             {!(x < y), a[l] >= b[l]},
                                             {x < y && y > T(real(0)), a[l] < b[l] && b[l] > 0},
                                             {x < y || y > T(real(0)), a[l] < b[l] || b[l] > 0}})
            CHECK(mask.get(int(l)) == expected);
        // One lane alone is seen.
        auto zeros = numbers<T>{};
        zeros[l] = 1;
        CHECK(lane<T>::any(from<T>(zeros) > T(real(0))));
    }
    CHECK(std::signbit(to(T(real(-0.)))[0]));
}
template <class Real, int W> void lanes_of_width() {
    if constexpr (W * int(sizeof(Real)) <= TAMIS_VECTOR_BYTES) {
        using T = typename lanes<W>::template type<Real>;
        STATIC_REQUIRE(std::is_same_v<T, lane_vector<Real, W>>);
        STATIC_REQUIRE(width<T> == W);
        lanes_are_independent<T>();
        shifts_lose_nothing<T>();
        exponential_of_all<T>();
        functions_of_lanes<T>();
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

#if TAMIS_VECTOR_BYTES > 0
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
