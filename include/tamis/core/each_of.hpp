#pragma once
#include <cstddef>
#include <tuple>
#include <utility>

namespace tamis::detail {

template <class Tuple, class F, std::size_t... K> constexpr void each_of(Tuple& all, F& f, std::index_sequence<K...>) {
    (f(std::get<K>(all)), ...);
}

/// f(element) for every element of a tuple, in order. std::apply takes clang longer to compile: it asks at every place
/// whether the call may throw.
template <class... T, class F> constexpr void each_of(std::tuple<T...>& all, F&& f) {
    each_of(all, f, std::index_sequence_for<T...>{});
}
template <class... T, class F> constexpr void each_of(const std::tuple<T...>& all, F&& f) {
    each_of(all, f, std::index_sequence_for<T...>{});
}

}  // namespace tamis::detail
