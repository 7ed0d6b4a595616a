#include <tamis/core/left_work.hpp>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "catch.hpp"

using tamis::detail::left_work;

TEST_CASE("left_work: is done once for all who come, and only where some was left") {
    left_work work;
    int times = 0;
    const auto count = [&] { ++times; };
    work.settle(count);
    CHECK(times == 0);
    work.leave();
    const left_work copy = work;
    work.settle(count);
    work.settle(count);
    CHECK(times == 1);
    copy.settle(count);
    CHECK(times == 2);
    work.leave();
    work.was_done();
    work.settle(count);
    CHECK(times == 2);
    work.leave();
    const left_work moved = std::move(work);
    work.settle(count);
    CHECK(times == 2);
    moved.settle(count);
    CHECK(times == 3);
}

TEST_CASE("left_work: what fails is left") {
    left_work work;
    work.leave();
    CHECK_THROWS_AS(work.settle([] { throw std::runtime_error("no memory"); }), std::runtime_error);
    int times = 0;
    work.settle([&] { ++times; });
    CHECK(times == 1);
}

TEST_CASE("left_work: nobody goes on before it is done") {
    for (int round = 0; round < 300; ++round) {
        left_work work;
        work.leave();
        int result = 0, times = 0;
        std::atomic<int> here{0}, wrong{0};
        std::vector<std::thread> all;
        for (int k = 0; k < 3; ++k)
            all.emplace_back([&] {
                ++here;
                while (here < 3) {
                }
                work.settle([&] {
                    ++times;
                    std::this_thread::yield();
                    result = 7;
                });
                if (result != 7) ++wrong;
            });
        for (auto& one : all) one.join();
        REQUIRE(times == 1);
        REQUIRE(wrong == 0);
    }
}
