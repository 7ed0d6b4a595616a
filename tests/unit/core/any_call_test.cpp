#include <tamis/core/any_call.hpp>

#include <memory>
#include <utility>
#include <vector>

#include "catch.hpp"

using tamis::detail::any_call;
using tamis::detail::call_ref;

TEST_CASE("any_call: keeps what it is made of, and lets it go once") {
    const auto held = std::make_shared<int>(3);
    int sum = 0;
    {
        std::vector<any_call<int, int>> all;
        for (int k = 0; k < 20; ++k) all.emplace_back([&sum, held, k](int a, int b) { sum += *held * a + b + k; });
        CHECK(held.use_count() == 21);
        const any_call<int, int> moved(std::move(all.front()));
        CHECK(held.use_count() == 21);
        moved(2, 1);
        CHECK(sum == 7);
        all.back().ref()(1, 1);
        CHECK(sum == 7 + 3 + 1 + 19);
    }
    CHECK(held.use_count() == 1);
}

TEST_CASE("call_ref: calls what it refers to") {
    int calls = 0;
    const auto count = [&](int by) { calls += by; };
    const auto ref = call_ref<int>::to(count);
    ref(2);
    ref(3);
    CHECK(calls == 5);
}
