// The full mass matrix solved exactly, in some steps only, and with a look at its last term, in the scenes of bar.hpp.
#include <tamis/mass/exact.hpp>

#include <algorithm>
#include <cmath>

#include "bar.hpp"
#include "catch.hpp"

using namespace tamis;

namespace {

/// What is composed beside the update.
template <class Shape, class Motion, class Order> struct how {};
using linear_held = how<linear, held, usl_minus>;
using linear_moving = how<linear, moving, usavg_plus>;
using quadratic_moving = how<quadratic_spline, moving, usavg_plus>;

/// Runs an update of the library beside the reference's; the size of the series' last term too, if the update tells it.
template <class Shape, class Motion, class Order, class Update>
void check(how<Shape, Motion, Order>, const Update& update, const reference::update& same, bar::kind which, int steps) {
    CAPTURE(Update::name, same.k, same.period, Shape::name, Motion::name, Order::name, static_cast<int>(which), steps);
    const uniform_grid<1, double> grid{{bar::lower}, {bar::upper}, bar::spacing};
    const conditions ends{fixed{bar::left_end{}}, prescribed{bar::right_end{which}, bar::driven_velocity{}}};
    solver mpm{grid, Shape{}, update, Order{}, ends, body_acceleration{bar::pull{}}, Motion{}};
    const linear_elastic law{.young = bar::young, .density = bar::density};
    auto body = mpm.make_body(law, bar::inside{which}, per_cell{2}, fields<compare::number>{});

    const reference::scene set =
        bar::scene(which, {compare::same(Shape{}), same, compare::same(Order{}), compare::same(Motion{})});
    compare::reference_run reference(set, bar::particles(which, set));
    compare::start(body, reference);
    const double dt = bar::time_step(set.order);
    double largest = 0, last_increment = 0;  // last_increment: difference
    for (int n = 1; n <= steps; ++n) {
        reference.step(dt);
        mpm.step(bodies(body), dt, n * dt);
        compare::compare_reactions(mpm, reference);
        if (n == 1 || n % 10 == 0 || n == steps) compare::compare_particles(std::as_const(body), reference);
        if (mpm.series().terms == 0) continue;
        CHECK(mpm.series().terms == same.k);
        largest = std::max(largest, reference.last_increment());
        last_increment = std::max(last_increment, std::abs(mpm.series().last_increment - reference.last_increment()));
    }
    const compare::deviations& found = reference.result();
    if (largest > 0) last_increment /= largest;
    INFO("relative differences: position " << found.position << ", velocity " << found.velocity << ", stress "
                                           << found.stress << ", reaction " << found.reaction << ", last increment "
                                           << last_increment);
    CHECK(found.worst() < 1e-10);
    CHECK(last_increment < 1e-10);
}

}  // namespace

TEST_CASE("adaptive_fmpm without tolerance and the size of its last term agree with the reference",
          "[reference_matrix]") {
    for (int k = 1; k <= 6; ++k) {
        for (const auto which : {bar::kind::driven, bar::kind::free}) {
            check(linear_held{}, adaptive_fmpm{0., k}, reference::fmpm(k), which, 100);
            check(quadratic_moving{}, adaptive_fmpm{0., k}, reference::fmpm(k), which, 100);
        }
    }
}

TEST_CASE("periodic_fmpm agrees with the reference", "[reference_matrix]") {
    for (const int period : {1, 3, 7})
        for (const auto which : {bar::kind::driven, bar::kind::free}) {
            const periodic_fmpm<tamis::dynamic> update{4, period};
            check(linear_held{}, update, reference::periodic_fmpm(4, period), which, 100);
            check(quadratic_moving{}, update, reference::periodic_fmpm(4, period), which, 100);
        }
}

TEST_CASE("exact_fmpm agrees with the reference", "[reference_matrix]") {
    const reference::update same = reference::fmpm(reference::exact_solve);
    for (const auto which : {bar::kind::driven, bar::kind::free}) check(linear_held{}, exact_fmpm{}, same, which, 100);
    check(linear_moving{}, exact_fmpm{}, same, bar::kind::driven, 30);
}
