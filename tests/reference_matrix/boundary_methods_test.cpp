// The boundary methods of the full mass matrix, in the scenes of bar.hpp and block.hpp.
#include "bar.hpp"
#include "block.hpp"
#include "catch.hpp"

using namespace tamis;

namespace {

void check(const compare::deviations& found) {
    INFO("relative differences: position " << found.position << ", velocity " << found.velocity << ", stress "
                                           << found.stress << ", reaction " << found.reaction);
    CHECK(found.worst() < 1e-10);
}

template <class Shape, class Motion, class Order, class Method>
void check_bar(const Method& method, reference::boundary_method same, bar::kind which, int k, int steps) {
    CAPTURE(Method::name, Shape::name, Motion::name, Order::name, static_cast<int>(which), k, steps);
    const fmpm<tamis::dynamic> update{k};
    const uniform_grid<1, double> grid{{bar::lower}, {bar::upper}, bar::spacing};
    const conditions ends{fixed{bar::left_end{}}, prescribed{bar::right_end{which}, bar::driven_velocity{}}};
    solver mpm{grid, Shape{}, update, Order{}, ends, method, body_acceleration{bar::pull{}}, Motion{}};
    const linear_elastic law{.young = bar::young, .density = bar::density};
    auto body = mpm.make_body(law, bar::inside{which}, per_cell{2}, fields<compare::number>{});

    reference::scene set = bar::scene(
        which, {compare::same(Shape{}), compare::same(update), compare::same(Order{}), compare::same(Motion{})});
    set.boundary_method = same;
    compare::reference_run reference(set, bar::particles(which, set));
    compare::side_by_side(mpm, body, reference, bar::time_step(set.order), steps);
    check(reference.result());
}

template <class Method> void check_bars(Method method) {
    const reference::boundary_method same = compare::same(method);
    const boundary_method::chosen chosen(Method::name);
    for (const int k : {1, 2, 4}) {
        CAPTURE(Method::name);
        for (const auto which : {bar::kind::driven, bar::kind::free}) {
            check_bar<linear, held, usl_minus>(method, same, which, k, 200);
            check_bar<linear, held, usl_minus>(chosen, same, which, k, 200);
            // Not longer at the driven end: methods that miss the value let particles out there, and the combined one,
            // unstable for k >= 4, lets a disturbance grow 150 times in 200 steps (30 steps: 3 times).
            const int steps = which == bar::kind::driven ? 30 : 200;
            check_bar<quadratic_spline, moving, usavg_plus>(method, same, which, k, steps);
        }
    }
}

/// Walls with an incline, at nodes that other conditions hold too.
template <class Method> void check_block(Method method) {
    for (const int k : {1, 2, 4}) {
        CAPTURE(Method::name, k);
        using place = point<2, double>;
        const fmpm<tamis::dynamic> update{k};
        const uniform_grid<2, double> grid{
            {block::lower, block::lower}, {block::upper<2>(0), block::upper<2>(1)}, block::spacing};
        const conditions walls{fixed{block::bottom<2>{}}, slip{block::left<2>{}, place(1, 0)},
                               prescribed{block::right<2>{}, block::pushed{}, place(1, 0)},
                               slip{block::incline<2>{}, block::inclined<place>()}};
        solver mpm{grid, quadratic_spline{}, update, usavg_plus{}, walls, method, gravity{block::pull<place>()}};
        const linear_elastic law{.young = block::young, .poisson = block::poisson, .density = block::density};
        auto body = mpm.make_body(law, block::inside<2>{}, per_cell{2}, fields<compare::number>{});

        reference::scene set =
            block::scene<2>({compare::same(quadratic_spline{}), compare::same(update), compare::same(usavg_plus{})});
        set.boundary_method = compare::same(method);
        compare::reference_run reference(set, block::particles<2>(set));
        compare::side_by_side(mpm, body, reference, block::time_step(), 30);
        check(reference.result());
    }
}

}  // namespace

TEST_CASE("boundary methods: the bar agrees with the reference", "[reference_matrix]") {
    check_bars(boundary_method::incremental{});
    check_bars(boundary_method::lumped{});
    check_bars(boundary_method::velocity{});
    check_bars(boundary_method::combined{});
    check_bars(boundary_method::unlumped1{});
    check_bars(boundary_method::unlumped2{});
    check_bars(boundary_method::partial{});
    check_bars(boundary_method::collected{});
}

TEST_CASE("boundary methods: the block between inclined walls agrees with the reference", "[reference_matrix]") {
    check_block(boundary_method::unlumped2{});
    check_block(boundary_method::collected{});
}
