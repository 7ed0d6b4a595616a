#include <tamis/core/execution.hpp>

#include <atomic>
#include <chrono>
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
    const threads run{2};
    for (int time = 0; time < 5; ++time) {
        std::atomic<int> here{0};
        std::vector<std::thread::id> by(10);
        const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(5);
        run.for_each(10, [&](std::size_t k) {
            by[k] = std::this_thread::get_id();
            // Nobody is late: who has begun waits for the other.
            if (k % 5 == 0)
                for (++here; here < 2 && std::chrono::steady_clock::now() < patience;) std::this_thread::yield();
        });
        CHECK(here == 2);
        CHECK(by[0] == std::this_thread::get_id());
        CHECK(by[5] != by[0]);
    }
}

TEST_CASE("threads: who is free does what the others have not begun") {
    const threads run{3};
    std::atomic<int> inside{0};
    // Two of the three are kept by calls that end after the others' calls are all done, by the one that is left.
    std::atomic<int> done{0};
    run.for_each(100, [&](std::size_t) {
        if (++inside <= 2)
            while (done < 98) std::this_thread::yield();
        else
            ++done;
    });
    CHECK(done == 98);
    // A call from inside of another has the caller only.
    std::atomic<int> inner{0};
    run.for_each(6, [&](std::size_t) { run.for_each(50, [&](std::size_t) { ++inner; }); });
    CHECK(inner == 300);
}

TEST_CASE("threads: many short jobs, by copies and after an assignment, from several callers at once") {
    threads run{4};
    const threads copy = run;
    run = threads{2};
    CHECK(run.count() == 2);
    std::atomic<long> sum{0};
    const auto call = [&](const threads& by) {
        for (int time = 0; time < 2000; ++time) by.for_each(7, [&](std::size_t k) { sum += static_cast<long>(k); });
    };
    std::thread one([&] { call(run); }), two([&] { call(run); }), three([&] { call(copy); });
    one.join();
    two.join();
    three.join();
    CHECK(sum == 3 * 2000 * 21);
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
