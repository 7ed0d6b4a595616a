#pragma once
#include <tamis/run/integrate.hpp>

#include <chrono>
#include <cstdio>
#if defined(__unix__) || defined(__APPLE__)
#include <unistd.h>
#endif

namespace tamis {

/// An observer that draws a progress bar on the terminal (stderr), for runs that last over a second; silent elsewhere.
class progress_bar {
  public:
    void operator()(const progress_state& state) {
        if (!shown_on_terminal()) return;
        if (state.step == 0) *this = {};
        // The clock is read about a thousand times a run, not every step.
        if (state.step < next_ && state.step != state.steps) return;
        next_ = state.step + 1 + state.steps / 1000;
        const auto now = std::chrono::steady_clock::now();
        if (state.step == 0) begun_ = last_ = now;
        const double spent = std::chrono::duration<double>(now - begun_).count();
        if (state.step == state.steps) {
            if (drawn_) std::fputs("\r\033[K", stderr);
            return;
        }
        if (spent < 1 || std::chrono::duration<double>(now - last_).count() < 0.1) return;
        last_ = now;
        drawn_ = true;
        const double share = (state.time - state.span.begin) / (state.span.end - state.span.begin);
        char bar[41] = {};
        for (int k = 0; k < 40; ++k) bar[k] = k < static_cast<int>(40 * share) ? '#' : '.';
        std::fprintf(stderr, "\r[%s] %3.0f %%  step %ld of %ld, %.0f s left \033[K", bar, 100 * share, state.step,
                     state.steps, spent * (1 - share) / share);
        std::fflush(stderr);
    }

  private:
    std::chrono::steady_clock::time_point begun_{}, last_{};
    long next_ = 0;
    bool drawn_ = false;

    static bool shown_on_terminal() {
#if defined(__unix__) || defined(__APPLE__)
        static const bool yes = isatty(2) == 1;
        return yes;
#else
        return false;
#endif
    }
};

}  // namespace tamis
