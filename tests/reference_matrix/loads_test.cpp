// Forces on particles, tractions and damping beside those of the reference, in the scenes of bar.hpp and block.hpp.
#include <cmath>

#include "../reference/load.hpp"
#include "bar.hpp"
#include "block.hpp"
#include "catch.hpp"

using namespace tamis;
using Eigen::VectorXd;

namespace {

constexpr double drag = 0.6, target = 1e-4, gain = 400, most = 3;
double changing_drag(double t) { return drag * (1 + std::sin(20 * t)); }

/// Loads that depend on place, direction and time, for the library's points and the reference's vectors.
struct upper_part {
    bool operator()(const auto& at) const { return at[at.size() - 1] > -0.05; }
};
struct tug {
    template <class V> V operator()(const V& at, double t) const {
        return V(V::Constant(at.size(), 0.002 + 0.01 * t) - 0.004 * at);
    }
};
/// The sides across the first axis.
struct sides {
    bool operator()(const auto&, const auto& normal) const { return normal[0] != 0; }
};
struct push {
    template <class V> V operator()(const V& at, const V& normal, double t) const {
        V value = normal * (0.05 + 0.1 * std::sin(20 * t) + 0.1 * at[0]);
        value[at.size() - 1] += 0.03 + 0.1 * at[at.size() - 1];
        return value;
    }
};
auto all_loads(const auto& body_load) {
    return loads{body_load, particle_force{upper_part{}, tug{}}, traction{sides{}, push{}}, grid_damping{changing_drag},
                 kinetic_feedback{target, gain, most}};
}

/// The same for the reference, beside the scene's own acceleration.
void add_loads(reference::scene& set, const reference::state& start) {
    set.point_forces.push_back({reference::chosen_particles(start, upper_part{}), tug{}});
    set.face_loads.push_back({reference::surface_areas(start, sides{}), push{}});
    set.damping = changing_drag;
    set.feedback = {target, gain, most};
}

void report(const compare::deviations& found) {
    INFO("relative differences: position " << found.position << ", velocity " << found.velocity << ", stress "
                                           << found.stress << ", reaction " << found.reaction);
    CHECK(found.worst() < 1e-10);
}

template <class Shape, class Motion, class Update, class Order> void check_bar() {
    CAPTURE(Shape::name, Motion::name, Update::name, Order::name);
    constexpr auto which = bar::kind::free;
    const auto update = compare::make<Update>();
    const uniform_grid<1, double> grid{{bar::lower}, {bar::upper}, bar::spacing};
    solver mpm{grid,    Shape{}, update, Order{}, fixed{bar::left_end{}}, all_loads(body_acceleration{bar::pull{}}),
               Motion{}};
    const linear_elastic law{.young = bar::young, .density = bar::density};
    auto body = mpm.make_body(law, bar::inside{which}, per_cell{2}, fields<compare::number>{});
    reference::scene set = bar::scene(
        which, {compare::same(Shape{}), compare::same(update), compare::same(Order{}), compare::same(Motion{})});
    const reference::state start = bar::particles(which, set);
    add_loads(set, start);
    REQUIRE(set.face_loads[0].areas.sum() == 2);
    compare::reference_run reference(set, start);
    compare::side_by_side(mpm, body, reference, bar::time_step(set.order), 100);
    report(reference.result());
}

template <class Shape, class Update, class Order> void check_block() {
    CAPTURE(Shape::name, Update::name, Order::name);
    using place = point<2, double>;
    const auto update = compare::make<Update>();
    const uniform_grid grid{{block::lower, block::lower}, {block::upper<2>(0), block::upper<2>(1)}, block::spacing};
    const conditions walls{fixed{block::bottom<2>{}}, slip{block::left<2>{}, block::unit<place>(0)},
                           prescribed{block::right<2>{}, block::pushed{}, block::unit<place>(0)},
                           slip{block::incline<2>{}, block::inclined<place>()}};
    const linear_elastic law{.young = block::young, .poisson = block::poisson, .density = block::density};
    solver mpm{grid, Shape{}, update, Order{}, walls, all_loads(gravity{block::pull<place>()})};
    auto body = mpm.make_body(law, block::inside<2>{}, per_cell{2}, fields<compare::number>{});
    reference::scene set = block::scene<2>({compare::same(Shape{}), compare::same(update), compare::same(Order{})});
    const reference::state start = block::particles<2>(set);
    add_loads(set, start);
    REQUIRE(set.face_loads[0].areas.sum() > 0.5);
    compare::reference_run reference(set, start);
    compare::side_by_side(mpm, body, reference, block::time_step(), 50);
    report(reference.result());
}

}  // namespace

TEST_CASE("loads of all kinds agree with the reference in a bar", "[reference_matrix]") {
    check_bar<linear, held, flip, usl_minus>();
    check_bar<linear, moving, fmpm<3>, usavg_plus>();
    check_bar<quadratic_spline, held, xpic<2>, usf>();
    check_bar<quadratic_spline, moving, flip, euler>();
}

TEST_CASE("loads of all kinds agree with the reference in a block", "[reference_matrix]") {
    check_block<quadratic_spline, flip, usl_minus>();
    check_block<quadratic_spline, fmpm<2>, usf>();
    check_block<linear, pic, usl_plus>();
}
