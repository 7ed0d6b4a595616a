#pragma once
#include <tamis/core/any_call.hpp>
#include <tamis/engine/wavefront.hpp>

#include <cstddef>
#include <utility>

namespace tamis::detail {

/// Runs passes over slabs and nodes at once, or lets them wait in a wavefront, to be run together with others.
template <class Execution, int Dim> class pass_runner {
  public:
    /// May passes wait? In 1D the nodes, and mostly the particles, are in the caches.
    static constexpr bool may_wait = Dim > 1 && knows_its_count<Execution>;

    explicit pass_runner(const Execution& run) : run_(run) {}
    const Execution& execution() const { return run_; }

    /// Sums are made in the same order in every step from here on.
    void begin_step() { first_colour_ = 0; }
    /// Passes wait there from now on, or are run at once (nullptr). Where they waited before. For one body, and nodes
    /// that no axis wraps.
    wavefront* wait_in(wavefront* where) { return std::exchange(waiting_, where); }
    bool waits() const { return may_wait && waiting_ != nullptr; }
    void run_waiting() {
        if constexpr (may_wait)
            if (waits()) waiting_->run(run_);
    }

    /// f(), whose passes do not wait: between them it looks at nodes itself.
    template <class F> void at_once(F f) {
        run_waiting();
        const struct pause {
            pass_runner& of;
            wavefront* where;
            ~pause() { of.wait_in(where); }
        } ends{*this, wait_in(nullptr)};
        f();
    }

    /// f(slab), in any order.
    template <class F> void over_slabs(std::size_t slabs, F f) { take(slabs, std::move(f), stage_shape::any_colour); }
    /// f(slab) where slabs k and k + 2 share no node: those of one colour first, then the others, whatever the number
    /// of threads. Passes that follow one another begin with the one and the other colour, so that little lies between
    /// them where they are run together.
    template <class F> void by_colour(std::size_t slabs, F f) {
        const int first = first_colour_;
        first_colour_ = 1 - first_colour_;
        take(slabs, std::move(f), first);
    }
    /// f(first, last), which looks at the nodes at places from the first on, before the last: all at once, or range by
    /// range.
    template <class F> void over_nodes(F f) {
        if constexpr (may_wait)
            if (waits()) return waiting_->over_nodes(wavefront::pass_type(std::move(f)));
        f(std::size_t(0), node_range::end);
    }
    /// ... and around them.
    template <class F> void around_nodes(F f) {
        if constexpr (may_wait)
            if (waits()) return waiting_->around_nodes(wavefront::pass_type(std::move(f)));
        f(std::size_t(0), node_range::end);
    }
    /// f() once all passes that wait have been run.
    template <class F> void at_end(F f) {
        if constexpr (may_wait)
            if (waits()) return waiting_->at_end(wavefront::pass_type([f](std::size_t, std::size_t) { f(); }));
        f();
    }

  private:
    const Execution& run_;
    int first_colour_ = 0;
    wavefront* waiting_ = nullptr;

    template <class F> void take(std::size_t slabs, F f, int first_colour) {
        const auto pass = [f](std::size_t k, std::size_t) { f(k); };
        if constexpr (may_wait) {
            if (waits()) return waiting_->over_slabs(wavefront::pass_type(pass), first_colour);
            run_slabs(slabs, call_ref<std::size_t, std::size_t>::to(pass), first_colour);
        } else
            run_slabs(slabs, pass, first_colour);
    }
    template <class F> void run_slabs(std::size_t slabs, const F& f, int first_colour) const {
        if (first_colour == stage_shape::any_colour) return run_.for_each(slabs, [&](std::size_t k) { f(k, 0); });
        for (const auto colour : {static_cast<std::size_t>(first_colour), static_cast<std::size_t>(1 - first_colour)})
            if (colour < slabs) run_.for_each((slabs - colour + 1) / 2, [&](std::size_t k) { f(2 * k + colour, 0); });
    }
};

}  // namespace tamis::detail
