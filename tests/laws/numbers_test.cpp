// Kernels are generic in the scalar: extended precision, and numbers that carry a derivative.
#include <tamis/tamis.hpp>

#include <unsupported/Eigen/AutoDiff>

#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

using dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

template <> struct tamis::lane<dual> {
    using real = dual;
    static constexpr int width = 1;
    static dual load(const dual* from) { return *from; }
    static void store(dual* to, const dual& value) { *to = value; }
    static dual iota() { return dual(0); }
    static bool any(bool mask) { return mask; }
    static dual select(bool mask, const dual& yes, const dual& no) { return mask ? yes : no; }
    static int floor(const dual& number) { return static_cast<int>(std::floor(number.value())); }
};

namespace {

/// An elastic law of any scalar, whose modulus may carry a derivative.
template <class Real> struct elastic {
    Real young;
    double density = 1;
    using on_particles = fields<const field::stress>;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        return p[sigma] + (L + L.transpose()) * (young * dt / 2);
    }
};

template <class Real> struct outcome { std::vector<Real> position, velocity, stress; };

/// A bar whose middle is pushed, after a while; in lanes of one.
template <class Real, class Policy> outcome<Real> push(const Real& young, Policy policy) {
    const auto wall = fixed{[](const auto& at) { return at[0] <= 0; }};
    solver mpm{uniform_grid<1, Real>{{Real(0)}, {Real(2)}, Real(0.125)}, policy, wall, lanes<1>{}};
    auto bar = mpm.make_body(
        elastic<Real>{young}, [](const auto& at) { return at[0] < 1.5; }, per_cell{2});
    for (auto p : bar)
        if (p[x][0] > 0.5 && p[x][0] < 0.8) p[v][0] = Real(1.5);
    for (int k = 0; k < 40; ++k) mpm.step(bodies(bar), Real(0.01));
    CHECK(mpm.crossings() > 0);
    outcome<Real> all;
    for (const auto p : std::as_const(bar)) {
        all.position.push_back(p[x][0]);
        all.velocity.push_back(p[v][0]);
        all.stress.push_back(p[sigma](0, 0));
    }
    return all;
}

template <class A, class B> double difference(const std::vector<A>& a, const std::vector<B>& b) {
    REQUIRE(a.size() == b.size());
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(static_cast<double>(a[k] - b[k])));
    return most;
}

template <class Policy> void runs_in_other_numbers(Policy policy) {
    const auto in_double = push(3., policy);

    const auto extended = push(3.L, policy);
    CHECK(difference(in_double.position, extended.position) < 1e-13);
    CHECK(difference(in_double.velocity, extended.velocity) < 1e-12);
    CHECK(difference(in_double.stress, extended.stress) < 1e-12);
    if (std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits)
        CHECK(difference(in_double.velocity, extended.velocity) > 0);

    // d/d(young) of everything in one run, beside the difference of two.
    dual young(3.);
    young.derivatives()[0] = 1;
    const auto with_derivative = push(young, policy);
    const double h = 1e-5;
    const auto above = push(3. + h, policy), below = push(3. - h, policy);
    double most = 0;
    REQUIRE(with_derivative.stress.size() == above.stress.size());
    for (std::size_t k = 0; k < above.stress.size(); ++k) {
        CHECK(std::abs(with_derivative.stress[k].value() - in_double.stress[k]) < 1e-12);
        CHECK(std::abs(with_derivative.position[k].value() - in_double.position[k]) < 1e-13);
        const auto check = [&](const dual& one, double up, double down) {
            const double slope = (up - down) / (2 * h);
            CHECK(std::abs(one.derivatives()[0] - slope) < 1e-8);
            most = std::max(most, std::abs(slope));
        };
        check(with_derivative.stress[k], above.stress[k], below.stress[k]);
        check(with_derivative.velocity[k], above.velocity[k], below.velocity[k]);
        check(with_derivative.position[k], above.position[k], below.position[k]);
    }
    CHECK(most > 0.01);
}

}  // namespace

TEST_CASE("numbers: long double and dual numbers run, and agree with double") { runs_in_other_numbers(fmpm<2>{}); }
