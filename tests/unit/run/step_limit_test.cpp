#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using grid = uniform_grid<1, double>;
/// Waves of speed 2, in cells of 1/4.
const linear_elastic law{.young = 4, .poisson = 0, .density = 1};

/// Held particles in cells of 1/4, `per_cell` in each from x = 2 on; the last one is beyond a node by so much that that
/// has `share` of an inner node's mass.
std::vector<point<1, double>> ending_at_node(int per_cell, double share) {
    std::vector<point<1, double>> places;
    for (int p = 0; p < 8 * per_cell + 1; ++p)
        places.push_back(point<1, double>(2 + 0.25 * (share * per_cell + static_cast<double>(p) / per_cell)));
    return places;
}

}  // namespace

TEST_CASE("step_limit: a particle lighter than its law says carries waves faster") {
    solver mpm{grid{{0.}, {1.}, 0.25}, linear{}, held{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{1});
    CHECK(integrate(mpm, bodies(bar), {0, 1}, courant{0.5}) == 16);
    // One of a ninth of the density: three times the speed.
    for (auto p : bar)
        if (p[x][0] > 0.7) p[m] /= 9;
    CHECK(std::abs(detail::wave_speed_of(std::as_const(bar)) - 6) < 1e-12);
    CHECK(integrate(mpm, bodies(bar), {0, 1}, courant{0.5}) == 48);
    // Heavier ones are not waited for: the law's own speed counts.
    for (auto p : bar) p[m] = p[V] * 4;
    CHECK(detail::wave_speed_of(std::as_const(bar)) == 2);
}

TEST_CASE("step_limit: the fastest of several bodies counts, and the fastest particle of each") {
    solver mpm{grid{{0.}, {16.}, 0.25}};
    auto slow = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 2; }, per_cell{2});
    auto fast = mpm.make_body(
        linear_elastic{.young = 9, .density = 1}, [](const auto& at) { return at[0] > 8 && at[0] < 9; }, per_cell{2});
    const auto speed = [&] { return detail::signal_speed<moving>(bodies(slow, fast)); };
    CHECK(speed() == 3);
    CHECK(detail::signal_speed<moving>(bodies(fast, slow)) == 3);
    (*slow.begin())[v][0] = -5;
    CHECK(speed() == 7);
    CHECK(detail::signal_speed<held>(bodies(slow, fast)) == 3);
}

TEST_CASE("step_limit: the largest and the smallest volume of a body both count") {
    // With FMPM(8) and USF a free end allows less, the more particles share a cell: 0.494 for one, 0.271 for four.
    solver mpm{grid{{0.}, {8.}, 0.25}, linear{}, fmpm<8>{}, usf{}, held{}};
    const auto limit_with = [&](double volume) {
        auto bar = mpm.make_body_at(law, ending_at_node(1, 0.01), 0.25);
        bool first = true;
        for (auto p : bar) {
            if (std::exchange(first, false)) {
                p[V] = volume;
                p[m] = volume;
            }
        }
        return detail::limit_of(mpm, bodies(bar), {});
    };
    const auto even = limit_with(0.25);
    CHECK(even.known);
    CHECK(std::abs(even.share - 0.01) < 1e-12);
    CHECK(std::abs(even.free_end - 0.494) < 1e-12);
    // Inside it allows more, 0.494 and 0.58.
    CHECK(std::abs(even.inner - 0.494) < 1e-12);
    CHECK(std::abs(limit_with(0.0625).free_end - 0.271) < 1e-12);
    CHECK(std::abs(limit_with(0.0625).inner - 0.494) < 1e-12);
}

TEST_CASE("step_limit: the lightest inner node of all bodies is what a free end is compared with") {
    solver mpm{grid{{0.}, {16.}, 0.25}, linear{}, fmpm<2>{}, held{}};
    const auto there = ending_at_node(2, 0.1);
    const linear_elastic light_law{.young = 4, .poisson = 0, .density = 0.5};
    auto heavy = mpm.make_body_at(law, there, 0.125);
    auto light = mpm.make_body(
        light_law, [](const auto& at) { return at[0] > 8 && at[0] < 12; }, per_cell{2});
    // The heavy one's last node has 0.1 of a node of its own kind, 0.2 of one of the other.
    for (const double share :
         {detail::limit_of(mpm, bodies(heavy, light), {}).share, detail::limit_of(mpm, bodies(light, heavy), {}).share})
        CHECK(std::abs(share - 0.2) < 1e-12);
    CHECK(std::abs(detail::limit_of(mpm, bodies(heavy), {}).share - 0.1) < 1e-12);
}

TEST_CASE("step_limit: a node of next to no mass does not stop an automatic step: a tenth of the inner limit is kept") {
    solver mpm{grid{{0.}, {8.}, 0.25}, linear{}, fmpm<2>{}, usl_minus{}, held{}};
    auto bar = mpm.make_body_at(law, ending_at_node(2, 1e-9), 0.125);
    const auto limit = detail::limit_of(mpm, bodies(bar), {});
    CHECK(limit.free_end < 1e-3);
    std::vector<warning> told;
    const long steps = integrate(mpm, bodies(bar), {0, 1}, courant{}, [&](const warning& one) { told.push_back(one); });
    CHECK(steps == static_cast<long>(std::ceil(8 / (0.9 * 0.1 * limit.inner))));
    CHECK(told.size() == 1);
}

TEST_CASE("step_limit: particles that are no numbers are looked for every 1000 steps, held ones by any pace") {
    const auto found = [](auto pace, long bad_from, auto checks) {
        solver mpm{grid{{0.}, {1.}, 0.25}, linear{}, held{}, checks};
        auto bar = mpm.make_body(law, everywhere, per_cell{1});
        const auto spoil = [&](const progress_state& now) {
            if (now.step == bad_from) (*bar.begin())[sigma](0, 0) = std::numeric_limits<double>::quiet_NaN();
        };
        return complaint([&] { integrate(mpm, bodies(bar), {0, 1}, pace, spoil); });
    };
    CHECK(names(found(fixed_steps{4500}, 300, unchecked{}), "step 1000, t = 0.2222", "not a number"));
    CHECK(names(found(fixed_steps{4500}, 2300, unchecked{}), "step 3000, t = 0.666", "not a number"));
    CHECK(names(found(fixed_steps{4500}, 4200, unchecked{}), "step 4500, t = 1", "not a number"));
    // 8/n steps.
    CHECK(names(found(courant{8. / 4500}, 300, unchecked{}), "step 1000, t = 0.2222", "not a number"));
    CHECK(names(found(courant{8. / 4500}, 2300, unchecked{}), "step 3000, t = 0.666", "not a number"));
    CHECK(names(found(courant{8. / 4500}, 4200, unchecked{}), "step 4500, t = 1", "not a number"));
    CHECK(found(fixed_steps{4500}, -1, unchecked{}) == "nothing");
    // A step that is checked finds them by itself.
    CHECK(names(found(fixed_steps{4500}, 300, checked{}), "step 300, t = 0.0666", "not a number"));
    CHECK(names(found(courant{8. / 4500}, 2300, checked{}), "step 2300, t = 0.511", "not a number"));
    CHECK(found(fixed_steps{4500}, -1, checked{}) == "nothing");
}

TEST_CASE("step_limit: steps of moving particles are chosen anew every 20 steps, and their numbers looked at") {
    solver mpm{grid{{0.}, {64.}, 0.25}};
    auto bar = mpm.make_body(
        law, [](const auto& at) { return at[0] > 8 && at[0] < 9; }, per_cell{2});
    std::vector<double> times;
    const auto push = [&](const progress_state& now) {
        times.push_back(now.time);
        if (now.step == 5)
            for (auto p : bar) p[v][0] = 6;
    };
    integrate(mpm, bodies(bar), {0, 4}, courant{0.5}, push);
    const auto step = [&](std::size_t k) { return times[k] - times[k - 1]; };
    for (const std::size_t k : {1u, 6u, 20u}) CHECK(std::abs(step(k) / 0.0625 - 1) < 1e-9);
    for (const std::size_t k : {21u, 22u, 40u}) CHECK(std::abs(step(k) / 0.015625 - 1) < 0.02);
    CHECK(times.back() == 4);

    const auto spoil = [&](const progress_state& now) {
        if (now.step == 31) (*bar.begin())[sigma](0, 0) = std::numeric_limits<double>::infinity();
    };
    // The step itself tells, or the look after it.
    CHECK(names(complaint([&] { integrate(mpm, bodies(bar), {4, 6}, courant{0.5}, spoil); }), "not a number"));
}

TEST_CASE("step_limit: fixed steps are held against the limit again after 1000 of them") {
    solver mpm{grid{{0.}, {1.}, 0.25}, linear{}, held{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{1});
    // A hundredth of the density: ten times the speed.
    const auto lighten = [&](const progress_state& now) {
        if (now.step == 500)
            for (auto p : bar) p[m] /= 100;
    };
    // The Courant number is 0.2 at first, 2 then.
    const std::string why = complaint([&] { integrate(mpm, bodies(bar), {0, 50}, fixed_steps{2000}, lighten); });
    CAPTURE(why);
    CHECK(names(why, "step 1000, t = 25", "Courant number", "is 2 with dt = 0.025"));
}

TEST_CASE("step_limit: observers are told what the steps are as long as they are for") {
    const auto told = [](const auto& body_law, const auto& pace, const auto& places, const auto&... policies) {
        solver mpm{grid{{0.}, {16.}, 0.25}, policies...};
        auto bar = mpm.make_body_at(body_law, places, 0.125);
        progress_state last{};
        integrate(mpm, bodies(bar), {0, 0.01}, pace, [&](const progress_state& now) { last = now; });
        CHECK(last.dt > 0);
        CHECK(std::abs(last.dt * static_cast<double>(last.step) / 0.01 - 1) < 1e-12);
        return std::string(name_of(last.bound));
    };
    const auto even = ending_at_node(2, 0.5), light = ending_at_node(2, 1e-3);
    const neo_hookean stiff{.young = 4, .density = 1};
    CHECK(told(law, courant{}, even) == "waves");
    CHECK(told(law, courant{0.1}, even) == "given");
    CHECK(told(law, fixed_steps{10}, even) == "given");
    CHECK(told(law, courant{}, light, linear{}, usl_minus{}) == "free end");
    CHECK(told(law, courant{}, even, particle_damping{1e5}) == "load");
    CHECK(told(newtonian<neo_hookean>{stiff, 1e4}, courant{}, even) == "law");
    CHECK(told(newtonian<neo_hookean>{stiff, 1e4}, courant{}, even, particle_damping{1e6}) == "load");
}
