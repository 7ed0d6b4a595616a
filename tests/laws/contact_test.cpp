// Contact between bodies that have velocity fields of their own.
#include <tamis/tamis.hpp>

#include <cmath>
#include <map>
#include <string>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;
const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};

const auto left = [](const auto& at) { return at[0] < 0.5 && at[1] < 0.5; };
const auto right = [](const auto& at) { return at[0] > 0.5 && at[1] < 0.5; };
const auto floor_holds = slip{[](const auto& at) { return at[1] <= 0; }, place(0, 1)};
const auto rough = [](const auto& at) {
    return place(0.05 * std::sin(9 * at[0] + 4 * at[1]), 0.03 * std::cos(5 * at[0] - 8 * at[1]));
};

/// What a run leaves: velocities by place of birth, which particles keep within their cells' reach.
struct outcome {
    std::vector<std::array<double, 4>> particles;  // place and velocity, sorted
    place lost = place::Zero();                    // momentum that reactions do not explain
    double energy = 0;
};

template <class Body> void collect(outcome& out, const Body& body) {
    for (const auto p : body) out.particles.push_back({p[x][0], p[x][1], p[v][0], p[v][1]});
    out.energy += kinetic_energy(body) + elastic_energy(body);
    out.lost += total_momentum(body);
}

template <bool TwoBodies, class... Policy> outcome run(int steps, const Policy&... policies) {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, floor_holds, policies...};
    auto one = mpm.make_body(law, left, per_cell{2});
    auto two = mpm.make_body(law, right, per_cell{2});
    set_velocity_of(one, rough);
    set_velocity_of(two, rough);
    outcome out;
    out.lost = -(total_momentum(one) + total_momentum(two));
    for (int k = 0; k < steps; ++k) {
        mpm.step(bodies(one, two), 0.02);
        for (const auto& node : mpm.reactions()) out.lost -= node.reaction * 0.02;
    }
    collect(out, one);
    collect(out, two);
    std::sort(out.particles.begin(), out.particles.end());
    return out;
}
double difference(const outcome& a, const outcome& b) {
    double most = 0;
    REQUIRE(a.particles.size() == b.particles.size());
    for (std::size_t k = 0; k < a.particles.size(); ++k)
        for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(a.particles[k][c] - b.particles[k][c]));
    return most;
}

template <class Scheme, class... More> void sticks_as_one(const Scheme& scheme, const More&... more) {
    const auto one = run<false>(40, scheme, more...);
    const auto two = run<true>(40, scheme, contact{bonded{}}, more...);
    CHECK(difference(one, two) < 1e-12);
    CHECK(two.lost.norm() < 1e-14);
}

}  // namespace

TEST_CASE("contact: a perfect interface is the one-body run, for FMPM(1) to FMPM(8)") {
    for (int k = 1; k <= 8; ++k) {
        CAPTURE(k);
        sticks_as_one(fmpm<dynamic>{k}, linear{});
    }
    const auto one = run<false>(40, fmpm<4>{});
    const auto two =
        run<true>(40, fmpm<4>{}, contact{bonded{}, normal_by_mass{}, by_approach{}, contact_method::net{}});
    CHECK(difference(one, two) < 1e-12);
    sticks_as_one(fmpm<4>{}, usavg_plus{});
    sticks_as_one(fmpm<3>{}, usf{}, cubic_spline{});
    sticks_as_one(xpic<3>{});
    sticks_as_one(flip{}, usl_plus{});
    sticks_as_one(pic{}, held{});
    sticks_as_one(fmpm<2>{}, held{}, usavg_minus{});
}

TEST_CASE("contact: momentum is kept exactly by every law, detection and method") {
    const auto kept = [](const auto& policy, const auto&... more) {
        CHECK(run<true>(40, policy, fmpm<3>{}, more...).lost.norm() < 1e-14);
        CHECK(run<true>(40, policy, flip{}, usf{}, more...).lost.norm() < 1e-14);
    };
    kept(contact{frictionless{}});
    kept(contact{coulomb{0.3}});
    kept(contact{coulomb{0.3}, given_normal{place(1, 0)}});
    kept(contact{coulomb{0.3}, normal_by_mass{}, by_separation{0.8}});
    kept(contact{coulomb{0.3}, normal_by_mass{}, by_approach{}, contact_method::lumped{}});
    const auto kept_by = [](const auto& method, const auto& scheme) {
        const contact policy{coulomb{0.3}, normal_by_mass{}, by_approach{}, method};
        CHECK(run<true>(40, policy, scheme).lost.norm() < 1e-14);
    };
    kept_by(contact_method::velocity{}, fmpm<3>{});
    kept_by(contact_method::net{}, fmpm<3>{});
    kept_by(contact_method::net{}, xpic<3>{});
    kept_by(contact_method::filtered{}, fmpm<3>{});
    kept_by(contact_method::filtered{}, xpic<3>{});
}

TEST_CASE("contact: bodies that do not meet move as alone, and parting ones are let go") {
    solver alone{uniform_grid{{0., 0.}, {2., 1.}, 0.1}, fmpm<2>{}};
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.1}, fmpm<2>{}, contact{coulomb{0.3}}};
    const auto near = [](const auto& at) { return at[0] > 0.5 && at[0] < 1 && at[1] > 0.2 && at[1] < 0.6; };
    const auto beside = [](const auto& at) { return at[0] > 1 && at[0] < 1.5 && at[1] > 0.2 && at[1] < 0.6; };
    auto free = alone.make_body(law, near, per_cell{2});
    auto one = mpm.make_body(law, near, per_cell{2});
    auto two = mpm.make_body(law, beside, per_cell{2});
    const auto away = [](double speed) { return [speed](const auto&) { return place(speed, 0); }; };
    set_velocity_of(free, away(-0.1));
    set_velocity_of(one, away(-0.1));
    set_velocity_of(two, away(0.1));
    for (int k = 0; k < 50; ++k) {
        alone.step(bodies(free), 0.02);
        mpm.step(bodies(one, two), 0.02);
    }
    for (const auto p : std::as_const(one)) {
        CHECK(std::abs(p[v][0] + 0.1) < 1e-14);
        CHECK(std::abs(p[v][1]) < 1e-14);
    }
    CHECK((total_momentum(one) - total_momentum(free)).norm() < 1e-14);
    CHECK(mpm.touching().empty());
    CHECK(mpm.friction_heat() == 0);
}

TEST_CASE("contact: a frictionless meeting exchanges normal momentum only") {
    solver mpm{uniform_grid{{0., 0.}, {2., 1.}, 0.1}, flip{}, contact{frictionless{}, given_normal{place(1, 0)}}};
    auto one = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.5 && at[0] < 1; }, per_cell{2});
    auto two = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 1.5; }, per_cell{2});
    set_velocity_of(one, [](const auto&) { return place(0.02, 0.01); });
    set_velocity_of(two, [](const auto&) { return place(-0.02, -0.01); });
    for (int k = 0; k < 20; ++k) mpm.step(bodies(one, two), 0.02);
    CHECK(total_momentum(one)[0] < 0.009);
    CHECK(std::abs(total_momentum(one)[1] - 0.5 * 0.01) < 1e-15);
    CHECK(!mpm.touching().empty());
}

TEST_CASE("contact: bad parameters get a sentence") {
    std::string text;
    try {
        coulomb{-0.1};
    } catch (const error& e) {
        text = e.what();
    }
    CHECK(text.find("mu is -0.1; give 0 or more") != std::string::npos);
}
