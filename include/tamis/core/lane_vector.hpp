#pragma once
#include <tamis/core/config.hpp>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <utility>

#if TAMIS_VECTOR_BYTES > 0
namespace tamis {
namespace detail {

/// A vector of the compiler (GCC, Clang): arithmetic of W numbers at once.
template <class Real, int W> struct raw_vector {
    typedef Real type __attribute__((vector_size(sizeof(Real) * W)));
    using whole_number = std::conditional_t<sizeof(Real) == 8, std::int64_t, std::int32_t>;
    typedef whole_number mask __attribute__((vector_size(sizeof(Real) * W)));
    typedef std::make_unsigned_t<whole_number> bits __attribute__((vector_size(sizeof(Real) * W)));
};
/// The lower or upper half of a vector's lanes.
template <class Half, int First, class Raw, int... L>
TAMIS_INLINE Half half_of(Raw a, std::integer_sequence<int, L...>) {
    return __builtin_shufflevector(a, a, (First + L)...);
}

/// Is a bit of any lane set? The lanes of a mask are all ones or all zeros.
template <class Real, int W> TAMIS_INLINE bool any_of(typename raw_vector<Real, W>::mask mask) {
#if defined(__SSE2__)
    constexpr auto bytes = sizeof(mask);
    using raw = typename raw_vector<float, static_cast<int>(bytes / sizeof(float))>::type;
    if constexpr (bytes == 16) return __builtin_ia32_movmskps(__builtin_bit_cast(raw, mask)) != 0;
#if defined(__AVX__)
    else if constexpr (bytes == 32)
        return __builtin_ia32_movmskps256(__builtin_bit_cast(raw, mask)) != 0;
#endif
    else
#endif
        if constexpr (W == 2)
        return (mask[0] | mask[1]) != 0;
    else {
        using half = typename raw_vector<Real, W / 2>::mask;
        constexpr std::make_integer_sequence<int, W / 2> lanes{};
        return any_of<Real, W / 2>(half_of<half, 0>(mask, lanes) | half_of<half, W / 2>(mask, lanes));
    }
}
/// Square roots of all lanes.
template <class Real, int W>
TAMIS_INLINE typename raw_vector<Real, W>::type root_of(typename raw_vector<Real, W>::type a) {
    [[maybe_unused]] constexpr auto bytes = sizeof(a);
    [[maybe_unused]] constexpr bool is_double = sizeof(Real) == 8;
#if defined(__SSE2__)
    if constexpr (bytes == 16 && is_double)
        return __builtin_ia32_sqrtpd(a);
    else if constexpr (bytes == 16)
        return __builtin_ia32_sqrtps(a);
    else
#endif
#if defined(__AVX__)
        if constexpr (bytes == 32 && is_double)
        return __builtin_ia32_sqrtpd256(a);
    else if constexpr (bytes == 32)
        return __builtin_ia32_sqrtps256(a);
    else
#endif
        if constexpr (bytes > 16) {
        using half = typename raw_vector<Real, W / 2>::type;
        constexpr std::make_integer_sequence<int, W / 2> lanes{};
        using result = decltype(a);
        const half parts[2]{root_of<Real, W / 2>(half_of<half, 0>(a, lanes)),
                            root_of<Real, W / 2>(half_of<half, W / 2>(a, lanes))};
        return __builtin_bit_cast(result, parts);
    } else {
        for (int l = 0; l < W; ++l) a[l] = std::sqrt(a[l]);
        return a;
    }
}

}  // namespace detail

/// What a comparison of lanes gives: a yes or no for each. `select` takes it, and `&`, `|`, `!` combine several.
template <class Real, int W> class lane_mask {
  public:
    /// The compiler's vector, from and to which it is made; and the answer of lane l.
    /// @{
    using raw = typename detail::raw_vector<Real, W>::mask;
    TAMIS_INLINE lane_mask() = default;
    TAMIS_INLINE explicit lane_mask(raw a) : raw_(a) {}
    TAMIS_INLINE explicit lane_mask(bool all)
        : raw_(raw{} - static_cast<typename detail::raw_vector<Real, W>::whole_number>(all)) {}
    TAMIS_INLINE raw get() const { return raw_; }
    TAMIS_INLINE bool get(int l) const { return raw_[l] != 0; }
    /// @}
    /// Lane by lane; `&&` and `||` look at both sides.
    /// @{
    friend TAMIS_INLINE lane_mask operator&(const lane_mask& a, const lane_mask& b) {
        return lane_mask(a.raw_ & b.raw_);
    }
    friend TAMIS_INLINE lane_mask operator|(const lane_mask& a, const lane_mask& b) {
        return lane_mask(a.raw_ | b.raw_);
    }
    friend TAMIS_INLINE lane_mask operator&&(const lane_mask& a, const lane_mask& b) { return a & b; }
    friend TAMIS_INLINE lane_mask operator||(const lane_mask& a, const lane_mask& b) { return a | b; }
    TAMIS_INLINE lane_mask operator!() const { return lane_mask(~raw_); }
    /// @}
    /// Not a yes or no: lanes may differ.
    template <std::same_as<bool> Bool> explicit operator Bool() const {
        static_assert(!std::is_same_v<Bool, bool>,
                      "tamis: a comparison of lanes is used as one bool, but a law or load sees several particles at "
                      "once; write select(mask, a, b) in place of if and ?:, or give the law `static constexpr bool "
                      "lane_by_lane = true;` to be called particle by particle, in plain numbers");
        return false;
    }

  private:
    raw raw_;
};

/// W numbers that kernels compute with at once, each for a particle of its own: a vector register of the processor.
/// Arithmetic and comparisons work lane by lane. A plain number stands for itself in every lane.
template <class Real, int W> class lane_vector {
  public:
    /// The compiler's vector, from and to which it is made; a number in all lanes; and that of lane l.
    /// @{
    using raw = typename detail::raw_vector<Real, W>::type;
    using mask = lane_mask<Real, W>;
    lane_vector() = default;
    TAMIS_INLINE lane_vector(Real all) : raw_(all - raw{}) {}
    TAMIS_INLINE explicit lane_vector(raw a) : raw_(a) {}
    TAMIS_INLINE raw get() const { return raw_; }
    TAMIS_INLINE Real get(int l) const { return raw_[l]; }
    /// @}
    /// Lane by lane.
    /// @{
    TAMIS_INLINE lane_vector& operator+=(const lane_vector& b) {
        raw_ += b.raw_;
        return *this;
    }
    TAMIS_INLINE lane_vector& operator-=(const lane_vector& b) {
        raw_ -= b.raw_;
        return *this;
    }
    TAMIS_INLINE lane_vector& operator*=(const lane_vector& b) {
        raw_ *= b.raw_;
        return *this;
    }
    TAMIS_INLINE lane_vector& operator/=(const lane_vector& b) {
        raw_ /= b.raw_;
        return *this;
    }
    TAMIS_INLINE lane_vector operator-() const { return lane_vector(-raw_); }
    TAMIS_INLINE lane_vector operator+() const { return *this; }
    friend TAMIS_INLINE lane_vector operator+(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ + b.raw_);
    }
    friend TAMIS_INLINE lane_vector operator-(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ - b.raw_);
    }
    friend TAMIS_INLINE lane_vector operator*(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ * b.raw_);
    }
    friend TAMIS_INLINE lane_vector operator/(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ / b.raw_);
    }
    friend TAMIS_INLINE mask operator<(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ < b.raw_); }
    friend TAMIS_INLINE mask operator>(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ > b.raw_); }
    friend TAMIS_INLINE mask operator<=(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ <= b.raw_); }
    friend TAMIS_INLINE mask operator>=(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ >= b.raw_); }
    friend TAMIS_INLINE mask operator==(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ == b.raw_); }
    friend TAMIS_INLINE mask operator!=(const lane_vector& a, const lane_vector& b) { return mask(a.raw_ != b.raw_); }
    /// @}
    /// Of min and max the result is `b` where one of both is no number, as of the processor's instructions.
    /// @{
    friend TAMIS_INLINE lane_vector min(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ < b.raw_ ? a.raw_ : b.raw_);
    }
    friend TAMIS_INLINE lane_vector max(const lane_vector& a, const lane_vector& b) {
        return lane_vector(a.raw_ > b.raw_ ? a.raw_ : b.raw_);
    }
    friend TAMIS_INLINE lane_vector abs(const lane_vector& a) {
        using bits = typename detail::raw_vector<Real, W>::bits;
        return lane_vector(__builtin_bit_cast(raw, (__builtin_bit_cast(bits, a.raw_) << 1) >> 1));
    }
    // mask ? yes : no; `select` calls it.
    friend TAMIS_INLINE lane_vector select_lanes(const mask& which, const lane_vector& yes, const lane_vector& no) {
        return lane_vector(which.get() ? yes.raw_ : no.raw_);
    }
    friend TAMIS_INLINE lane_vector sqrt(const lane_vector& a) { return lane_vector(detail::root_of<Real, W>(a.raw_)); }
    /// @}

  private:
    raw raw_;
};

}  // namespace tamis
#endif
