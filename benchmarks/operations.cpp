// What a particle update costs in operations, by composition: `operations` counts multiplications and additions by a
// number type that counts; count_operations.sh has valgrind count loads and stores of `operations <update> <steps>`.
// 2D, quadratic splines, USL-, moving particles, 2 per cell and axis, one lane.
#include <tamis/tamis.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// A double that counts what is done with it.
struct counted {
    double value = 0;
    static inline long multiplications = 0, additions = 0, divisions = 0;
    counted() = default;
    template <class Number>
    requires std::is_arithmetic_v<Number> counted(Number a) : value(static_cast<double>(a)) {}
    explicit operator double() const { return value; }
    explicit operator float() const { return static_cast<float>(value); }
    explicit operator int() const { return static_cast<int>(value); }
    explicit operator long() const { return static_cast<long>(value); }
    counted operator-() const { return -value; }
    friend counted operator+(counted a, counted b) { return (++additions, a.value + b.value); }
    friend counted operator-(counted a, counted b) { return (++additions, a.value - b.value); }
    friend counted operator*(counted a, counted b) { return (++multiplications, a.value * b.value); }
    friend counted operator/(counted a, counted b) { return (++divisions, a.value / b.value); }
    counted& operator+=(counted b) { return *this = *this + b; }
    counted& operator-=(counted b) { return *this = *this - b; }
    counted& operator*=(counted b) { return *this = *this * b; }
    counted& operator/=(counted b) { return *this = *this / b; }
    friend bool operator==(counted a, counted b) { return a.value == b.value; }
    friend auto operator<=>(counted a, counted b) { return a.value <=> b.value; }
    friend counted sqrt(counted a) { return std::sqrt(a.value); }
    friend counted abs(counted a) { return std::abs(a.value); }
    friend counted floor(counted a) { return std::floor(a.value); }
    friend std::ostream& operator<<(std::ostream& out, counted a) { return out << a.value; }
};
namespace Eigen {
template <> struct NumTraits<counted> : NumTraits<double> {
    using Real = counted;
    using NonInteger = counted;
    using Nested = counted;
    using Literal = counted;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 1,
        AddCost = 1,
        MulCost = 1
    };
};
}  // namespace Eigen

namespace {

using namespace tamis;

template <class Real, class Scheme> std::size_t run(const Scheme& scheme, long steps) {
    const uniform_grid<2, Real> grid{{Real(0), Real(0)}, {Real(1), Real(1)}, Real(1) / Real(20)};
    solver mpm{grid, quadratic_spline{}, scheme, usl_minus{}, one_lane{}};
    const auto inside = [](const auto& at) {
        return at[0] > Real(0.2) && at[0] < Real(0.8) && at[1] > Real(0.2) && at[1] < Real(0.8);
    };
    auto block = mpm.make_body(linear_elastic{.young = 1, .poisson = 0.3, .density = 1}, inside, per_cell{2});
    for (auto p : block) p[symbols::v][0] = Real(1e-3) * (Real(1) - p[symbols::x][0]);
    for (long k = 0; k < steps; ++k) mpm.step(bodies(block), Real(1e-3));
    return block.size();
}

template <class Scheme> void count(const char* name, const Scheme& scheme) {
    run<counted>(scheme, 1);
    long before[3] = {counted::multiplications, counted::additions, counted::divisions};
    const auto spent = [&] {
        for (long* c : {&counted::multiplications, &counted::additions, &counted::divisions}) *c = 0;
    };
    spent();
    run<counted>(scheme, 1);
    before[0] = counted::multiplications, before[1] = counted::additions, before[2] = counted::divisions;
    spent();
    const auto particles = static_cast<double>(run<counted>(scheme, 11));
    const auto each = [&](long now, long then) { return static_cast<double>(now - then) / (10 * particles); };
    std::printf("| %-14s | %7.1f | %7.1f | %7.2f |\n", name, each(counted::multiplications, before[0]),
                each(counted::additions, before[1]), each(counted::divisions, before[2]));
}

template <class F> bool each_scheme(F f) {
    bool found = false;
    found = f("pic", pic{}) || found;
    found = f("flip", flip{}) || found;
    found = f("xpic(2)", xpic<2>{}) || found;
    found = f("xpic(4)", xpic<4>{}) || found;
    found = f("fmpm(2)", fmpm<2>{}) || found;
    found = f("fmpm(4)", fmpm<4>{}) || found;
    return found;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 1) {
        std::puts("| update         | multiplications | additions | divisions |, per particle and step");
        each_scheme([](const char* name, const auto& scheme) {
            count(name, scheme);
            return true;
        });
        return 0;
    }
    const std::string_view wanted = argv[1];
    const long steps = argc > 2 ? std::atol(argv[2]) : 0;
    const bool found = each_scheme([&](const char* name, const auto& scheme) {
        if (wanted != name) return false;
        std::printf("%zu particles\n", run<double>(scheme, steps));
        return true;
    });
    if (found && argc == 3) return 0;
    std::fputs("usage: operations [pic|flip|xpic(2)|xpic(4)|fmpm(2)|fmpm(4) <steps>]\n", stderr);
    return 2;
}
