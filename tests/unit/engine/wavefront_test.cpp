#include <tamis/engine/wavefront.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "catch.hpp"

using namespace tamis;
using detail::node_range;
using detail::wavefront;
using pass = wavefront::pass_type;

namespace {

/// Says that it has several threads, and has one: calls come one after the other.
struct one_after_another {
    int count() const { return 3; }
    template <class F> void for_each(std::size_t n, const F& f) const {
        for (std::size_t k = n; k-- > 0;) f(k);
    }
};

constexpr std::size_t slabs = 20;
std::vector<std::size_t> first_nodes() {
    std::vector<std::size_t> all;
    for (std::size_t k = 0; k < slabs; ++k) all.push_back(100 * k + 300);
    return all;
}

/// Sums that slabs of two particles give to nodes, then what nodes make of them, three times over.
template <class Execution> std::vector<double> run(const Execution& how, int threads, std::size_t fails_at = 1000) {
    std::vector<double> nodes(100 * slabs + 600, 0.1), sums(nodes.size(), 0.0);
    wavefront wave;
    wave.start(first_nodes(), std::vector<std::size_t>(slabs, 10), threads);
    for (int stage = 0; stage < 3; ++stage) {
        wave.over_slabs(pass([&, stage](std::size_t k, std::size_t) {
                            if (k == fails_at && stage == 1) throw std::runtime_error("of slab");
                            for (std::size_t j = 0; j < 150; ++j)
                                sums[300 + 100 * k + j] +=
                                    nodes[300 + 100 * k + j] / double(3 + stage + int(j + k) % 7);
                        }),
                        stage % 2);
        wave.over_nodes(pass([&](std::size_t first, std::size_t last) {
            for (std::size_t j = first; j < std::min(last, nodes.size()); ++j) {
                nodes[j] = 0.3 * nodes[j] + sums[j];
                sums[j] = 0;
            }
        }));
    }
    int ends = 0;
    wave.at_end(pass([&](std::size_t, std::size_t) { ++ends; }));
    CHECK(!wave.empty());
    wave.run(how);
    CHECK(ends == 1);
    CHECK(wave.empty());
    wave.run(how);
    CHECK(ends == 1);
    return nodes;
}

}  // namespace

TEST_CASE("wavefront: results are the same for any number of fronts and threads, and where threads are fewer") {
    const auto alone = run(serial{}, 1);
    CHECK(run(one_after_another{}, 3) == alone);
    CHECK(run(one_after_another{}, 100) == alone);
#if defined(_OPENMP)
    for (const int count : {1, 2, 3, 7}) {
        const threads team(count);
        for (int again = 0; again < 20; ++again) {
            const bool same = run(team, count) == alone;
            CHECK(same);
        }
    }
    // Inside a parallel region each team has one thread.
    std::atomic<int> same{0};
#pragma omp parallel num_threads(2)
    {
        const threads team(4);
        wavefront wave;
        std::array<std::atomic<int>, slabs> done{};
        wave.start(first_nodes(), std::vector<std::size_t>(slabs, 1), 4);
        for (int stage = 0; stage < 3; ++stage)
            wave.over_slabs(pass([&](std::size_t k, std::size_t) { ++done[k]; }), stage % 2);
        wave.run(team);
        bool all = true;
        for (const auto& n : done) all = all && n == 3;
        same += all ? 1 : 0;
    }
    CHECK(same >= 1);
#endif
}

TEST_CASE("wavefront: what a pass throws comes out, and nobody waits for what will not be done") {
    for (const std::size_t at : {std::size_t(0), slabs / 2, slabs - 1}) {
        CHECK_THROWS_AS(run(serial{}, 1, at), std::runtime_error);
        CHECK_THROWS_AS(run(one_after_another{}, 3, at), std::runtime_error);
#if defined(_OPENMP)
        CHECK_THROWS_AS(run(threads{3}, 3, at), std::runtime_error);
#endif
    }
}

TEST_CASE("wavefront: passes are forgotten when they are cleared") {
    wavefront wave;
    wave.start(first_nodes(), std::vector<std::size_t>(slabs, 1), 1);
    wave.over_nodes(pass([](std::size_t, std::size_t) { FAIL("run"); }));
    wave.at_end(pass([](std::size_t, std::size_t) { FAIL("run"); }));
    wave.clear();
    CHECK(wave.empty());
    wave.run(serial{});
}

TEST_CASE("wavefront: every node is in one range") {
    std::vector<node_range> seen;
    wavefront wave;
    wave.start(first_nodes(), std::vector<std::size_t>(slabs, 1), 1);
    wave.over_nodes(pass([&](std::size_t first, std::size_t last) { seen.push_back({first, last}); }));
    wave.run(serial{});
    REQUIRE(seen.size() == slabs);
    CHECK(seen.front().first == 0);
    CHECK(seen.back().last == node_range::end);
    for (std::size_t k = 1; k < seen.size(); ++k) CHECK(seen[k].first == seen[k - 1].last);
}
