#pragma once
#include <tamis/core/config.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#if TAMIS_XSIMD
#include <xsimd/xsimd.hpp>
#endif

namespace tamis {

/// How kernels see a scalar T of `width` independent lanes of `real`. The primary template is one lane: float, double,
/// long double, or a dual number (for which `floor` is found by argument-dependent look-up, or specialised).
template <class T> struct lane {
    using real = T;
    static constexpr int width = 1;
    TAMIS_INLINE static T load(const real* from) { return *from; }
    TAMIS_INLINE static void store(real* to, const T& value) { *to = value; }
    TAMIS_INLINE static T iota() { return T(0); }
    TAMIS_INLINE static bool any(bool mask) { return mask; }
    template <class Mask> TAMIS_INLINE static T select(const Mask& mask, const T& yes, const T& no) {
        return mask ? yes : no;
    }
    TAMIS_INLINE static int floor(const T& a) {
        using std::floor;
        return static_cast<int>(floor(a));
    }
};

/// Execution of kernels one particle at a time.
struct one_lane {
    template <class Real> using type = Real;
};

#if TAMIS_XSIMD
template <class Real, class Arch> struct lane<xsimd::batch<Real, Arch>> {
    using T = xsimd::batch<Real, Arch>;
    using real = Real;
    static constexpr int width = static_cast<int>(T::size);
    TAMIS_INLINE static T load(const real* from) { return T::load_unaligned(from); }
    TAMIS_INLINE static void store(real* to, const T& value) { value.store_unaligned(to); }
    TAMIS_INLINE static T iota() {
        alignas(64) Real a[width];
        for (int l = 0; l < width; ++l) a[l] = static_cast<Real>(l);
        return load(a);
    }
    template <class Mask> TAMIS_INLINE static bool any(const Mask& mask) { return xsimd::any(mask); }
    template <class Mask> TAMIS_INLINE static T select(const Mask& mask, const T& yes, const T& no) {
        return xsimd::select(mask, yes, no);
    }

    /// Lanes moved up by K places; zeros come in at the bottom.
    template <int K> TAMIS_INLINE static T up(const T& a) {
        return shuffle(
            a, [](int l) { return l < K ? 0 : width + l - K; }, zero_first{});
    }
    /// The lanes that `up<K>` moved out at the top, at the bottom; zeros elsewhere.
    template <int K> TAMIS_INLINE static T over(const T& a) {
        return shuffle(
            a, [](int l) { return l < K ? width - K + l : width; }, zero_last{});
    }

    /// W lanes from the K-th of `low` on, the last ones from `high`.
    template <int K> TAMIS_INLINE static T slide(const T& low, const T& high) {
        return slide_by<K>(__builtin_bit_cast(raw, low), __builtin_bit_cast(raw, high),
                           std::make_integer_sequence<int, width>{});
    }

  private:
    typedef Real raw __attribute__((vector_size(sizeof(T))));
    static_assert(sizeof(raw) == sizeof(Real) * static_cast<unsigned>(width));
    struct zero_first {};
    struct zero_last {};
    template <class Place, class Order> TAMIS_INLINE static T shuffle(const T& a, Place, Order) {
        return place<Place>(__builtin_bit_cast(raw, a), Order{}, std::make_integer_sequence<int, width>{});
    }
    template <int K, int... L> TAMIS_INLINE static T slide_by(raw low, raw high, std::integer_sequence<int, L...>) {
        return __builtin_bit_cast(T, __builtin_shufflevector(low, high, (K + L)...));
    }
    template <class Place, int... L> TAMIS_INLINE static T place(raw a, zero_first, std::integer_sequence<int, L...>) {
        return __builtin_bit_cast(T, __builtin_shufflevector(raw{}, a, Place{}(L)...));
    }
    template <class Place, int... L> TAMIS_INLINE static T place(raw a, zero_last, std::integer_sequence<int, L...>) {
        return __builtin_bit_cast(T, __builtin_shufflevector(a, raw{}, Place{}(L)...));
    }
};

/// The widest vectors the compiler's target has.
struct native_lanes {
    template <class Real, bool Vectors = xsimd::has_simd_register<Real>::value> struct choose { using type = Real; };
    template <class Real> struct choose<Real, true> { using type = xsimd::batch<Real>; };
    template <class Real> using type = typename choose<Real>::type;
};
/// Vectors of W lanes, where the target has them.
template <int W> struct lanes {
    static_assert(W >= 1, "tamis: lanes<W> needs W >= 1");
    template <class Real> struct choose {
        using type = xsimd::make_sized_batch_t<Real, static_cast<std::size_t>(W)>;
        static_assert(!std::is_void_v<type>,
                      "tamis: this target has no vectors of that many lanes; use native_lanes, or compile with "
                      "-march=native");
    };
    template <class Real> using type = typename choose<Real>::type;
};
template <> struct lanes<1> : one_lane {};
#else
/// Without xsimd kernels run one particle at a time.
using native_lanes = one_lane;
template <int W> struct lanes : one_lane {
    static_assert(W == 1, "tamis: lanes<W> with W > 1 needs xsimd; install it, or use lanes<1>");
};
#endif

/// mask ? yes : no, lane by lane: how a law branches.
template <class Mask, class T>
TAMIS_INLINE T select(const Mask& mask, const T& yes, const std::type_identity_t<T>& no) {
    return lane<T>::select(mask, yes, no);
}

/// A number in every lane of T: how a law with parameters in double meets float or dual lanes.
template <class T, class Number> TAMIS_INLINE T constant(const Number& number) {
    return T(static_cast<typename lane<T>::real>(number));
}

namespace detail {

/// f of every lane.
template <class T, class F> T each_lane(const T& a, F f) {
    typename lane<T>::real values[lane<T>::width];
    lane<T>::store(values, a);
    for (auto& value : values) value = f(value);
    return lane<T>::load(values);
}
#if defined(__OPTIMIZE__)
inline constexpr bool vector_functions = true;
#else
// xsimd 8 compiles its AVX-512 logarithm only where intrinsics are functions; without optimisation GCC has macros.
inline constexpr bool vector_functions = false;
#endif

/// Natural logarithm and exponential, lane by lane; of dual numbers by argument-dependent look-up.
template <class T> TAMIS_INLINE T logarithm(const T& a) {
    using std::log;
    if constexpr (lane<T>::width > 1 && !vector_functions)
        return each_lane(a, [](auto x) { return std::log(x); });
    else
        return log(a);
}
template <class T> TAMIS_INLINE T exponential(const T& a) {
    using std::exp;
    if constexpr (lane<T>::width > 1 && !vector_functions)
        return each_lane(a, [](auto x) { return std::exp(x); });
    else if constexpr (lane<T>::width > 1) {
        // xsimd makes whole numbers of the argument before it looks how large it is: of infinity and NaN, which empty
        // lanes may have, that is undefined.
        using real = typename lane<T>::real;
        const T most(real(1000)), zero(real(0)), infinity(std::numeric_limits<real>::infinity());
        const auto too_large = a > most, too_small = a < -most;
        const auto fits = (a <= most) & (a >= -most);
        const T value = exp(lane<T>::select(fits, a, zero));
        return lane<T>::select(fits, value, lane<T>::select(too_large, infinity, lane<T>::select(too_small, zero, a)));
    } else
        return exp(a);
}

/// Nodes with less mass than this take no part: the inverse would be no number.
template <class Real> Real least_mass() {
    if constexpr (std::numeric_limits<Real>::is_specialized)
        return Real(std::numeric_limits<Real>::min());
    else
        return Real(std::numeric_limits<double>::min());
}

/// 1/m, and 0 where there is no mass, or so little that its inverse is no number.
template <class T> TAMIS_INLINE T inverse_or_zero(const T& mass) {
    using real = typename lane<T>::real;
    const T one(real(1));
    const auto enough = mass >= T(least_mass<real>());
    const T inverse_of = one / select(enough, mass, one);
    return select(enough, inverse_of, T(real(0)));
}

/// A number as double, for decisions and messages; of a dual number, its value.
template <class Number> double to_double(const Number& a) {
    if constexpr (requires { static_cast<double>(a); })
        return static_cast<double>(a);
    else
        return static_cast<double>(a.value());
}

}  // namespace detail
}  // namespace tamis

#if TAMIS_XSIMD
namespace Eigen {
template <class Real_, class Arch> struct NumTraits<xsimd::batch<Real_, Arch>> : GenericNumTraits<Real_> {
    using Lanes = xsimd::batch<Real_, Arch>;
    using Real = Lanes;
    using NonInteger = Lanes;
    using Nested = Lanes;
    using Literal = Lanes;  // products with a plain number must stay in lanes
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 0,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
};
}  // namespace Eigen
#endif
