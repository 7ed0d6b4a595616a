// Two blocks that run into each other and rub, on a floor: contact in the library and in the reference.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "../reference/contact.hpp"
#include "../support/compare.hpp"
#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;

constexpr double spacing = 0.1, young = 1, poisson = 0.3, dt = 0.015;
constexpr std::array<double, 2> density{1., 1.7};
// Linear functions answer nodes of little mass violently once particles reach new cells.
template <class Shape> constexpr int steps = std::same_as<Shape, linear> ? 20 : 40;

const auto left = [](const auto& at) { return at[0] > 0.1 && at[0] < 0.5 && at[1] < 0.5; };
const auto right = [](const auto& at) { return at[0] > 0.5 && at[0] < 0.8 && at[1] < 0.4; };
const auto on_floor = [](const auto& at) { return at[1] < spacing / 4; };
const auto slanted = [](const auto& at) { return place(std::cos(0.5 * at[1] - 0.1), std::sin(0.5 * at[1] - 0.1)); };

/// The blocks approach below, part above and slide, and are stressed: where nothing pulls, round-off would decide who
/// touches.
void start(std::vector<reference::state>& blocks) {
    for (std::size_t b = 0; b < 2; ++b) {
        reference::state& block = blocks[b];
        const double sign = b == 0 ? 1 : -1;
        for (Eigen::Index p = 0; p < block.size(); ++p) {
            const double X = block.x(p, 0), Y = block.x(p, 1);
            block.v(p, 0) = sign * (0.03 - 0.1 * Y) + 0.04 * std::sin(9 * X + 11 * Y);
            block.v(p, 1) = sign * (0.02 + 0.03 * Y) + 0.02 * std::cos(5 * X - 8 * Y);
            Eigen::MatrixXd& stress = block.stress[static_cast<std::size_t>(p)];
            stress << 0.03 * std::cos(4 * X + 3 * Y), 0.01 * std::sin(7 * Y), 0.01 * std::sin(7 * Y),
                0.02 * std::sin(3 * X - 5 * Y);
        }
    }
}

/// Largest difference and value of a quantity.
struct extent {
    double difference = 0, size = 0;
    void add(double found, double expected) {
        difference = std::max(difference, std::isfinite(found) ? std::abs(found - expected) : INFINITY);
        size = std::max(size, std::abs(expected));
    }
    double relative() const { return difference == 0 ? 0 : difference / size; }
};

struct tally {
    int apart = 0, sticks = 0, slides = 0;
};

template <class Shape, class Order, class Update, class Contact>
tally check(const Update& update, const reference::update& same, const Contact& policy,
            const reference::contact_rule& rule) {
    CAPTURE(Shape::name, Order::name, Update::name, same.k, static_cast<int>(rule.law), rule.mu, rule.cells,
            static_cast<bool>(rule.normal));
    solver mpm{
        uniform_grid{{0., 0.}, {1., 0.7}, spacing}, Shape{}, Order{}, update, slip{on_floor, place(0, 1)}, policy};
    const linear_elastic law_one{.young = young, .poisson = poisson, .density = density[0]};
    const linear_elastic law_two{.young = young, .poisson = poisson, .density = density[1]};
    auto one = mpm.make_body(law_one, left, per_cell{2}, fields<compare::number>{});
    auto two = mpm.make_body(law_two, right, per_cell{2}, fields<compare::number>{});

    reference::scene set;
    set.lower = Eigen::Vector2d(0, 0);
    set.upper = Eigen::Vector2d(1, 0.7);
    set.spacing = spacing;
    set.shape = compare::same(Shape{});
    set.order = compare::same(Order{});
    set.update = same;
    set.young = Eigen::VectorXd::Constant(1, young);
    set.poisson = poisson;
    set.conditions = {{on_floor, {{Eigen::Vector2d(0, 1), [](const Eigen::VectorXd&, double) { return 0.; }}}}};
    std::vector<reference::state> blocks{reference::make_particles(set, 2, density[0], left),
                                         reference::make_particles(set, 2, density[1], right)};
    start(blocks);
    compare::reference_run first(set, blocks[0]), second(set, blocks[1]);
    compare::start(one, first);
    compare::start(two, second);

    extent position, velocity, stress, reaction, force, heat;
    double heat_so_far = 0, margin = INFINITY;
    tally all;
    for (int n = 1; n <= steps<Shape>; ++n) {
        const reference::contact_result told = reference::advance(set, rule, blocks, (n - 1) * dt, dt);
        mpm.step(bodies(one, two), dt, n * dt);
        margin = std::min(margin, told.margin);

        heat_so_far += told.heat;
        heat.add(mpm.friction_heat(), heat_so_far);
        for (const auto& node : mpm.reactions()) {
            const auto i = static_cast<Eigen::Index>(std::lround(node.at[0] / spacing) +
                                                     std::lround(node.at[1] / spacing) * set.nodes_along(0));
            for (int d = 0; d < 2; ++d) reaction.add(node.reaction[d], told.reactions(i, d));
        }
        auto touching = mpm.touching();
        for (const reference::shared_node& e : told.touching) {
            const Eigen::VectorXd at = set.node_position(e.node);
            const auto found = std::find_if(touching.begin(), touching.end(), [&](const auto& node) {
                return (node.at - place(at)).norm() < spacing / 100 && node.first == static_cast<int>(e.a) &&
                       node.second == static_cast<int>(e.b);
            });
            ++(e.state == reference::contact_state::apart    ? all.apart
               : e.state == reference::contact_state::slides ? all.slides
                                                             : all.sticks);
            const bool touched = e.state != reference::contact_state::apart;
            REQUIRE((found != touching.end()) == (touched || e.force.norm() > 0));
            if (found != touching.end()) CHECK(found->slides == (e.state == reference::contact_state::slides));
            for (int d = 0; d < 2; ++d) force.add(found == touching.end() ? 0 : found->force[d], e.force[d]);
        }
        if (n != 1 && n % 10 != 0) continue;
        const auto compare_block = [&](const auto& body, const reference::state& block) {
            for (const auto p : body) {
                const auto k = static_cast<Eigen::Index>(p[compare::number{}]);
                for (int d = 0; d < 2; ++d) {
                    position.add(p[x][d], block.x(k, d));
                    velocity.add(p[v][d], block.v(k, d));
                    for (int e = 0; e < 2; ++e)
                        stress.add(p[sigma](d, e), block.stress[static_cast<std::size_t>(k)](d, e));
                }
            }
        };
        compare_block(std::as_const(one), blocks[0]);
        compare_block(std::as_const(two), blocks[1]);
    }
    INFO("relative differences: position "
         << position.relative() << ", velocity " << velocity.relative() << ", stress " << stress.relative()
         << ", reaction " << reaction.relative() << ", contact force " << force.relative() << ", heat "
         << heat.relative() << "; nodes that are apart " << all.apart << ", stick " << all.sticks << ", slide "
         << all.slides << "; margin of decisions " << margin);
    for (const extent& each : {position, velocity, stress, reaction, force, heat}) CHECK(each.relative() < 1e-10);
    if (rule.law != reference::contact_law::bonded) CHECK(margin > 1e-9);
    return all;
}

using reference::contact_law;

template <class Shape, class Order, class Update = fmpm<tamis::dynamic>, class Contact>
void check_terms(const Contact& policy, const reference::contact_rule& rule) {
    for (const int k : {1, 2, 4}) {
        const Update update{k};
        const tally all = check<Shape, Order>(update, compare::same(update), policy, rule);
        CHECK(all.sticks + all.slides > 20);
        if (rule.law == contact_law::bonded) continue;
        CHECK(all.apart > 0);
        CHECK(all.slides > 5);
        if (rule.law == contact_law::coulomb) CHECK(all.sticks > 0);
    }
}

}  // namespace

TEST_CASE("contact: fmpm with Coulomb friction agrees with the reference", "[reference_matrix]") {
    check_terms<quadratic_spline, usl_minus>(contact{coulomb{0.3}, normal_by_mass{}, by_approach{}},
                                             {.law = contact_law::coulomb, .mu = 0.3});
    check_terms<linear, usavg_minus>(contact{coulomb{0.4}, given_normal{slanted}, by_separation{0.8}},
                                     {.law = contact_law::coulomb, .mu = 0.4, .normal = slanted, .cells = 0.8});
    check_terms<quadratic_spline, usl_plus>(contact{coulomb{0.3}, normal_by_mass{}, by_separation{0.9}},
                                            {.law = contact_law::coulomb, .mu = 0.3, .cells = 0.9});
}

TEST_CASE("contact: fmpm without friction agrees with the reference", "[reference_matrix]") {
    check_terms<linear, usl_minus>(contact{frictionless{}, given_normal{slanted}, by_approach{}},
                                   {.law = contact_law::frictionless, .normal = slanted});
    check_terms<quadratic_spline, usavg_minus>(contact{frictionless{}, normal_by_mass{}, by_approach{}},
                                               {.law = contact_law::frictionless});
}

TEST_CASE("contact: fmpm of bonded bodies agrees with the reference", "[reference_matrix]") {
    check_terms<quadratic_spline, usl_plus>(contact{bonded{}}, {.law = contact_law::bonded});
}

TEST_CASE("contact: fmpm with contact on p+ alone agrees with the reference", "[reference_matrix]") {
    check_terms<quadratic_spline, usavg_minus>(
        contact{coulomb{0.3}, normal_by_mass{}, by_approach{}, contact_method::lumped{}},
        {.law = contact_law::coulomb, .mu = 0.3, .stage = reference::contact_stage::momentum});
}

TEST_CASE("contact: fmpm with contact after the series agrees with the reference", "[reference_matrix]") {
    check_terms<quadratic_spline, usl_minus>(
        contact{coulomb{0.3}, normal_by_mass{}, by_approach{}, contact_method::velocity{}},
        {.law = contact_law::coulomb, .mu = 0.3, .stage = reference::contact_stage::velocity});
    check_terms<quadratic_spline, usl_plus>(
        contact{frictionless{}, given_normal{slanted}, by_approach{}, contact_method::velocity{}},
        {.law = contact_law::frictionless, .normal = slanted, .stage = reference::contact_stage::velocity});
}

TEST_CASE("contact: xpic with contact on p+ and on the increments agrees with the reference", "[reference_matrix]") {
    check_terms<quadratic_spline, usavg_minus, xpic<tamis::dynamic>>(
        contact{coulomb{0.3}, normal_by_mass{}, by_approach{}}, {.law = contact_law::coulomb, .mu = 0.3});
}

TEST_CASE("contact: the law asked about every partial sum agrees with the reference", "[reference_matrix]") {
    const contact policy{coulomb{0.3}, normal_by_mass{}, by_approach{}, contact_method::net{}};
    const reference::contact_rule rule{.law = contact_law::coulomb, .mu = 0.3, .stage = reference::contact_stage::sums};
    check_terms<quadratic_spline, usl_plus>(policy, rule);
    check_terms<quadratic_spline, usl_minus, xpic<tamis::dynamic>>(policy, rule);
}

TEST_CASE("contact: what contact changed at the start filtered out agrees with the reference", "[reference_matrix]") {
    const contact policy{coulomb{0.3}, normal_by_mass{}, by_approach{}, contact_method::filtered{}};
    const reference::contact_rule rule{
        .law = contact_law::coulomb, .mu = 0.3, .stage = reference::contact_stage::filtered};
    check_terms<quadratic_spline, usl_plus>(policy, rule);
    check_terms<quadratic_spline, usl_minus, xpic<tamis::dynamic>>(policy, rule);
}

TEST_CASE("contact: flip agrees with the reference", "[reference_matrix]") {
    const reference::update same = reference::flip();
    check<quadratic_spline, usl_minus>(flip{}, same, contact{bonded{}}, {.law = contact_law::bonded});
    check<linear, usl_minus>(flip{}, same, contact{coulomb{0.3}, normal_by_mass{}, by_approach{}},
                             {.law = contact_law::coulomb, .mu = 0.3});
    check<quadratic_spline, usavg_minus>(flip{}, same, contact{frictionless{}, normal_by_mass{}, by_separation{0.8}},
                                         {.law = contact_law::frictionless, .cells = 0.8});
    check<quadratic_spline, usl_plus>(flip{}, same, contact{coulomb{0.4}, given_normal{slanted}, by_approach{}},
                                      {.law = contact_law::coulomb, .mu = 0.4, .normal = slanted});
}
