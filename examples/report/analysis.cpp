#include "analysis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace {

bool counts(const measurement& run, double worst) {
    return run.has_answer() && run.found.error > 0 && run.found.error < worst && run.found.seconds > 0;
}

}  // namespace

std::vector<std::size_t> pareto_front(const std::vector<measurement>& runs, double worst) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < runs.size(); ++k)
        if (counts(runs[k], worst)) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const outcome &one = runs[a].found, &other = runs[b].found;
        return one.seconds != other.seconds ? one.seconds < other.seconds : one.error < other.error;
    });
    std::vector<std::size_t> front;
    for (const std::size_t k : order)
        if (front.empty() || runs[k].found.error < runs[front.back()].found.error) front.push_back(k);
    return front;
}

std::optional<double> observed_order(const std::vector<measurement>& family, double worst) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const measurement& run : family)
        if (counts(run, worst)) {
            const double at = std::log(run.what.cells), value = std::log(run.found.error);
            n += 1;
            x += at;
            y += value;
            xx += at * at;
            xy += at * value;
        }
    const double width = n * xx - x * x;
    if (n < 2 || !(width > 1e-12)) return {};
    return -(n * xy - x * y) / width;
}

std::optional<std::size_t> fastest_within(const std::vector<measurement>& runs, double target) {
    std::optional<std::size_t> best;
    for (std::size_t k = 0; k < runs.size(); ++k)
        if (counts(runs[k], INFINITY) && runs[k].found.error <= target &&
            (!best || runs[k].found.seconds < runs[*best].found.seconds))
            best = k;
    return best;
}

std::vector<std::vector<measurement>> families(const std::vector<measurement>& runs) {
    std::vector<std::vector<measurement>> all;
    std::map<std::string, std::size_t> place;
    for (const measurement& run : runs) {
        const auto [at, is_new] = place.emplace(run.what.family(), all.size());
        if (is_new) all.emplace_back();
        all[at->second].push_back(run);
    }
    return all;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}
