#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/team.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string_view>
#if defined(_OPENMP)
#include <omp.h>
#endif

namespace tamis {

/// Runs f(0), ..., f(n - 1); no two of them touch the same data, so the order is free and results do not depend on it.
/// With `run.count()`, its number of threads, steps of large bodies run their passes together (docs/storage.md, Waves).
template <class E>
concept ExecutionPolicy = requires(const E& run, void (*f)(std::size_t)) {
    run.for_each(std::size_t{}, f);
};

/// One after the other, in this thread.
struct serial {
    static constexpr std::string_view name = "serial";
    static constexpr int count() { return 1; }
    template <class F> void for_each(std::size_t n, F&& f) const {
        for (std::size_t k = 0; k < n; ++k) f(k);
    }
};

/// By threads, which each solver has of its own. Results are the same, bit for bit, for any number of them and for
/// `serial`. A thread begins with its own part of the calls, the same one every time, so that it finds its data in the
/// memory near to it; then it takes what others have not begun. Nobody waits for a thread that gets no processor.
class threads {
  public:
    static constexpr std::string_view name = "threads";
    /// 0: as many as OpenMP would take. Throws `error` if the number is negative, or if the program was compiled
    /// without OpenMP (-fopenmp).
    explicit threads(int count = 0) : count_(checked(count)), team_(static_cast<std::uint32_t>(count_ - 1)) {}
    int count() const { return count_; }

    template <class F> void for_each(std::size_t n, F&& f) const {
        if (n <= 1 || count_ == 1) {
            for (std::size_t k = 0; k < n; ++k) f(k);
            return;
        }
        struct alignas(64) counter {  // a cache line each
            std::atomic<std::size_t> next;
        };
        constexpr std::size_t most_parts = 64;
        counter part[most_parts];
        const auto workers = static_cast<std::size_t>(count_);
        const std::size_t parts = std::min({n, workers, most_parts});
        for (std::size_t p = 0; p < parts; ++p) part[p].next.store(n * p / parts, std::memory_order_relaxed);
        // The first exception is kept, and thrown when all are done.
        std::atomic<bool> failed{false};
        std::exception_ptr failure;
        const auto work = [&](std::uint32_t worker) {
            const std::size_t own = worker * parts / workers;
            for (std::size_t p = own; p < own + parts; ++p) {
                const std::size_t of = p % parts, end = n * (of + 1) / parts;
                // Where all are begun counters are only read: writes would wait for each other.
                while (part[of].next.load(std::memory_order_relaxed) < end) {
                    const std::size_t k = part[of].next.fetch_add(1, std::memory_order_relaxed);
                    if (k >= end) break;
                    try {
                        f(k);
                    } catch (...) {
                        if (!failed.exchange(true)) failure = std::current_exception();
                    }
                }
            }
        };
        team_.run(detail::team::job::to(work));
        if (failure) std::rethrow_exception(failure);
    }

  private:
    int count_;
    detail::team team_;

    static int checked(int count) {
        if (count < 0 || count > 1024)
            throw error(detail::sentence("threads: the number is ", count, "; give 0 (all), or 1 to 1024"));
#if defined(_OPENMP)
        return count == 0 ? omp_get_max_threads() : count;
#else
        throw error("threads: this program was compiled without OpenMP; add -fopenmp, or use serial");
#endif
    }
};

namespace detail {

/// f(begin, end) for the chunks of 0 ... n - 1, as `run` runs them; chunks do not depend on how many threads there are.
template <class Execution, class F> void in_chunks(const Execution& run, std::size_t n, std::size_t chunk, const F& f) {
    run.for_each((n + chunk - 1) / chunk, [&](std::size_t k) { f(k * chunk, std::min(n, (k + 1) * chunk)); });
}

}  // namespace detail
}  // namespace tamis
