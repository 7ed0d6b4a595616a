#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tamis::detail {

/// What is to be known of a stage of a wavefront, to plan it: a pass over slabs of particles, then one over nodes.
struct stage_shape {
    static constexpr int any_colour = -1;

    bool has_slabs = false;
    /// Where slabs give to the same nodes, those of one colour go first: 0 (even ones) or 1.
    int first_colour = any_colour;
    /// Does the pass over nodes look at those around them too?
    bool looks_around = false;

    bool operator==(const stage_shape&) const = default;
};

/// In which order the passes of a wavefront are run, slab by slab, and what waits for what.
///
/// Slab k reaches nodes of its own, which begin where it begins, and of slab k + 1; no others. What is done to slab k
/// in a stage is a task, and so is what is done to its own nodes. Fronts share the slabs, each its own run of them, and
/// may advance at the same time; a front takes the task of the latest stage that can be done, so that it soon comes
/// back to what it has at hand. Neighbouring fronts go towards each other, or begin side by side: so none waits for
/// another one's end.
class wave_plan {
  public:
    struct task {
        std::uint32_t stage, slab;
        bool of_nodes;
        std::uint32_t first_wait, last_wait;  // in waits()
    };

    wave_plan() = default;
    /// `ends`: behind the last slab of each front.
    wave_plan(std::vector<stage_shape> stages, std::vector<std::size_t> ends)
        : stages_(std::move(stages)), ends_(std::move(ends)), fronts_(ends_.size()), slabs_(ends_.back()) {
        make();
    }

    bool is_for(const std::vector<stage_shape>& stages, const std::vector<std::size_t>& ends) const {
        return stages == stages_ && ends == ends_;
    }
    std::size_t fronts() const { return fronts_.size(); }
    /// The tasks of a front, in its order.
    const std::vector<task>& tasks_of(std::size_t front) const { return fronts_[front]; }
    /// Numbers of tasks of other fronts that must be done before.
    const std::vector<std::uint32_t>& waits() const { return waits_; }
    std::uint32_t number(const task& t) const { return number(t.stage, t.slab, t.of_nodes); }
    std::size_t numbers() const { return 2 * stages_.size() * slabs_; }

  private:
    std::vector<stage_shape> stages_;
    std::vector<std::size_t> ends_;
    std::vector<std::vector<task>> fronts_;
    std::vector<std::uint32_t> waits_;
    std::size_t slabs_ = 0;

    std::uint32_t number(std::size_t stage, std::size_t slab, bool of_nodes) const {
        return static_cast<std::uint32_t>((2 * stage + (of_nodes ? 1 : 0)) * slabs_ + slab);
    }
    /// f(number) for all tasks that must be done before one.
    template <class F> void each_before(std::size_t stage, std::size_t slab, bool of_nodes, const F& f) const {
        const auto also = [&](std::size_t s, std::size_t low, std::size_t high, bool nodes) {
            for (std::size_t k = low; k <= high && k < slabs_; ++k)
                if (k != slab || s != stage || nodes != of_nodes) f(number(s, k, nodes));
        };
        const auto back = [&](std::size_t by) { return slab < by ? 0 : slab - by; };
        const stage_shape& now = stages_[stage];
        if (of_nodes && now.has_slabs) return also(stage, back(1), slab, false);
        if (!of_nodes && is_of_second_colour(now, slab)) also(stage, back(1), slab + 1, false);
        if (stage == 0) return;
        // Around nodes, at the ends of rows, is also what lies beside in storage: nodes one row further than a
        // particle reaches. Nobody changes what others still look at.
        const bool around = now.looks_around || stages_[stage - 1].looks_around;
        if (of_nodes)
            also(stage - 1, back(around ? 2 : 1), slab + (around ? 2 : 1), true);
        else
            also(stage - 1, back(around ? 2 : 0), slab + (around ? 3 : 1), true);
    }
    static bool is_of_second_colour(const stage_shape& stage, std::size_t slab) {
        return stage.first_colour != stage_shape::any_colour && (static_cast<int>(slab) + stage.first_colour) % 2 != 0;
    }

    /// The tasks of one stage of a front, in their order.
    struct progress {
        std::vector<std::size_t> slabs, nodes;
        std::size_t next_slab = 0, next_node = 0;
    };
    progress stage_of_front(const stage_shape& stage, std::size_t begin, std::size_t end, bool downwards) const {
        progress p;
        for (std::size_t k = begin; k < end; ++k) p.nodes.push_back(k);
        if (downwards) std::reverse(p.nodes.begin(), p.nodes.end());
        if (!stage.has_slabs) return p;
        p.slabs = p.nodes;
        for (std::size_t k = 0; k + 1 < p.slabs.size(); ++k)
            if (is_of_second_colour(stage, p.slabs[k])) {
                std::swap(p.slabs[k], p.slabs[k + 1]);
                ++k;
            }
        return p;
    }
    void make() {
        std::vector<std::vector<progress>> all(fronts());
        std::vector<std::size_t> front_of(slabs_);
        std::size_t begin = 0, left = 0;
        for (std::size_t f = 0; f < fronts(); ++f) {
            for (const stage_shape& stage : stages_) {
                all[f].push_back(stage_of_front(stage, begin, ends_[f], f % 2 == 1));
                left += all[f].back().slabs.size() + all[f].back().nodes.size();
            }
            for (; begin < ends_[f]; ++begin) front_of[begin] = f;
        }
        std::vector<char> done(numbers(), 0);
        const auto take = [&](std::size_t f, std::size_t stage, const std::vector<std::size_t>& order,
                              std::size_t& next, bool of_nodes) {
            if (next == order.size()) return false;
            const std::size_t slab = order[next];
            bool ready = true;
            each_before(stage, slab, of_nodes, [&](std::uint32_t k) { ready = ready && done[k]; });
            if (!ready) return false;
            const auto first_wait = static_cast<std::uint32_t>(waits_.size());
            each_before(stage, slab, of_nodes, [&](std::uint32_t k) {
                if (front_of[k % slabs_] != f) waits_.push_back(k);
            });
            fronts_[f].push_back({static_cast<std::uint32_t>(stage), static_cast<std::uint32_t>(slab), of_nodes,
                                  first_wait, static_cast<std::uint32_t>(waits_.size())});
            done[number(stage, slab, of_nodes)] = 1;
            ++next;
            --left;
            return true;
        };
        const auto advance = [&](std::size_t f) {
            for (std::size_t s = stages_.size(); s-- > 0;) {
                progress& p = all[f][s];
                if (take(f, s, p.nodes, p.next_node, true) || take(f, s, p.slabs, p.next_slab, false)) return;
            }
        };
        while (left > 0)
            for (std::size_t f = 0; f < fronts(); ++f) advance(f);
    }
};

}  // namespace tamis::detail
