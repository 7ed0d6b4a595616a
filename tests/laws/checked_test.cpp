// A stress or load that is not a number stops the very next step, before any other particle is touched, in whatever
// composition; the particle is named, and the solver can be used on.
#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "compare.hpp"

#include <cmath>
#include <limits>
#include <string>

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};
const double none = std::numeric_limits<double>::quiet_NaN();

template <int D> uniform_grid<D, double> box() {
    double low[D]{}, high[D];
    for (double& end : high) end = 1;
    return uniform_grid<D, double>(low, high, 0.125);
}
bool inside(const auto& at) { return (at.array() > 0.26).all() && (at.array() < 0.74).all(); }

/// The stress along the last axis.
template <class Body> void set_stress(Body& body, int which, double value) {
    constexpr int D = Body::dim;
    Eigen::Matrix<double, D, D> stress = Eigen::Matrix<double, D, D>::Zero();
    stress(D - 1, D - 1) = value;
    int k = 0;
    for (auto p : body)
        if (k++ == which) p[sigma] = stress;
}
template <class Step> std::string complaint_of(Step step) {
    try {
        step();
    } catch (const error& e) {
        return e.what();
    }
    return "";
}

template <int D, class... Policies> void check_named(const Policies&... policies) {
    solver mpm{box<D>(), policies...};
    auto body = mpm.make_body(
        law, [](const auto& at) { return inside(at); }, per_cell{2});
    for (auto p : body) p[v][0] = 0.01 * p[x][0];
    for (int k = 0; k < 3; ++k) mpm.step(bodies(body), 1e-3);
    set_stress(body, 5, none);
    const std::string told = complaint_of([&] { mpm.step(bodies(body), 1e-3); });
    CHECK(told.find("particle 5 at (") == 0);
    CHECK(told.find("step 3, t = 0.003") != std::string::npos);
    CHECK(told.find("velocity or stress is not a number") != std::string::npos);
    CHECK(mpm.steps() == 3);
    for (const auto p : body) CHECK(std::isfinite(p[v].sum() + p[x].sum()));
    set_stress(body, 5, 0);
    CHECK_NOTHROW(mpm.step(bodies(body), 1e-3));
    CHECK(mpm.steps() == 4);
}

/// Gives no number from t = 0.0025 s on.
struct ends_in_nothing {
    auto acceleration(const auto& at, const auto&, double t) const { return (at * (t > 0.0025 ? none : 0.)).eval(); }
};

}  // namespace

TEST_CASE("checked: a stress that is not a number stops the next step and names the particle") {
    check_named<1>(linear{}, flip{});
    check_named<1>(linear{}, held{}, flip{}, usf{});
    check_named<1>(quadratic_spline{}, held{}, fmpm<2>{});
    check_named<2>(quadratic_spline{}, flip{});
    check_named<2>(quadratic_spline{}, flip{}, usl_plus{});
    check_named<2>(linear{}, fmpm<3>{});
#if defined(_OPENMP)
    check_named<2>(linear{}, fmpm<3>{}, threads{2});
#endif
    check_named<2>(quadratic_spline{}, xpic<2>{}, one_lane{});
    check_named<3>(quadratic_spline{}, apic{});
}

TEST_CASE("checked: with several velocity fields too") {
    solver mpm{box<2>(), quadratic_spline{}, contact{frictionless{}}};
    const auto left = [](const auto& at) { return inside(at) && at[0] < 0.5; };
    const auto right = [](const auto& at) { return inside(at) && at[0] > 0.5; };
    auto one = mpm.make_body(law, left, per_cell{2});
    auto two = mpm.make_body(law, right, per_cell{2});
    mpm.step(bodies(one, two), 1e-3);
    set_stress(two, 2, none);
    const std::string told = complaint_of([&] { mpm.step(bodies(one, two), 1e-3); });
    CHECK(told.find("particle 2 at (0.") == 0);
}

TEST_CASE("checked: a load that is not a number is told as such") {
    solver mpm{box<2>(), quadratic_spline{}, ends_in_nothing{}};
    auto body = mpm.make_body(
        law, [](const auto& at) { return inside(at); }, per_cell{2});
    for (int k = 0; k < 3; ++k) mpm.step(bodies(body), 1e-3);
    const std::string told = complaint_of([&] { mpm.step(bodies(body), 1e-3); });
    CHECK(told.find("step 3, t = 0.003: a node's acceleration is not a number") == 0);
    CHECK(told.find("a load, condition or contact law") != std::string::npos);
    for (const auto p : body) CHECK(std::isfinite(p[v].sum() + p[x].sum()));
}

TEST_CASE("checked: left out on demand, with the same results") {
    const auto run = [](auto... policies) {
        solver mpm{box<2>(), quadratic_spline{}, flip{}, policies...};
        auto body = mpm.make_body(
            law, [](const auto& at) { return inside(at); }, per_cell{2});
        for (auto p : body) p[v] = point<2, double>(0.1 * p[x][0], 0.2);
        for (int k = 0; k < 20; ++k) mpm.step(bodies(body), 1e-2);
        std::vector<double> all;
        for (const auto p : body) all.insert(all.end(), {p[x][0], p[x][1], p[v][0], p[v][1], p[sigma](0, 1)});
        return all;
    };
    CHECK(run() == run(unchecked{}));
    CHECK(run(checked{}) == run(unchecked{}));

    solver mpm{box<1>(), linear{}, held{}, unchecked{}};
    auto bar = mpm.make_body(
        law, [](const auto& at) { return inside(at); }, per_cell{2});
    set_stress(bar, 5, none);
    CHECK_NOTHROW(mpm.step(bodies(bar), 1e-3));
}
