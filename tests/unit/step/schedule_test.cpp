#include <tamis/tamis.hpp>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::detail;

namespace {

using S = space<2, double>;

// Stages of no meaning: what they read and make is all that counts.
struct a : vector_field {
    static constexpr std::string_view name = "a";
};
struct b : vector_field {
    static constexpr std::string_view name = "b";
};
struct c : vector_field {
    static constexpr std::string_view name = "c";
};
struct d : scalar_field {
    static constexpr std::string_view name = "d";
};
struct P : vector_field {
    static constexpr std::string_view name = "P";
};
struct Q : vector_field {
    static constexpr std::string_view name = "Q";
};

template <class... F> struct node_stage {
    static constexpr over where = over::nodes;
    static constexpr bool optional = true;
    using on_particles = fields<>;
    using on_nodes = fields<F...>;
};
template <class OnParticles, class... F> struct particle_stage {
    static constexpr over where = over::particles;
    static constexpr bool optional = true;
    using on_particles = OnParticles;
    using on_nodes = fields<F...>;
};
template <class... F> struct held_stage : node_stage<F...> { static constexpr over where = over::held; };

template <class A, class B> constexpr bool same = std::is_same_v<A, B>;
template <class F, class G> constexpr bool share_a_column(auto layout) {
    using L = decltype(layout);
    return same<typename column_of<L, F>::type, typename column_of<L, G>::type>;
}
template <class... Stage> using plan_of = schedule<S, stages<Stage...>>;

/// How many passes over particles a composition's step has.
template <class... Policy> constexpr int sweeps_of() {
    using plan = schedule_of<composition<uniform_grid<2, double>, Policy...>>;
    int count = 0;
    for (int k = 0; k < plan::count; ++k) count += plan::plan.kind[static_cast<std::size_t>(k)] == over::particles;
    return count;
}
template <class... Policy> constexpr int numbers_of_node() {
    using C = composition<uniform_grid<2, double>, Policy...>;
    return column_row<typename C::S, typename schedule_of<C>::layout>::components;
}

}  // namespace

TEST_CASE("schedule: what nobody reads is not run, and what only that reads neither") {
    using sum = particle_stage<fields<const P>, a>;
    using used = node_stage<const a, b>;
    using unused = node_stage<const a, c>;
    using also_unused = node_stage<const c, d>;
    using back = particle_stage<fields<const Q, Q>, const b>;
    using plan = plan_of<sum, unused, used, also_unused, back>;
    STATIC_REQUIRE(plan::count == 3);
    STATIC_REQUIRE(same<plan::dropped, stages<unused, also_unused>>);
    STATIC_REQUIRE(same<plan::stages_of_pass<1>, stages<used>>);
    // Asked for, it is run.
    using watching = schedule<S, stages<sum, unused, used, also_unused, back>, fields<d>>;
    STATIC_REQUIRE(same<watching::dropped, stages<>>);
    STATIC_REQUIRE(watching::kept<d>);
}

TEST_CASE("schedule: stages share a pass as far as what they read and make allows") {
    using first = particle_stage<fields<const P>, a>;
    using second = particle_stage<fields<const P>, b>;
    using divide_a = node_stage<const a, c>;
    using back = particle_stage<fields<const Q, Q>, const c>;
    // A sum of what the same pass has updated ...
    using of_update = particle_stage<fields<const Q>, d>;
    using plan = plan_of<first, divide_a, back, second, of_update, node_stage<const d, const b, a>,
                         particle_stage<fields<const P, P>, const a>>;
    STATIC_REQUIRE(same<plan::stages_of_pass<0>, stages<first, second>>);
    STATIC_REQUIRE(same<plan::stages_of_pass<2>, stages<back, of_update>>);
    STATIC_REQUIRE(same<plan::sums<0>, fields<a, b>>);
    STATIC_REQUIRE(same<plan::sums<2>, fields<d>>);
    // ... but not an update of what the same pass sums: terms are made after all updates.
    using update_first = particle_stage<fields<P>, const c>;
    using later = plan_of<first, divide_a, particle_stage<fields<const P>, b>, update_first, node_stage<const b, d>,
                          particle_stage<fields<const Q, Q>, const d>>;
    STATIC_REQUIRE(same<later::stages_of_pass<0>, stages<first, particle_stage<fields<const P>, b>>>);
}

TEST_CASE("schedule: nodes are done as late as they may, held nodes in the order of the text") {
    using sum = particle_stage<fields<const P>, a, b>;
    using hold_a = held_stage<const a, a>;
    using divide_d = node_stage<const b, d>;
    using hold_b = held_stage<const b, b>;
    using divide = node_stage<const a, const b, const d, c>;
    using back = particle_stage<fields<const Q, Q>, const c>;
    using plan = plan_of<sum, hold_a, divide_d, hold_b, divide, back>;
    // divide_d reads b before it is held, so it can't sink below hold_b.
    STATIC_REQUIRE(plan::count == 6);
    using free = plan_of<sum, hold_a, node_stage<const a, d>, hold_b, divide, back>;
    STATIC_REQUIRE(free::count == 4);
    STATIC_REQUIRE(same<free::stages_of_pass<1>, stages<hold_a, hold_b>>);
}

TEST_CASE("schedule: node fields take the columns of those that nobody reads any more") {
    using sum = particle_stage<fields<const P>, a, d>;
    using divide = node_stage<const a, const d, b>;
    using back = particle_stage<fields<const Q, Q>, const b, c>;
    using divide_again = node_stage<const c, a>;
    using last = particle_stage<fields<const P, P>, const a>;
    using plan = plan_of<sum, divide, back>;
    STATIC_REQUIRE(share_a_column<a, b>(plan::layout{}));
    STATIC_REQUIRE_FALSE(stores<plan::layout, c>);  // nobody reads it
    STATIC_REQUIRE(column_row<S, plan::layout>::components == 3);
    STATIC_REQUIRE(plan::kept<b>);
    STATIC_REQUIRE_FALSE(plan::kept<a>);
    // What is summed while another field is gathered has a column of its own.
    using more = plan_of<sum, divide, back, node_stage<const c, a>, last>;
    (void)sizeof(divide_again);
    STATIC_REQUIRE_FALSE(share_a_column<b, c>(more::layout{}));
}

TEST_CASE("schedule: passes over particles and numbers a node of the composed steps") {
    STATIC_REQUIRE(sweeps_of<flip, usl_minus>() == 2);
    STATIC_REQUIRE(sweeps_of<flip, usf>() == 3);
    STATIC_REQUIRE(sweeps_of<flip, usl_plus>() == 3);
    STATIC_REQUIRE(sweeps_of<flip, usavg_minus>() == 3);
    STATIC_REQUIRE(sweeps_of<pic, usavg_plus>() == 4);
    STATIC_REQUIRE(sweeps_of<apic, usl_plus>() == 3);
    STATIC_REQUIRE(numbers_of_node<flip, usl_minus>() == 5);
    STATIC_REQUIRE(numbers_of_node<pic, usl_minus>() == 5);
    STATIC_REQUIRE(numbers_of_node<pic, usl_plus>() == 5);
    STATIC_REQUIRE(numbers_of_node<flip, usl_plus>() == 7);
    STATIC_REQUIRE(numbers_of_node<flip, usl_minus, held>() == 5);
    // FLIP of held particles that others strain needs no momentum of the start.
    using plan = schedule_of<composition<uniform_grid<2, double>, flip, usl_plus, held>>;
    STATIC_REQUIRE_FALSE(stores<plan::layout, field::momentum>);
}

TEST_CASE("explain: passes, what they move, what is not run, what is stored") {
    const solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, linear{}, flip{}, usl_minus{}};
    CHECK(explain(mpm) == R"(flip, usl-, linear, moving particles, 2D
 1 particles  m = S^T M; p = S^T M V; f = -G^T V0 tau
     particle: reads M X V V0 tau (9)
     node: sums m p f (5)
     exchange m p f (5)
 2 nodes      1/m; v0 = p/m; a = f/m; v = v0 + a dt
     node: reads m p f (5), writes a v (4)
 3 particles  V += S a dt; U = S v dt; strain by v over dt; X += U
     particle: reads X V tau (7), writes X V tau (7)
     node: reads a v (4)
 4 storage    migrate
not run, for nobody reads it: p_n = S^T M V; v_n = p_n/m
not there: conditions, contact, loads, full mass matrix
stored: particle X M V V0 tau (9) besides the law's own; node m p f a v (9) in 5 numbers
)");
}
