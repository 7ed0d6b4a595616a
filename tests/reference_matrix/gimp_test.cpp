// GIMP, with laws of small and of finite strain, in the scenes of bar.hpp and block.hpp. Walls are held: domains that
// stick out of the box fold their ghost nodes in.
#include <concepts>
#include <utility>

#include "../reference/law.hpp"
#include "bar.hpp"
#include "block.hpp"
#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

constexpr reference::shape_kind same(const ugimp&) { return reference::shape_kind::uniform_gimp; }
constexpr reference::shape_kind same(const cpgimp&) { return reference::shape_kind::contiguous_gimp; }

/// Neo-Hookean particles start with another deformation each, and its stress.
void deform(reference::scene& set, reference::state& body) {
    set.law = reference::law_kind::neo_hookean;
    const Eigen::Index D = set.dimension();
    for (Eigen::Index p = 0; p < body.size(); ++p) {
        const Eigen::VectorXd s = body.x.row(p).transpose() - set.lower;
        const auto k = static_cast<std::size_t>(p);
        Eigen::MatrixXd& F = body.deformation[k];
        for (Eigen::Index c = 0; c < D; ++c)
            for (Eigen::Index d = 0; d < D; ++d)
                F(c, d) += 0.05 * std::cos(4 * s.sum() + static_cast<double>(c + 2 * d));
        body.stress[k] = reference::neo_hookean_stress(F, set.young[0], set.poisson);
    }
}

/// Both from the start given, to 1e-10.
template <class Mpm, class Body>
void check(Mpm& mpm, Body& body, const reference::scene& set, const reference::state& start, double dt, int steps) {
    CAPTURE(Mpm::dim, Mpm::C::shape::name, Mpm::C::order::name, Mpm::C::transfer::name, steps);
    compare::reference_run run(set, start);
    compare::start(body, run);
    if constexpr (std::same_as<typename Body::law_type, neo_hookean>)
        for (auto p : body) {
            const auto& given = start.deformation[static_cast<std::size_t>(p[compare::number{}])];
            for (int c = 0; c < Mpm::dim; ++c)
                for (int d = 0; d < Mpm::dim; ++d) p[F](c, d) = given(c, d);
        }
    for (int n = 1; n <= steps; ++n) {
        run.step(dt);
        mpm.step(bodies(body), dt, n * dt);
        compare::compare_reactions(mpm, run);
        if (n == 1 || n % 10 == 0) compare::compare_particles(std::as_const(body), run);
    }
    const compare::deviations& found = run.result();
    INFO("relative differences: position " << found.position << ", velocity " << found.velocity << ", stress "
                                           << found.stress << ", reaction " << found.reaction);
    CHECK(found.worst() < 1e-10);
    CHECK(mpm.crossings() > 0);
}

template <class Update, class Order, class Shape, class Law> void check_bar(const Shape& shape, const Law& law) {
    for (const auto which : {bar::kind::driven, bar::kind::free}) {
        CAPTURE(static_cast<int>(which));
        const uniform_grid<1, double> grid{{bar::lower}, {bar::upper}, bar::spacing};
        const conditions ends{fixed{bar::left_end{}}, prescribed{bar::right_end{which}, bar::driven_velocity{}}};
        solver mpm{grid, shape, Update{}, Order{}, ends, body_acceleration{bar::pull{}}};
        auto body = mpm.make_body(law, bar::inside{which}, per_cell{2}, fields<compare::number>{});

        reference::scene set =
            bar::scene(which, {same(shape), compare::same(Update{}), compare::same(Order{}), compare::same(moving{})});
        set.poisson = law.poisson;
        reference::state start = bar::particles(which, set);
        if constexpr (std::same_as<Law, neo_hookean>) deform(set, start);
        check(mpm, body, set, start, bar::time_step(set.order), 100);
    }
}

template <class Update, class Order, class Shape, class Law> void check_block(const Shape& shape, const Law& law) {
    using place = point<2, double>;
    const uniform_grid<2, double> grid{
        {block::lower, block::lower}, {block::upper<2>(0), block::upper<2>(1)}, block::spacing};
    const conditions walls{fixed{block::bottom<2>{}}, slip{block::left<2>{}, place(1, 0)},
                           prescribed{block::right<2>{}, block::pushed{}, place(1, 0)},
                           slip{block::incline<2>{}, block::inclined<place>()}};
    solver mpm{grid, shape, Update{}, Order{}, walls, gravity{block::pull<place>()}};
    auto body = mpm.make_body(law, block::inside<2>{}, per_cell{2}, fields<compare::number>{});

    reference::scene set = block::scene<2>({same(shape), compare::same(Update{}), compare::same(Order{})});
    reference::state start = block::particles<2>(set);
    if constexpr (std::same_as<Law, neo_hookean>) deform(set, start);
    check(mpm, body, set, start, block::time_step(), 50);
}

}  // namespace

TEST_CASE("ugimp and linear elasticity agree with the reference", "[reference_matrix]") {
    const ugimp shape{2};
    const linear_elastic in_bar{.young = bar::young, .density = bar::density};
    check_bar<flip, usl_minus>(shape, in_bar);
    check_bar<fmpm<2>, usavg_plus>(shape, in_bar);
    const linear_elastic in_block{.young = block::young, .poisson = block::poisson, .density = block::density};
    check_block<flip, usl_minus>(shape, in_block);
    check_block<fmpm<2>, usavg_plus>(shape, in_block);
}

// Orders that strain before the forces, or take the functions again after it, are refused: F is not the start's then.
TEST_CASE("cpgimp and a neo-Hookean solid agree with the reference", "[reference_matrix]") {
    const cpgimp shape{2};
    const neo_hookean in_bar{.young = bar::young, .poisson = 0.2, .density = bar::density};
    check_bar<flip, usl_minus>(shape, in_bar);
    check_bar<fmpm<2>, usl_minus>(shape, in_bar);
    const neo_hookean in_block{.young = block::young, .poisson = block::poisson, .density = block::density};
    check_block<flip, usl_minus>(shape, in_block);
    check_block<fmpm<2>, usl_minus>(shape, in_block);
}
