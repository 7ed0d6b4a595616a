#pragma once
#include <tamis/core/space.hpp>

#include <array>
#include <cmath>
#include <compare>
#include <ostream>
#include <type_traits>

namespace tamis::stability {

/// A number with its derivatives by N variables: forward differentiation of whatever is computed with it, exact to
/// round-off. The solver takes it as the number type of its grid.
template <int N> struct dual {
    /// The number.
    double value = 0;
    /// Its derivatives.
    std::array<double, static_cast<std::size_t>(N)> by{};

    /// Zero.
    dual() = default;
    /// A constant.
    template <class Number>
    requires std::is_arithmetic_v<Number> dual(Number a) : value(static_cast<double>(a)) {}
    /// The number, without derivatives.
    /// @{
    explicit operator double() const { return value; }
    explicit operator float() const { return static_cast<float>(value); }
    explicit operator int() const { return static_cast<int>(value); }
    explicit operator long() const { return static_cast<long>(value); }
    /// @}

    /// Arithmetic.
    /// @{
    friend dual operator+(const dual& a) { return a; }
    friend dual operator-(const dual& a) { return chain(a, -a.value, -1); }
    friend dual operator+(const dual& a, const dual& b) { return chain(a, b, a.value + b.value, 1, 1); }
    friend dual operator-(const dual& a, const dual& b) { return chain(a, b, a.value - b.value, 1, -1); }
    friend dual operator*(const dual& a, const dual& b) { return chain(a, b, a.value * b.value, b.value, a.value); }
    friend dual operator/(const dual& a, const dual& b) {
        const double q = a.value / b.value;
        return chain(a, b, q, 1 / b.value, -q / b.value);
    }
    dual& operator+=(const dual& b) { return *this = *this + b; }
    dual& operator-=(const dual& b) { return *this = *this - b; }
    dual& operator*=(const dual& b) { return *this = *this * b; }
    dual& operator/=(const dual& b) { return *this = *this / b; }
    /// @}
    /// By value: branches are taken as they are without derivatives.
    /// @{
    friend bool operator==(const dual& a, const dual& b) { return a.value == b.value; }
    friend auto operator<=>(const dual& a, const dual& b) { return a.value <=> b.value; }
    /// @}
    /// Functions.
    /// @{
    friend dual sqrt(const dual& a) {
        const double root = std::sqrt(a.value);
        return chain(a, root, root > 0 ? 0.5 / root : 0);
    }
    friend dual abs(const dual& a) { return a.value < 0 ? -a : a; }
    friend dual log(const dual& a) { return chain(a, std::log(a.value), 1 / a.value); }
    friend dual exp(const dual& a) { return chain(a, std::exp(a.value), std::exp(a.value)); }
    friend dual floor(const dual& a) { return std::floor(a.value); }
    friend std::ostream& operator<<(std::ostream& out, const dual& a) { return out << a.value; }
    /// @}

  private:
    static dual chain(const dual& a, double value, double by_a) {
        dual r(value);
        for (std::size_t k = 0; k < r.by.size(); ++k) r.by[k] = by_a * a.by[k];
        return r;
    }
    static dual chain(const dual& a, const dual& b, double value, double by_a, double by_b) {
        dual r(value);
        for (std::size_t k = 0; k < r.by.size(); ++k) r.by[k] = by_a * a.by[k] + by_b * b.by[k];
        return r;
    }
};

}  // namespace tamis::stability

template <int N> struct Eigen::NumTraits<tamis::stability::dual<N>> : Eigen::NumTraits<double> {
    using Real = tamis::stability::dual<N>;
    using NonInteger = Real;
    using Nested = Real;
    using Literal = Real;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = N,
        AddCost = N,
        MulCost = 2 * N
    };
};
