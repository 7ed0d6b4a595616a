#pragma once
#include <tamis/run/body.hpp>

namespace tamis {

/// Sum over a body's particles of f(particle), a number or a vector; zero for a body without particles. Numbers are
/// added up in double where the body's are floats: millions of them would lose digits.
template <class Body, class F> auto sum_over(const Body& body, F&& f) {
    using value = std::remove_cvref_t<decltype(f(*body.begin()))>;
    if constexpr (std::is_arithmetic_v<value> || std::is_convertible_v<double, value>) {
        std::conditional_t<std::is_same_v<value, float>, double, value> total(0);
        for (const auto p : body) total += f(p);
        return total;
    } else {
        using number = typename value::Scalar;
        using wide = std::conditional_t<std::is_same_v<number, float>, double, number>;
        Eigen::Matrix<wide, value::RowsAtCompileTime, value::ColsAtCompileTime, Eigen::DontAlign> total;
        total.setConstant(wide(0));
        for (const auto p : body) total += f(p).template cast<wide>();
        return total;
    }
}

/// Mass of a body (kg).
template <class Body> auto total_mass(const Body& body) {
    return sum_over(body, [](const auto& p) { return p[symbols::m]; });
}
/// Momentum of a body (N s).
template <class Body> auto total_momentum(const Body& body) {
    using namespace symbols;
    return sum_over(body, [](const auto& p) -> point<Body::dim, typename Body::real> { return p[v] * p[m]; });
}
/// Kinetic energy of a body's particles (J): half the sum of M V^2.
template <class Body> auto kinetic_energy(const Body& body) {
    using namespace symbols;
    return sum_over(body, [](const auto& p) { return p[m] * p[v].squaredNorm() / 2; });
}
/// Energy stored in a body by its law (J): the sum of V0 times the law's energy per reference volume.
template <class Body> auto elastic_energy(const Body& body) {
    using namespace symbols;
    static_assert(
        requires { body.law.energy(*body.begin(), matrix<Body::dim, typename Body::real>()); },
        "tamis: the law has no stored energy; give it a member function `energy(p, tau)`, J per reference volume");
    return sum_over(body, [&](const auto& p) { return p[V] * body.law.energy(p, p[sigma]); });
}
/// Mass-weighted mean of a field over a body.
template <class Body, class F> auto mean(const Body& body, F field) {
    using seen = std::remove_cvref_t<decltype((*body.begin())[field])>;
    const auto mass = total_mass(body);
    if constexpr (std::same_as<seen, typename Body::real>)
        return sum_over(body, [&](const auto& p) { return p[field] * p[symbols::m]; }) / mass;
    else {
        using value = typename seen::PlainObject;
        return (sum_over(body, [&](const auto& p) -> value { return p[field] * p[symbols::m]; }) / mass).eval();
    }
}
/// Largest particle speed of a body (m/s).
template <class Body> auto largest_speed(const Body& body) {
    typename Body::real largest(0);
    for (const auto p : body) {
        const auto squared = p[symbols::v].squaredNorm();
        if (squared > largest) largest = squared;
    }
    using std::sqrt;
    return sqrt(largest);
}

}  // namespace tamis
