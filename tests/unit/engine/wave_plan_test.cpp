#include <tamis/engine/wave_plan.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace tamis::detail;

namespace {

/// Numbers that tell in which order they were made from which others.
std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    a = (a ^ (b + 0x9e3779b97f4a7c15u + (a << 6) + (a >> 2))) * 0xff51afd7ed558ccdu;
    return a ^ (a >> 29);
}

std::vector<std::uint64_t> numbers(std::size_t count) {
    std::vector<std::uint64_t> all;
    for (std::size_t k = 0; k < count; ++k) all.push_back(mixed(k, 3));
    return all;
}

/// What the stages do, written from their meaning: slab k reaches nodes k and k + 1.
struct scene {
    std::vector<stage_shape> stages;
    std::size_t slabs;
    std::vector<std::uint64_t> particles = numbers(slabs);
    // Two fields of nodes: passes over slabs that give add to the first, those over nodes look at it and change both.
    std::vector<std::uint64_t> sums = numbers(slabs + 1), nodes = sums;

    void of_slab(std::size_t s, std::size_t k) {
        const stage_shape& stage = stages[s];
        particles[k] = mixed(mixed(particles[k], s), mixed(nodes[k], nodes[k + 1]));
        if (stage.first_colour == stage_shape::any_colour) return;
        for (const std::size_t j : {k, k + 1}) sums[j] = mixed(sums[j], particles[k]);
    }
    void of_nodes(std::size_t s, std::size_t k) {
        std::uint64_t seen = mixed(sums[k], s);
        if (stages[s].looks_around)
            for (std::size_t back = 1; back <= 2; ++back) {
                seen = mixed(seen, k < back ? 0 : sums[k - back]);
                seen = mixed(seen, k + back > slabs ? 0 : sums[k + back]);
            }
        nodes[k] = mixed(nodes[k], seen);
        if (!stages[s].looks_around) sums[k] = seen;
        // The nodes that only the last slab's particles reach go with its own.
        if (k + 1 == slabs) {
            nodes[k + 1] = mixed(nodes[k + 1], mixed(sums[k + 1], s));
            if (!stages[s].looks_around) sums[k + 1] = mixed(sums[k + 1], s);
        }
    }
    bool operator==(const scene& other) const {
        return particles == other.particles && sums == other.sums && nodes == other.nodes;
    }
};

scene one_after_the_other(std::vector<stage_shape> stages, std::size_t slabs) {
    scene a{std::move(stages), slabs};
    for (std::size_t s = 0; s < a.stages.size(); ++s) {
        const int first = a.stages[s].first_colour == 1 ? 1 : 0;
        if (a.stages[s].has_slabs)
            for (const int colour : {first, 1 - first})
                for (std::size_t k = static_cast<std::size_t>(colour); k < slabs; k += 2) a.of_slab(s, k);
        for (std::size_t k = 0; k < slabs; ++k) a.of_nodes(s, k);
    }
    return a;
}

/// Fronts advance in any order, as far as each has not to wait.
scene together(const wave_plan& plan, std::vector<stage_shape> stages, std::size_t slabs, unsigned seed) {
    scene a{std::move(stages), slabs};
    std::mt19937 random(seed);
    std::vector<std::size_t> next(plan.fronts(), 0);
    std::vector<char> done(plan.numbers(), 0);
    std::size_t left = 0, stuck = 0;
    for (std::size_t f = 0; f < plan.fronts(); ++f) left += plan.tasks_of(f).size();
    while (left > 0 && stuck < 1000 * plan.fronts()) {
        const std::size_t f = random() % plan.fronts();
        ++stuck;
        if (next[f] == plan.tasks_of(f).size()) continue;
        const auto& t = plan.tasks_of(f)[next[f]];
        bool ready = true;
        for (std::uint32_t k = t.first_wait; k < t.last_wait; ++k) ready = ready && done[plan.waits()[k]];
        if (!ready) continue;
        if (t.of_nodes)
            a.of_nodes(t.stage, t.slab);
        else
            a.of_slab(t.stage, t.slab);
        REQUIRE(!done[plan.number(t)]);
        done[plan.number(t)] = 1;
        ++next[f];
        --left;
        stuck = 0;
    }
    CHECK(left == 0);
    return a;
}

std::vector<stage_shape> any_stages(std::mt19937& random) {
    std::vector<stage_shape> stages(1 + random() % 7);
    for (std::size_t s = 0; s < stages.size(); ++s) switch (random() % 4) {
            case 0:
                stages[s] = {true, stage_shape::any_colour, false};
                break;
            case 1:
                stages[s] = {false, stage_shape::any_colour, s > 0};
                break;
            default:
                stages[s] = {true, static_cast<int>(random() % 2), false};
        }
    return stages;
}
std::vector<std::size_t> any_ends(std::mt19937& random, std::size_t slabs, std::size_t fronts) {
    std::vector<std::size_t> ends;
    for (std::size_t f = 1, k = 0; f < fronts; ++f) {
        const std::size_t room = slabs - k - (fronts - f);
        k += 1 + random() % room;
        ends.push_back(k);
    }
    ends.push_back(slabs);
    return ends;
}

}  // namespace

TEST_CASE("wave_plan: fronts make what passes one after the other make, whichever of them is ahead") {
    std::mt19937 random(7);
    for (int n = 0; n < 400; ++n) {
        const auto stages = any_stages(random);
        const std::size_t slabs = 1 + random() % 30;
        const auto ends = any_ends(random, slabs, 1 + random() % std::min<std::size_t>(slabs, 6));
        CAPTURE(n, stages.size(), ends);
        const wave_plan plan(stages, ends, n % 2 == 1);
        const scene expected = one_after_the_other(stages, slabs);
        for (unsigned seed = 0; seed < 3; ++seed) {
            const bool same = together(plan, stages, slabs, seed) == expected;
            CHECK(same);
        }
    }
}

TEST_CASE("wave_plan: so do many fronts of many slabs") {
    std::mt19937 random(11);
    for (const std::size_t fronts : {3u, 13u, 64u})
        for (const bool turned : {false, true}) {
            const auto stages = any_stages(random);
            std::vector<std::size_t> ends;
            for (std::size_t f = 1; f <= fronts; ++f) ends.push_back(128 * f / fronts);
            CAPTURE(fronts, turned, stages.size());
            const bool same =
                together(wave_plan(stages, ends, turned), stages, 128, 5) == one_after_the_other(stages, 128);
            CHECK(same);
        }
}

TEST_CASE("wave_plan: a scene in another order is another one") {
    const std::vector<stage_shape> stages{{true, 0, false}, {true, 1, false}};
    const auto expected = one_after_the_other(stages, 6);
    CHECK(one_after_the_other({{true, 1, false}, {true, 1, false}}, 6).sums != expected.sums);
}

TEST_CASE("wave_plan: one front comes back to a slab soon") {
    const bool turned = GENERATE(false, true);
    // A step of FMPM(4): zero, sums, three terms, the update.
    std::vector<stage_shape> stages{{false, stage_shape::any_colour, false}};
    for (int k = 0; k < 4; ++k) stages.push_back({true, k % 2, false});
    stages.push_back({true, stage_shape::any_colour, false});
    const wave_plan plan(stages, {40}, turned);
    std::array<std::vector<std::size_t>, 40> when;  // a slab's tasks, by the number of tasks over slabs done before
    std::size_t done = 0;
    for (const auto& t : plan.tasks_of(0))
        if (!t.of_nodes) when[t.slab].push_back(done++);
    for (const auto& times : when) {
        REQUIRE(times.size() == 5);
        CHECK(times.back() - times.front() < 35);
        for (std::size_t k = 1; k < times.size(); ++k) CHECK(times[k] - times[k - 1] < 14);
    }
}

TEST_CASE("wave_plan: fronts wait only where they meet") {
    const bool turned = GENERATE(false, true);
    const std::vector<stage_shape> stages{{true, 0, false}, {true, 1, false}, {true, 0, false}};
    const wave_plan plan(stages, {16, 32, 48, 64}, turned);
    for (std::size_t f = 0; f < 4; ++f)
        for (const auto& t : plan.tasks_of(f))
            for (std::uint32_t k = t.first_wait; k < t.last_wait; ++k) {
                const std::size_t other = plan.waits()[k] % 64;
                const std::size_t to_an_end = std::min(t.slab % 16, 15 - t.slab % 16);
                CHECK((other / 16 == f || to_an_end < 2));
            }
    // All tasks in one order, in which each comes after those that it waits for.
    std::vector<std::size_t> position(plan.numbers());
    std::set<std::size_t> seen;
    for (std::size_t f = 0; f < 4; ++f)
        for (const auto& t : plan.tasks_of(f)) {
            position[plan.number(t)] = t.position;
            CHECK(seen.insert(t.position).second);
            CHECK(t.position < plan.numbers());
        }
    for (std::size_t f = 0; f < 4; ++f)
        for (const auto& t : plan.tasks_of(f))
            for (std::uint32_t k = t.first_wait; k < t.last_wait; ++k) CHECK(position[plan.waits()[k]] < t.position);
    CHECK(plan.is_for(stages, {16, 32, 48, 64}, turned));
    CHECK(!plan.is_for(stages, {16, 32, 48, 64}, !turned));
    CHECK(!plan.is_for(stages, {16, 32, 47, 64}, turned));
    CHECK(!plan.is_for({{true, 0, false}}, {16, 32, 48, 64}, turned));
}

namespace {

/// Share of the time in which fronts work, if each takes its tasks as they come and a pass over a slab takes the time
/// `of_slab`, one over its nodes 1.
double busy(const wave_plan& plan, double of_slab) {
    std::vector<double> clock(plan.fronts(), 0), done(plan.numbers(), -1);
    std::vector<std::size_t> next(plan.fronts(), 0);
    double work = 0;
    bool some = true;
    while (some) {
        some = false;
        for (std::size_t f = 0; f < plan.fronts(); ++f) {
            if (next[f] == plan.tasks_of(f).size()) continue;
            const auto& t = plan.tasks_of(f)[next[f]];
            double start = clock[f];
            bool ready = true;
            for (std::uint32_t k = t.first_wait; k < t.last_wait; ++k) {
                ready = ready && done[plan.waits()[k]] >= 0;
                start = std::max(start, done[plan.waits()[k]]);
            }
            if (!ready) continue;
            const double takes = t.of_nodes ? 1 : of_slab;
            work += takes;
            done[plan.number(t)] = clock[f] = start + takes;
            ++next[f];
            some = true;
        }
    }
    for (std::size_t f = 0; f < plan.fronts(); ++f) REQUIRE(next[f] == plan.tasks_of(f).size());
    return work / static_cast<double>(plan.fronts()) / *std::max_element(clock.begin(), clock.end());
}

/// Zero, sums, `terms` terms of the mass matrix, the update.
std::vector<stage_shape> fmpm_step(int terms) {
    std::vector<stage_shape> stages{{false, stage_shape::any_colour, false}};
    for (int k = 0; k <= terms; ++k) stages.push_back({true, k % 2, false});
    stages.push_back({true, stage_shape::any_colour, false});
    return stages;
}

}  // namespace

TEST_CASE("wave_plan: two fronts do not wait for each other, more of them little") {
    const bool turned = GENERATE(false, true);
    for (const int terms : {0, 1, 3})
        for (const std::size_t slabs : {8u, 12u, 20u, 32u, 128u})
            for (const double of_slab : {12., 16., 24.}) {
                CAPTURE(turned, terms, slabs, of_slab);
                CHECK(busy(wave_plan(fmpm_step(terms), {slabs / 2, slabs}, turned), of_slab) > 0.98);
                if (slabs >= 32) {
                    const std::size_t part = slabs / 4;
                    CHECK(busy(wave_plan(fmpm_step(terms), {part, 2 * part, 3 * part, slabs}, turned), of_slab) > 0.9);
                }
            }
}
