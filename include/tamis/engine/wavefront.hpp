#pragma once
#include <tamis/core/any_call.hpp>
#include <tamis/core/config.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/engine/node_range.hpp>
#include <tamis/engine/wave_plan.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>
#if defined(__unix__) || defined(__APPLE__)
#include <sched.h>
#else
#include <thread>
#endif

namespace tamis::detail {

/// Lets others have the processor. (<thread> takes long to compile.)
inline void let_others_go() {
#if defined(__unix__) || defined(__APPLE__)
    sched_yield();
#else
    std::this_thread::yield();
#endif
}

/// How many fronts an execution policy can advance at the same time; none if it does not tell how many threads it has.
template <class Execution> inline constexpr bool knows_its_count = requires(const Execution& run) { run.count(); };

/// Passes that are to be run together, slab by slab of a body, so that what one of them brings into the caches is still
/// there for the next ones: a step of many passes over more particles than caches hold else waits for memory in each.
/// `wave_plan` says in which order. The sums of a node are made in the order of passes that run one after the other:
/// results are the same, bit for bit.
class wavefront {
  public:
    /// Passes begin to be collected. `first_nodes`: the storage places of the first node that each slab, with all after
    /// it, may give to; `weights`: shares of the work; `threads`: how many there are.
    TAMIS_SELDOM void start(std::vector<std::size_t> first_nodes, const std::vector<std::size_t>& weights,
                            int threads) {
        first_nodes_ = std::move(first_nodes);
        share_out(weights, static_cast<std::size_t>(std::max(threads, 1)));
    }
    using pass_type = any_call<std::size_t, std::size_t>;
    /// f(slab, 0), for all slabs; where they give to the same nodes, those of a colour first.
    TAMIS_SELDOM void over_slabs(pass_type f, int first_colour = stage_shape::any_colour) {
        shapes_.push_back({true, first_colour, false});
        passes_.push_back({std::move(f), shapes_.size() - 1, false});
    }
    /// f(first, last) for all nodes, by their places from the first on, before the last; it looks at those only.
    TAMIS_SELDOM void over_nodes(pass_type f) {
        // What others still look around for must not change.
        if (shapes_.empty() || shapes_.back().looks_around) shapes_.emplace_back();
        passes_.push_back({std::move(f), shapes_.size() - 1, true});
    }
    /// ... or at what lies around them too, no further than two slabs. It changes none of the fields that it looks at.
    TAMIS_SELDOM void around_nodes(pass_type f) {
        shapes_.push_back({false, stage_shape::any_colour, true});
        passes_.push_back({std::move(f), shapes_.size() - 1, true});
    }
    /// f(0, 0) once all has been run.
    TAMIS_SELDOM void at_end(pass_type f) { passes_.push_back({std::move(f), end_of_all, true}); }

    bool empty() const { return passes_.empty(); }
    TAMIS_SELDOM void clear() {
        passes_.clear();
        shapes_.clear();
    }
    /// Runs and forgets all passes: to and fro, so that what was there at the end is found at the next beginning.
    template <class Execution> void run(const Execution& run) {
        if (!shapes_.empty()) {
            const wave_plan& plan = next_plan();
            if constexpr (std::same_as<Execution, serial>)
                run_one_front(plan);
            else if (plan.fronts() == 1)
                run_one_front(plan);
            else
                run_fronts(run, plan);
        }
        run_passes(end_of_all, true, 0, 0);
        clear();
    }

  private:
    static constexpr std::size_t end_of_all = static_cast<std::size_t>(-1);
    struct pass {
        pass_type f;
        std::size_t stage;
        bool of_nodes;
    };
    std::vector<std::size_t> first_nodes_, ends_;
    std::vector<pass> passes_;
    std::vector<stage_shape> shapes_;
    std::vector<wave_plan> plans_;  // steps of a run have few different ones
    bool turned_ = true;            // the last one

    /// Where fronts end, each with a like share of the work and two slabs or more.
    TAMIS_SELDOM void share_out(const std::vector<std::size_t>& weights, std::size_t threads) {
        const std::size_t slabs = weights.size(), fronts = std::clamp<std::size_t>(slabs / 2, 1, threads);
        std::size_t total = 0, sum = 0, k = 0;
        for (const std::size_t w : weights) total += w;
        ends_.clear();
        for (std::size_t f = 1; f < fronts; ++f) {
            const std::size_t least = 2 * f, most = slabs - 2 * (fronts - f);
            while (k < least || (k < most && 2 * (sum + weights[k] / 2) * fronts < 2 * total * f)) sum += weights[k++];
            ends_.push_back(k);
        }
        ends_.push_back(slabs);
    }
    TAMIS_SELDOM const wave_plan& next_plan() {
        turned_ = !turned_;
        for (const wave_plan& plan : plans_)
            if (plan.is_for(shapes_, ends_, turned_)) return plan;
        if (plans_.size() == 16) plans_.clear();
        plans_.emplace_back(shapes_, ends_, turned_);
        return plans_.back();
    }
    void run_passes(std::size_t stage, bool of_nodes, std::size_t a, std::size_t b) const {
        for (const pass& p : passes_)
            if (p.stage == stage && p.of_nodes == of_nodes) p.f(a, b);
    }
    TAMIS_NOINLINE void do_task(const wave_plan::task& t) const {
        if (!t.of_nodes) return run_passes(t.stage, false, t.slab, 0);
        const std::size_t next = t.slab + 1;
        run_passes(t.stage, true, t.slab == 0 ? 0 : first_nodes_[t.slab],
                   next < first_nodes_.size() ? first_nodes_[next] : node_range::end);
    }
    void run_one_front(const wave_plan& plan) const {
        for (const auto& t : plan.tasks_of(0)) do_task(t);
    }
    /// A worker advances the front of its number, task by task, then helps with the others. What it waits for it does
    /// itself if nobody else comes to it: so all is done, however many workers there are at the same time.
    template <class Execution> void run_fronts(const Execution& run, const wave_plan& plan) {
        progress now(plan);
        run.for_each(plan.fronts(), [&](std::size_t worker) {
            try {
                for (std::size_t k = 0; k < plan.fronts(); ++k)
                    while (do_next(now, (worker + k) % plan.fronts(), plan.numbers())) {
                    }
            } catch (...) {
                now.failed = true;
                throw;
            }
        });
    }
    struct progress {
        const wave_plan& plan;
        std::vector<std::atomic<std::uint32_t>> next;  // of each front
        std::vector<std::atomic<char>> done;           // by tasks' numbers
        std::atomic<bool> failed{false};
        TAMIS_SELDOM explicit progress(const wave_plan& of) : plan(of), next(of.fronts()), done(of.numbers()) {}
    };
    /// Takes the next task of a front and does it, once those are done that it waits for. False if there is none that
    /// comes before a position in the order of all.
    TAMIS_NOINLINE bool do_next(progress& now, std::size_t front, std::size_t before) const {
        const auto tasks = now.plan.tasks_of(front);
        std::uint32_t mine = now.next[front].load();
        do {
            if (mine >= tasks.size() || tasks[mine].position >= before || now.failed.load()) return false;
        } while (!now.next[front].compare_exchange_weak(mine, mine + 1));
        const auto& t = tasks[mine];
        for (std::uint32_t k = t.first_wait; k < t.last_wait; ++k) {
            // Threads that are called at the same time do not begin at the same time.
            constexpr int patience = 1000;
            for (int idle = 0; !now.done[now.plan.waits()[k]].load(std::memory_order_acquire); ++idle) {
                if (now.failed.load()) return false;
                let_others_go();
                // All that it waits for comes before it: so does what is done meanwhile, and none of that waits for it.
                for (std::size_t other = 0; idle >= patience && other < now.plan.fronts(); ++other)
                    if (do_next(now, other, t.position)) break;
            }
        }
        do_task(t);
        now.done[now.plan.number(t)].store(1, std::memory_order_release);
        return true;
    }
};

}  // namespace tamis::detail
