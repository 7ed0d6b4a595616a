#pragma once
#include <tamis/core/config.hpp>

#include <algorithm>
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
/// another one's end. Turned, they go the other way: about where one plan ends the turned one begins.
class wave_plan {
  public:
    struct task {
        std::uint32_t front, stage, slab;
        bool of_nodes;
        std::uint32_t first_wait, last_wait;  // in waits()
        std::uint32_t position;               // in an order of all tasks that respects all waits
    };

    /// `ends`: behind the last slab of each front.
    TAMIS_SELDOM wave_plan(const std::vector<stage_shape>& stages, const std::vector<std::size_t>& ends, bool turned)
        : stages_(stages), ends_(ends), slabs_(ends.back()), turned_(turned) {
        make();
    }

    bool is_for(const std::vector<stage_shape>& stages, const std::vector<std::size_t>& ends, bool turned) const {
        return stages == stages_ && ends == ends_ && turned == turned_;
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
    bool turned_;

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
    /// The n-th slab of a front. Odd ones go downwards, or turned the even ones.
    std::size_t nth(std::size_t front, std::size_t n) const {
        const bool down = (front % 2 == 1) != turned_;
        const std::size_t size = size_of(front), starts_at = down ? front + 1 : front;
        // A front that meets its neighbour has to wait for it there, now and then. Where it began at an end of all, it
        // left some to be done meanwhile.
        const std::size_t left = starts_at % fronts() == 0 && fronts() > 1 ? std::min<std::size_t>(2, size / 2) : 0;
        const std::size_t place = n + left < size ? n + left : size - 1 - n;
        return down ? ends_[front] - 1 - place : begin_of(front) + place;
    }
    /// Fronts are advanced as they would in time, so that where one had to wait it finds something else to do.
    TAMIS_SELDOM void make() {
        constexpr std::uint32_t slab_takes = 16, nodes_take = 1, never = ~0u;
        // One that waits for another front, one that waits for what was left, one for the other colour: there is a task
        // that can be done among the next six of the earliest stage.
        constexpr std::size_t tried = 6;
        const std::size_t count = stages_.size();
        std::vector<std::vector<std::uint32_t>> open(2 * count * fronts());  // of each front, stage: slabs, nodes
        std::size_t left = 0;
        for (std::size_t k = 0; k < open.size(); ++k)
            for (std::size_t f = k / (2 * count), n = 0; n < size_of(f); ++n)
                if (k % 2 == 1 || stages_[k / 2 % count].has_slabs) {
                    open[k].push_back(static_cast<std::uint32_t>(nth(f, n)));
                    ++left;
                }
        std::vector<std::uint32_t> clock(fronts(), 0), done(numbers(), never);
        std::vector<task> all;
        all.reserve(left);
        const auto take = [&](std::size_t f, std::size_t s, bool of_nodes) {
            auto& mine = open[2 * (f * count + s) + (of_nodes ? 1 : 0)];
            for (std::size_t n = 0; n < std::min(tried, mine.size()); ++n) {
                const std::uint32_t slab = mine[n];
                const tasks_before needed = before(s, slab, of_nodes);
                const auto* const end = needed.numbers + needed.count;
                if (!std::all_of(needed.numbers, end, [&](std::uint32_t k) { return done[k] <= clock[f]; })) continue;
                const auto first_wait = static_cast<std::uint32_t>(waits_.size());
                waits_.insert(waits_.end(), needed.numbers, end);
                all.push_back({static_cast<std::uint32_t>(f), static_cast<std::uint32_t>(s), slab, of_nodes, first_wait,
                               static_cast<std::uint32_t>(waits_.size()), static_cast<std::uint32_t>(all.size())});
                clock[f] += of_nodes ? nodes_take : slab_takes;
                done[number(s, slab, of_nodes)] = clock[f];
                mine.erase(mine.begin() + static_cast<std::ptrdiff_t>(n));
                return true;
            }
            return false;
        };
        std::size_t begun = 0;  // stages; one more may begin
        while (all.size() < left) {
            const auto f = static_cast<std::size_t>(std::min_element(clock.begin(), clock.end()) - clock.begin());
            bool found = false;
            for (std::size_t s = std::min(begun + 1, count); s-- > 0 && !found;) {
                found = take(f, s, true) || take(f, s, false);
                if (found) begun = std::max(begun, s + 1);
            }
            if (found) continue;
            // Nothing is new before somebody else is done.
            std::uint32_t then = never;
            for (const std::uint32_t other : clock)
                if (other > clock[f]) then = std::min(then, other);
            clock[f] = then == never ? clock[f] + 1 : then;
        }
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
