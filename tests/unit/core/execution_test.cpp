#include <tamis/core/execution.hpp>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;

TEST_CASE("serial: in order, in this thread") {
    STATIC_REQUIRE(ExecutionPolicy<serial>);
    std::vector<std::size_t> seen;
    serial{}.for_each(4, [&](std::size_t k) { seen.push_back(k); });
    CHECK(seen == std::vector<std::size_t>{0, 1, 2, 3});
    CHECK_THROWS_AS(serial{}.for_each(1, [](std::size_t) { throw std::length_error("stop"); }), std::length_error);
}

TEST_CASE("in_chunks: every number once, in chunks of the size asked for but the last") {
    for (const std::size_t n : {0u, 1u, 3u, 8u, 9u, 1000u}) {
        std::vector<std::size_t> seen;
        std::size_t chunks = 0;
        detail::in_chunks(serial{}, n, 4, [&](std::size_t begin, std::size_t end) {
            CHECK(begin == 4 * chunks++);
            CHECK((end - begin == 4 || (end == n && end > begin)));
            for (std::size_t k = begin; k < end; ++k) seen.push_back(k);
        });
        CHECK(chunks == (n + 3) / 4);
        REQUIRE(seen.size() == n);
        for (std::size_t k = 0; k < n; ++k) CHECK(seen[k] == k);
    }
}

#if defined(_OPENMP)
TEST_CASE("threads: every call once, whatever their number") {
    STATIC_REQUIRE(ExecutionPolicy<threads>);
    for (const int count : {1, 2, 5}) {
        const threads run{count};
        CHECK(run.count() == count);
        for (const std::size_t n : {0u, 1u, 3u, 1000u}) {
            std::vector<std::atomic<int>> calls(n);
            run.for_each(n, [&](std::size_t k) { ++calls[k]; });
            for (const auto& c : calls) CHECK(c == 1);
        }
    }
    CHECK(threads{}.count() >= 1);
}

TEST_CASE("threads: each begins with its own part of the calls, the same one every time") {
    for (int time = 0; time < 5; ++time) {
        std::atomic<int> here{0}, there_are{0};
        std::vector<int> by(10, -1);
        threads{2}.for_each(10, [&](std::size_t k) {
            by[k] = omp_get_thread_num();
            there_are = omp_get_num_threads();
            // Nobody is late: who has begun waits for the other.
            if (k % 5 == 0 && there_are == 2)
                for (++here; here < 2;) std::this_thread::yield();
        });
        CHECK(by[0] == 0);
        CHECK(by[5] == there_are - 1);
        for (const int thread : by) CHECK(thread >= 0);
    }
}

TEST_CASE("threads: an exception comes out as it was thrown, and the other calls are made") {
    std::atomic<int> done{0};
    const auto run = [&] {
        threads{2}.for_each(100, [&](std::size_t k) {
            if (k == 17) throw std::length_error("call 17");
            ++done;
        });
    };
    CHECK_THROWS_AS(run(), std::length_error);
    CHECK(done == 99);
}

TEST_CASE("threads: a number that makes no sense is refused") {
    CHECK(names(complaint([] { threads{-2}; }), "threads", "-2", "give 0"));
    CHECK(names(complaint([] { threads{100000}; }), "threads", "100000", "1024"));
}
#else
TEST_CASE("threads: without OpenMP the message says how to get it") {
    CHECK(names(complaint([] { threads{2}; }), "-fopenmp", "serial"));
}
#endif
