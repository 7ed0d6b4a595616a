#pragma once
#include <atomic>

namespace tamis::detail {

/// Work that is left for the first who needs its result. Of several threads that come at the same time one does it, and
/// the others wait; once it is done, to come costs a look at a number.
class left_work {
  public:
    left_work() = default;
    left_work(const left_work& from) : state_(from.state_.load(std::memory_order_relaxed)) {}
    left_work(left_work&& from) noexcept : state_(from.state_.exchange(none, std::memory_order_relaxed)) {}
    left_work& operator=(const left_work& from) {
        state_.store(from.state_.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }
    left_work& operator=(left_work&& from) noexcept {
        state_.store(from.state_.exchange(none, std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }

    /// There is work, or none any more: said by who may change what the work is about, while nobody else looks at it.
    void leave() { state_.store(left, std::memory_order_relaxed); }
    void was_done() { state_.store(none, std::memory_order_relaxed); }
    /// Returns when work() was done, here or elsewhere. What it throws goes to one of those who came; the work is left.
    template <class Work> void settle(const Work& work) const {
        for (int now = state_.load(std::memory_order_acquire); now != none;
             now = state_.load(std::memory_order_acquire)) {
            if (now == at_work) {
                state_.wait(at_work, std::memory_order_acquire);
                continue;
            }
            if (!state_.compare_exchange_strong(now, at_work, std::memory_order_acquire)) continue;
            try {
                work();
            } catch (...) {
                become(left);
                throw;
            }
            become(none);
        }
    }

  private:
    static constexpr int none = 0, left = 1, at_work = 2;
    mutable std::atomic<int> state_{none};

    void become(int state) const {
        state_.store(state, std::memory_order_release);
        state_.notify_all();
    }
};

}  // namespace tamis::detail
