#include <tamis/core/memory.hpp>

#include <cstdint>
#include <vector>

#include "catch.hpp"

using tamis::detail::aligned_allocator;
using tamis::detail::zeros;

TEST_CASE("zeros: few and many are zero at first, aligned, and copied whole") {
    for (const std::size_t count : {std::size_t(0), std::size_t(3), std::size_t(5000), std::size_t(3) << 20}) {
        CAPTURE(count);
        zeros<double> some(count);
        CHECK(some.size() == count);
        CHECK(reinterpret_cast<std::uintptr_t>(some.data()) % 64 == 0);
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) sum += some[k];
        CHECK(sum == 0);
        if (count == 0) continue;
        some[0] = 1;
        some[count / 2] = 2;
        some[count - 1] = 3;
        zeros<double> copy(some);
        CHECK(copy[count - 1] == 3);
        CHECK(copy[count / 2] == (count / 2 == count - 1 ? 3 : 2));
        copy[0] = 7;
        CHECK(some[0] == 1);
        some = std::move(copy);
        CHECK(some[0] == 7);
    }
}

TEST_CASE("aligned vectors start at cache lines") {
    std::vector<std::vector<char, aligned_allocator<char>>> all;
    for (std::size_t k = 1; k < 200; k += 7) {
        all.emplace_back(k, 'x');
        CHECK(reinterpret_cast<std::uintptr_t>(all.back().data()) % 64 == 0);
    }
}

TEST_CASE("aligned vectors that have become large are pages, and keep what they had") {
    std::vector<double, aligned_allocator<double>> some;
    for (std::size_t k = 0; k < (std::size_t(1) << 19); ++k) some.push_back(static_cast<double>(k));
    CHECK(reinterpret_cast<std::uintptr_t>(some.data()) % 64 == 0);
    bool kept = true;
    for (std::size_t k = 0; k < some.size(); ++k) kept = kept && some[k] == static_cast<double>(k);
    CHECK(kept);
    const auto copy = some;
    some.resize(7);
    some.shrink_to_fit();
    CHECK(some.back() == 6);
    CHECK(copy.back() == static_cast<double>(copy.size() - 1));
    CHECK_THROWS_AS(some.reserve(some.max_size()), std::bad_alloc);
}
