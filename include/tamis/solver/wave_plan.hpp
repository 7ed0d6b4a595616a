#pragma once
#include <tamis/core/config.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
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
        std::uint32_t front, stage, slab;
        bool of_nodes;
        std::uint32_t first_wait, last_wait;  // in waits()
        std::uint32_t position;               // in an order of all tasks that respects all waits
    };

    /// `ends`: behind the last slab of each front.
    TAMIS_SELDOM wave_plan(const std::vector<stage_shape>& stages, const std::vector<std::size_t>& ends)
        : stages_(stages), ends_(ends), slabs_(ends.back()) {
        make();
    }

    bool is_for(const std::vector<stage_shape>& stages, const std::vector<std::size_t>& ends) const {
        return stages == stages_ && ends == ends_;
    }
    std::size_t fronts() const { return ends_.size(); }
    /// The tasks of a front, in its order.
    std::span<const task> tasks_of(std::size_t front) const {
        return {tasks_.data() + first_task_[front], first_task_[front + 1] - first_task_[front]};
    }
    /// Numbers of tasks that must be done before, of the same front and others.
    const std::vector<std::uint32_t>& waits() const { return waits_; }
    std::uint32_t number(const task& t) const { return number(t.stage, t.slab, t.of_nodes); }
    std::size_t numbers() const { return 2 * stages_.size() * slabs_; }

  private:
    std::vector<stage_shape> stages_;
    std::vector<std::size_t> ends_, first_task_;
    std::vector<task> tasks_;
    std::vector<std::uint32_t> waits_;
    std::size_t slabs_ = 0;

    std::uint32_t number(std::size_t stage, std::size_t slab, bool of_nodes) const {
        return static_cast<std::uint32_t>((2 * stage + (of_nodes ? 1 : 0)) * slabs_ + slab);
    }
    /// The numbers of the tasks that must be done before one.
    struct tasks_before {
        std::uint32_t numbers[12];
        int count = 0;
    };
    TAMIS_SELDOM tasks_before before(std::size_t stage, std::size_t slab, bool of_nodes) const {
        tasks_before all;
        const auto also = [&](std::size_t s, std::size_t low, std::size_t high, bool nodes) {
            for (std::size_t k = low; k <= high && k < slabs_; ++k)
                if (k != slab || s != stage || nodes != of_nodes) all.numbers[all.count++] = number(s, k, nodes);
        };
        const auto back = [&](std::size_t by) { return slab < by ? 0 : slab - by; };
        const stage_shape& now = stages_[stage];
        if (of_nodes && now.has_slabs) {
            also(stage, back(1), slab, false);
            return all;
        }
        if (!of_nodes && is_of_second_colour(now, slab)) also(stage, back(1), slab + 1, false);
        if (stage == 0) return all;
        // Around nodes, at the ends of rows, is also what lies beside in storage: nodes one row further than a
        // particle reaches. Nobody changes what others still look at.
        const bool around = now.looks_around || stages_[stage - 1].looks_around;
        if (of_nodes)
            also(stage - 1, back(around ? 2 : 1), slab + (around ? 2 : 1), true);
        else
            also(stage - 1, back(around ? 2 : 0), slab + (around ? 3 : 1), true);
        return all;
    }
    static bool is_of_second_colour(const stage_shape& stage, std::size_t slab) {
        return stage.first_colour != stage_shape::any_colour && (static_cast<int>(slab) + stage.first_colour) % 2 != 0;
    }

    std::size_t begin_of(std::size_t front) const { return front == 0 ? 0 : ends_[front - 1]; }
    std::size_t size_of(std::size_t front) const { return ends_[front] - begin_of(front); }
    /// The n-th slab of a front: odd ones go downwards.
    std::size_t nth(std::size_t front, std::size_t n) const {
        return front % 2 == 1 ? ends_[front] - 1 - n : begin_of(front) + n;
    }
    /// ... of a pass over slabs: those of the second colour come one later than they lie.
    std::size_t nth_of_pass(const stage_shape& stage, std::size_t front, std::size_t n) const {
        if (stage.first_colour == stage_shape::any_colour) return nth(front, n);
        const std::size_t first = is_of_second_colour(stage, nth(front, 0)) ? 0 : 1;
        if (n < first) return nth(front, n);
        const std::size_t other = (n - first) % 2 == 0 ? n + 1 : n - 1;
        return nth(front, other < size_of(front) ? other : n);
    }
    TAMIS_SELDOM void make() {
        const std::size_t count = stages_.size();
        std::vector<std::uint32_t> next(2 * count * fronts(), 0);  // of each stage of each front: a slab's task, nodes'
        std::vector<std::uint32_t> done(numbers(), 0);
        std::size_t left = 0;
        for (const stage_shape& stage : stages_) left += (stage.has_slabs ? 2 : 1) * slabs_;
        std::vector<task> all;
        all.reserve(left);
        const auto take = [&](std::size_t f, std::size_t s, bool of_nodes) {
            std::uint32_t& n = next[2 * (f * count + s) + (of_nodes ? 1 : 0)];
            if (n == size_of(f) || (!of_nodes && !stages_[s].has_slabs)) return false;
            const std::size_t slab = of_nodes ? nth(f, n) : nth_of_pass(stages_[s], f, n);
            const tasks_before needed = before(s, slab, of_nodes);
            for (int k = 0; k < needed.count; ++k)
                if (!done[needed.numbers[k]]) return false;
            const auto first_wait = static_cast<std::uint32_t>(waits_.size());
            waits_.insert(waits_.end(), needed.numbers, needed.numbers + needed.count);
            all.push_back({static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(s),
                           static_cast<std::uint32_t>(slab), of_nodes, first_wait,
                           static_cast<std::uint32_t>(waits_.size()), static_cast<std::uint32_t>(all.size())});
            done[number(s, slab, of_nodes)] = 1;
            ++n;
            return true;
        };
        while (all.size() < left)
            for (std::size_t f = 0; f < fronts(); ++f)
                for (std::size_t s = count; s-- > 0;)
                    if (take(f, s, true) || take(f, s, false)) break;
        tasks_.reserve(left);
        for (std::size_t f = 0; f < fronts(); ++f) {
            first_task_.push_back(tasks_.size());
            for (const task& t : all)
                if (t.front == f) tasks_.push_back(t);
        }
        first_task_.push_back(tasks_.size());
    }
};

}  // namespace tamis::detail
