#pragma once
#include <tamis/core/any_call.hpp>
#include <tamis/core/left_work.hpp>

#include <atomic>
#include <cstdint>
#include <system_error>
#include <thread>
#include <vector>

namespace tamis::detail {

/// Threads that help their caller, who waits for nobody who has not come: beside other busy programs a helper that gets
/// no processor costs nothing. (OpenMP's meet at the end of every region, and how long they spin meanwhile is up to the
/// environment.) Between jobs helpers look for the next one for some microseconds, then they sleep.
class team {
  public:
    using job = call_ref<std::uint32_t>;

    /// Threads begin with the first job. A copy has threads of its own.
    explicit team(std::uint32_t helpers) : helpers_(helpers) { begin_.leave(); }
    team(const team& from) : team(from.helpers_) {}
    team& operator=(const team& from) {
        end();
        helpers_ = from.helpers_;
        return *this;
    }
    ~team() { end(); }

    /// work(0) here, and work(k) by helper k if it comes while that is being done. Work must share itself out, and
    /// throws nothing. A second caller at the same time has no helpers.
    void run(const job& work) const {
        begin_.settle([this] { begin(); });
        if (busy_.test_and_set(std::memory_order_acquire)) return work(0);
        job_ = &work;
        // One round further, open, nobody inside.
        const std::uint32_t now = (state_.load(std::memory_order_relaxed) | below_round) + 1;
        state_.store(now | open, std::memory_order_release);
        state_.notify_all();
        work(0);
        std::uint32_t left = state_.fetch_and(~open, std::memory_order_acq_rel) & ~open;
        for (int looks = 0; (left & inside) != 0; left = state_.load(std::memory_order_acquire))
            look_again(looks, left);
        busy_.clear(std::memory_order_release);
    }

  private:
    // Of the state: how many helpers are inside, may more come, is all over; above these bits the number of the round.
    static constexpr std::uint32_t inside = 0xfff, open = 0x1000, ended = 0x2000, below_round = 0x3fff;
    static constexpr int most_looks = 2000;
    std::uint32_t helpers_;
    left_work begin_;
    mutable std::vector<std::thread> at_work_;
    mutable std::atomic<std::uint32_t> state_{0};
    mutable std::atomic_flag busy_;
    mutable const job* job_ = nullptr;

    /// Returns soon, or when the state is another.
    void look_again(int& looks, std::uint32_t now) const {
        if (++looks > most_looks) return state_.wait(now, std::memory_order_acquire);
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#endif
    }
    void end() {
        if (!at_work_.empty()) {
            state_.fetch_or(ended, std::memory_order_release);
            state_.notify_all();
            for (std::thread& one : at_work_) one.join();
        }
        at_work_.clear();
        state_.store(0, std::memory_order_relaxed);
        begin_.leave();
    }
    void begin() const {
        at_work_.reserve(helpers_);
        // Where the system gives no more threads, those that there are must do.
        try {
            for (std::uint32_t k = 1; k <= helpers_; ++k) at_work_.emplace_back([this, k] { help(k); });
        } catch (const std::system_error&) {
        }
    }
    void help(std::uint32_t number) const {
        std::uint32_t seen = 0;  // the round that it was in
        while (true) {
            std::uint32_t now = state_.load(std::memory_order_acquire);
            for (int looks = 0; (now & ended) == 0 && ((now & open) == 0 || (now & ~below_round) == seen);
                 now = state_.load(std::memory_order_acquire))
                look_again(looks, now);
            if ((now & ended) != 0) return;
            if (!state_.compare_exchange_weak(now, now + 1, std::memory_order_acquire)) continue;
            seen = now & ~below_round;
            (*job_)(number);
            if (((state_.fetch_sub(1, std::memory_order_acq_rel) - 1) & (inside | open)) == 0) state_.notify_all();
        }
    }
};

}  // namespace tamis::detail
