#pragma once
#include <tamis/core/space.hpp>

namespace tamis::detail {

/// Numbers of W lanes in memory, for what knows plain numbers only: one lane after the other.
template <class T, int Count> class by_lane {
  public:
    static constexpr int W = lane<T>::width;
    using real = typename lane<T>::real;

    /// All zero.
    by_lane() : numbers_{} {}
    /// Those of a vector or tensor of lanes, by its components.
    template <class Values> explicit by_lane(const Values& all) {
        for (int c = 0; c < Count; ++c) lane<T>::store(numbers_[c], all.data()[c]);
    }
    explicit by_lane(const T& one) { lane<T>::store(numbers_[0], one); }

    real& operator()(int c, int l) { return numbers_[c][l]; }
    const real& operator()(int c, int l) const { return numbers_[c][l]; }
    /// The numbers of lane l.
    point<Count, real> at(int l) const {
        point<Count, real> one;
        for (int c = 0; c < Count; ++c) one[c] = numbers_[c][l];
        return one;
    }
    template <class Values> void put(int l, const Values& one) {
        for (int c = 0; c < Count; ++c) numbers_[c][l] = one.data()[c];
    }
    /// All lanes of component c.
    T lanes(int c) const { return lane<T>::load(numbers_[c]); }
    template <class Values> void to(Values& all) const {
        for (int c = 0; c < Count; ++c) all.data()[c] = lanes(c);
    }

  private:
    real numbers_[Count][W];
};

/// f(l) for each lane l that is wanted(l).
template <class T, class Wanted, class F> void each_lane(const Wanted& wanted, const F& f) {
    for (int l = 0; l < lane<T>::width; ++l)
        if (wanted(l)) f(l);
}

}  // namespace tamis::detail
