#pragma once
#include <tamis/core/config.hpp>
#include <tamis/core/lane_functions.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace tamis {

/// How kernels see a scalar T of `width` independent lanes of `real`. The primary template is one lane: float, double,
/// long double, or a dual number (for which `floor` is found by argument-dependent look-up, or specialised).
template <class T> struct lane {
    /// The number in a lane, and how many lanes there are.
    /// @{
    using real = T;
    static constexpr int width = 1;
    /// @}
    /// Reads `width` numbers.
    TAMIS_INLINE static T load(const real* from) { return *from; }
    /// Writes `width` numbers.
    TAMIS_INLINE static void store(real* to, const T& value) { *to = value; }
    /// 0, 1, 2, ... in the lanes.
    TAMIS_INLINE static T iota() { return T(0); }
    /// Is a mask true in any lane?
    TAMIS_INLINE static bool any(bool mask) { return mask; }
    /// mask ? yes : no, lane by lane.
    template <class Mask> TAMIS_INLINE static T select(const Mask& mask, const T& yes, const T& no) {
        return mask ? yes : no;
    }
    /// The largest whole number that is not above a.
    TAMIS_INLINE static int floor(const T& a) {
        using std::floor;
        return static_cast<int>(floor(a));
    }
};

/// Execution of kernels one particle at a time.
struct one_lane {
    template <class Real> using type = Real;
};

#if TAMIS_VECTOR_BYTES > 0
/// @cond
template <class Real, int W> struct lane<lane_vector<Real, W>> {
    using T = lane_vector<Real, W>;
    using real = Real;
    static constexpr int width = W;
    TAMIS_INLINE static T load(const real* from) {
        raw a;
        __builtin_memcpy(&a, from, sizeof(a));
        return T(a);
    }
    TAMIS_INLINE static void store(real* to, const T& value) {
        const raw a = value.get();
        __builtin_memcpy(to, &a, sizeof(a));
    }
    TAMIS_INLINE static T iota() {
        alignas(64) Real a[width];
        for (int l = 0; l < width; ++l) a[l] = static_cast<Real>(l);
        return load(a);
    }
    TAMIS_INLINE static bool any(const lane_mask<Real, W>& mask) { return detail::any_of<Real, W>(mask.get()); }
    TAMIS_INLINE static T select(const lane_mask<Real, W>& mask, const T& yes, const T& no) {
        return select_lanes(mask, yes, no);
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
        return slide_by<K>(low.get(), high.get(), std::make_integer_sequence<int, width>{});
    }

  private:
    using raw = typename T::raw;
    struct zero_first {};
    struct zero_last {};
    template <class Place, class Order> TAMIS_INLINE static T shuffle(const T& a, Place, Order) {
        return place<Place>(a.get(), Order{}, std::make_integer_sequence<int, width>{});
    }
    template <int K, int... L> TAMIS_INLINE static T slide_by(raw low, raw high, std::integer_sequence<int, L...>) {
        return T(__builtin_shufflevector(low, high, (K + L)...));
    }
    template <class Place, int... L> TAMIS_INLINE static T place(raw a, zero_first, std::integer_sequence<int, L...>) {
        return T(__builtin_shufflevector(raw{}, a, Place{}(L)...));
    }
    template <class Place, int... L> TAMIS_INLINE static T place(raw a, zero_last, std::integer_sequence<int, L...>) {
        return T(__builtin_shufflevector(a, raw{}, Place{}(L)...));
    }
};

/// @endcond
/// The widest vectors the compiler's target has.
struct native_lanes {
    /// @cond
    template <class Real> static constexpr bool is_vector = std::is_same_v<Real, double> || std::is_same_v<Real, float>;
    template <class Real, bool = is_vector<Real>> struct choose { using type = Real; };
    template <class Real> struct choose<Real, true> {
        using type = lane_vector<Real, TAMIS_VECTOR_BYTES / static_cast<int>(sizeof(Real))>;
    };
    /// @endcond
    /// The scalar of kernels.
    template <class Real> using type = typename choose<Real>::type;
};
/// Vectors of W lanes, where the target has them.
template <int W> struct lanes {
    static_assert(W >= 1, "tamis: lanes<W> needs W >= 1");
    /// @cond
    template <class Real> struct choose {
        static constexpr int bytes = W * static_cast<int>(sizeof(Real));
        static_assert(native_lanes::is_vector<Real> && (bytes == 16 || bytes == 32 || bytes == 64) &&
                          bytes <= TAMIS_VECTOR_BYTES,
                      "tamis: this target has no vectors of that many lanes; use native_lanes, or compile with "
                      "-march=native");
        using type = lane_vector<Real, W>;
    };
    /// @endcond
    /// The scalar of kernels.
    template <class Real> using type = typename choose<Real>::type;
};
/// @cond
template <> struct lanes<1> : one_lane {};
/// @endcond
#else
/// Without vectors kernels run one particle at a time.
using native_lanes = one_lane;
/// Lanes of W numbers; without vectors there is one.
template <int W> struct lanes : one_lane {
    static_assert(W == 1, "tamis: lanes<W> with W > 1 needs a compiler and target with vectors; use lanes<1>");
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

/// Natural logarithm and exponential, lane by lane; of dual numbers by argument-dependent look-up.
template <class T> TAMIS_INLINE T logarithm(const T& a) {
    using std::log;
    return log(a);
}
template <class T> TAMIS_INLINE T exponential(const T& a) {
    using std::exp;
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

#if TAMIS_VECTOR_BYTES > 0
namespace Eigen {
template <class Real_, int W> struct NumTraits<tamis::lane_vector<Real_, W>> : GenericNumTraits<Real_> {
    using Lanes = tamis::lane_vector<Real_, W>;
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
