#include <tamis/stability/dual.hpp>

#include <cmath>

#include "catch.hpp"

using tamis::stability::dual;

namespace {

/// f's derivatives by both arguments against central differences.
template <class F> void check(F f, double x, double y) {
    dual<2> a(x), b(y);
    a.by[0] = b.by[1] = 1;
    const dual<2> found = f(a, b);
    const auto plain = [&](double u, double w) { return static_cast<double>(f(dual<2>(u), dual<2>(w))); };
    const double step = 1e-6;
    CHECK(found.value == plain(x, y));
    CHECK(std::abs(found.by[0] - (plain(x + step, y) - plain(x - step, y)) / (2 * step)) < 1e-8);
    CHECK(std::abs(found.by[1] - (plain(x, y + step) - plain(x, y - step)) / (2 * step)) < 1e-8);
}

}  // namespace

TEST_CASE("dual: derivatives are those of differences") {
    check([](auto a, auto b) { return a + 3 * b - a * b; }, 0.3, -1.2);
    check([](auto a, auto b) { return -a / b; }, 0.3, -1.2);
    check([](auto a, auto b) { return sqrt(a) * exp(b) + log(a) + abs(b); }, 0.7, -0.4);
    check(
        [](auto a, auto b) {
            a += b;
            a *= b;
            a -= 2 * b;
            a /= b;
            return a;
        },
        0.7, -0.4);
    CHECK(floor(dual<1>(1.7)).value == 1);
    CHECK(floor(dual<1>(1.7)).by[0] == 0);
    CHECK((dual<1>(1) < dual<1>(2) && dual<1>(2) == dual<1>(2) && dual<1>(1) != dual<1>(2)));
}
