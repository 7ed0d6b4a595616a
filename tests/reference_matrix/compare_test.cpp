#include "../support/compare_definitions.hpp"

#include "catch.hpp"

using namespace compare;

namespace {

/// Two particles of mass and volume 1/2 at 1/4 and 3/4, the left node held at rest.
reference::scene small_scene() {
    reference::scene set;
    set.lower = Eigen::VectorXd::Zero(1);
    set.upper = Eigen::VectorXd::Ones(1);
    set.conditions = {reference::hold_velocity(
        1, [](const Eigen::VectorXd& at) { return at[0] < 0.5; },
        [](const Eigen::VectorXd&, double) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(1); })};
    return set;
}

reference::state small_body() {
    reference::state body =
        reference::make_particles(small_scene(), 2, 1., [](const Eigen::VectorXd&) { return true; });
    body.v << 1, 2;
    return body;
}

/// Shows the run its own particles, changed by `change`.
template <class Change> double shown(Change change) {
    reference_run run(small_scene(), small_body());
    for (const double at : {0.75, 0.25}) {
        auto [number, values] = run.claim({at}, 0.5, 0.5, 1e-15);
        change(number, values);
        run.found(number, values);
    }
    run.compare_particles();
    return run.result().worst();
}

}  // namespace

TEST_CASE("equal particles do not differ, in whatever order they come", "[reference_matrix]") {
    CHECK(shown([](std::size_t, particle_values&) {}) == 0);
}

TEST_CASE("one particle that differs counts, relative to the largest value", "[reference_matrix]") {
    const double worst = shown([](std::size_t number, particle_values& p) {
        if (number == 0) p.v[0] += 0.5;
    });
    CHECK(worst == 0.25);
}

TEST_CASE("what is no number, and what should be nothing, differs infinitely", "[reference_matrix]") {
    CHECK(shown([](std::size_t, particle_values& p) { p.x[0] = std::nan(""); }) ==
          std::numeric_limits<double>::infinity());
    CHECK(shown([](std::size_t, particle_values& p) { p.stress[0] = 1e-30; }) ==
          std::numeric_limits<double>::infinity());
}

TEST_CASE("a particle that was not shown differs infinitely", "[reference_matrix]") {
    reference_run run(small_scene(), small_body());
    const auto [number, values] = run.claim({0.25}, 0.5, 0.5, 1e-15);
    run.found(number, values);
    run.compare_particles();
    CHECK(run.result().worst() == std::numeric_limits<double>::infinity());
}

TEST_CASE("bodies with other particles are not compared", "[reference_matrix]") {
    reference_run run(small_scene(), small_body());
    CHECK_THROWS_AS(run.claim({0.3}, 0.5, 0.5, 1e-15), std::logic_error);
    CHECK_THROWS_AS(run.claim({0.25}, 0.6, 0.5, 1e-15), std::logic_error);
    CHECK_THROWS_AS(run.claim({0.25}, 0.5, 0.6, 1e-15), std::logic_error);
    run.claim({0.25}, 0.5, 0.5, 1e-15);
    CHECK_THROWS_AS(run.claim({0.25}, 0.5, 0.5, 1e-15), std::logic_error);
}

TEST_CASE("reactions are compared node by node", "[reference_matrix]") {
    const double inf = std::numeric_limits<double>::infinity();
    reference_run run(small_scene(), small_body());
    run.step(0.1);
    // FLIP: the held node starts at rest and stays there without stress.
    run.found_reaction({0.}, {0.});
    run.compare_reactions();
    CHECK(run.result().worst() == 0);
    run.found_reaction({0.}, {1.});
    run.compare_reactions();
    CHECK(run.result().worst() == inf);
    run.found_reaction({1.}, {0.});
    CHECK_THROWS_AS(run.compare_reactions(), std::logic_error);
}

TEST_CASE("bodies that hold other nodes are not compared", "[reference_matrix]") {
    reference_run run(small_scene(), small_body());
    run.step(0.1);
    CHECK_THROWS_AS(run.compare_reactions(), std::logic_error);
}
