#include <tamis/core/by_lane.hpp>

#include <vector>

#include "catch.hpp"

using namespace tamis;

namespace {

template <class T> void lanes_there_and_back() {
    using S = space<2, T>;
    constexpr int W = S::width;
    typename S::vector v;
    double numbers[2][W];
    for (int l = 0; l < W; ++l) {
        numbers[0][l] = 1 + l;
        numbers[1][l] = 10 - l;
    }
    for (int d = 0; d < 2; ++d) v[d] = lane<T>::load(numbers[d]);
    detail::by_lane<T, 2> all(v);
    std::vector<int> seen;
    detail::each_lane<T>([](int l) { return l != 1; },
                         [&](int l) {
                             seen.push_back(l);
                             CHECK(all.at(l)[0] == 1 + l);
                             CHECK(all(1, l) == 10 - l);
                             all.put(l, point<2, double>(-all.at(l)));
                         });
    CHECK(seen.size() == static_cast<std::size_t>(W == 1 ? 1 : W - 1));
    all.to(v);
    for (int d = 0; d < 2; ++d) {
        double back[W];
        lane<T>::store(back, v[d]);
        for (int l = 0; l < W; ++l) CHECK(back[l] == (l == 1 ? 1 : -1) * numbers[d][l]);
    }
    detail::by_lane<T, 3> zero;
    CHECK_FALSE(lane<T>::any(zero.lanes(2) != T(0.)));
}

}  // namespace

TEST_CASE("by_lane: numbers of lanes are looked at and changed one lane after the other") {
    lanes_there_and_back<double>();
    lanes_there_and_back<native_lanes::type<double>>();
}
