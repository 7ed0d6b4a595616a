#pragma once
#include <tamis/core/error.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
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

/// By OpenMP threads. Results are the same, bit for bit, for any number of them and for `serial`. A thread begins with
/// its own part of the calls, the same one every time, so that it finds its data in the memory near to it; then it
/// takes what others have not begun.
class threads {
  public:
    static constexpr std::string_view name = "threads";
    /// 0: as many as OpenMP would take. Throws `error` if the number is negative, or if the program was compiled
    /// without OpenMP (-fopenmp).
    explicit threads(int count = 0) : count_(count) {
        if (count < 0 || count > 1024)
            throw error(detail::sentence("threads: the number is ", count, "; give 0 (all), or 1 to 1024"));
#if defined(_OPENMP)
        if (count == 0) count_ = omp_get_max_threads();
#else
        throw error("threads: this program was compiled without OpenMP; add -fopenmp, or use serial");
#endif
    }
    int count() const { return count_; }

    template <class F> void for_each(std::size_t n, F&& f) const {
        if (n <= 1 || count_ == 1) {
            for (std::size_t k = 0; k < n; ++k) f(k);
            return;
        }
#if defined(_OPENMP)
        struct alignas(64) counter {  // a cache line each
            std::atomic<std::size_t> next;
        };
        constexpr std::size_t most_parts = 64;
        counter part[most_parts];
        const std::size_t parts = std::min({n, static_cast<std::size_t>(count_), most_parts});
        for (std::size_t p = 0; p < parts; ++p) part[p].next.store(n * p / parts, std::memory_order_relaxed);
        // An exception must not leave a parallel region: the first one is kept and thrown after it.
        std::exception_ptr failure;
#pragma omp parallel num_threads(count_)
        {
            const auto own = static_cast<std::size_t>(omp_get_thread_num()) * parts /
                             static_cast<std::size_t>(omp_get_num_threads());
            for (std::size_t p = own; p < own + parts; ++p) {
                const std::size_t of = p % parts, end = n * (of + 1) / parts;
                // Where all are begun counters are only read: writes would wait for each other.
                while (part[of].next.load(std::memory_order_relaxed) < end) {
                    const std::size_t k = part[of].next.fetch_add(1, std::memory_order_relaxed);
                    if (k >= end) break;
                    try {
                        f(k);
                    } catch (...) {
#pragma omp critical(tamis_failure)
                        if (!failure) failure = std::current_exception();
                    }
                }
            }
        }
        if (failure) std::rethrow_exception(failure);
#endif
    }

  private:
    int count_;
};

namespace detail {

/// f(begin, end) for the chunks of 0 ... n - 1, as `run` runs them; chunks do not depend on how many threads there are.
template <class Execution, class F> void in_chunks(const Execution& run, std::size_t n, std::size_t chunk, const F& f) {
    run.for_each((n + chunk - 1) / chunk, [&](std::size_t k) { f(k * chunk, std::min(n, (k + 1) * chunk)); });
}

}  // namespace detail
}  // namespace tamis
