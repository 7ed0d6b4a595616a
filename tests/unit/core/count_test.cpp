#include <tamis/core/count.hpp>

#include <utility>

#include "catch.hpp"

using tamis::detail::count;

TEST_CASE("count: 0 is left where it was moved from") {
    count a;
    ++a;
    a += 5;
    --a;
    CHECK(a == 5);
    count copy = a, b = std::move(a);
    CHECK(a == 0);
    CHECK(b == 5);
    CHECK(copy == 5);
    a = std::move(b);
    CHECK(a == 5);
    CHECK(b == 0);
    std::swap(a, b);
    CHECK(a == 0);
    CHECK(b == 5);
}
