#pragma once
#include <cstddef>
#include <utility>

namespace tamis::detail {

/// A count that is 0 where it was moved from, as the size of a vector is.
class count {
  public:
    count() = default;
    count(const count&) = default;
    count(count&& from) noexcept : value_(std::exchange(from.value_, 0)) {}
    count& operator=(const count&) = default;
    count& operator=(count&& from) noexcept {
        value_ = std::exchange(from.value_, 0);
        return *this;
    }
    operator std::size_t() const { return value_; }
    count& operator++() {
        ++value_;
        return *this;
    }
    count& operator+=(std::size_t more) {
        value_ += more;
        return *this;
    }
    count& operator--() {
        --value_;
        return *this;
    }

  private:
    std::size_t value_ = 0;
};

}  // namespace tamis::detail
