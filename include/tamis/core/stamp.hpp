#pragma once
#include <atomic>
#include <cstdint>

namespace tamis::detail {

/// Tells one state of an object from every other state of every other object: renewed at each change, in each copy, and
/// where the object is moved from.
class stamp {
  public:
    stamp() = default;
    stamp(const stamp&) {}
    stamp& operator=(const stamp&) {
        renew();
        return *this;
    }
    stamp(stamp&& from) noexcept { from.renew(); }
    stamp& operator=(stamp&& from) noexcept {
        renew();
        from.renew();
        return *this;
    }
    void renew() { number_ = next(); }
    std::uint64_t number() const { return number_; }

  private:
    std::uint64_t number_ = next();
    static std::uint64_t next() {
        static std::atomic<std::uint64_t> last{0};
        return ++last;
    }
};

}  // namespace tamis::detail
