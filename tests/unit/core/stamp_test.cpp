#include <tamis/core/stamp.hpp>

#include <set>
#include <utility>

#include "catch.hpp"

using tamis::detail::stamp;

TEST_CASE("stamp: changed, copied, moved to and moved from are different states") {
    std::set<std::uint64_t> seen;
    const auto is_new = [&](const stamp& s) { return seen.insert(s.number()).second; };
    stamp a;
    CHECK(is_new(a));
    a.renew();
    CHECK(is_new(a));
    stamp copy = a;
    CHECK(is_new(copy));
    CHECK_FALSE(is_new(a));
    stamp moved = std::move(a);
    CHECK(is_new(moved));
    CHECK(is_new(a));
    copy = a;
    CHECK(is_new(copy));
    CHECK_FALSE(is_new(a));
    copy = std::move(a);
    CHECK(is_new(copy));
    CHECK(is_new(a));
}
