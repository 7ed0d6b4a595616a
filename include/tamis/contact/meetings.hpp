#pragma once
#include <tamis/core/error.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace tamis::detail {

/// Which pairs of bodies share nodes, and were found to do so by normals that point the right way. A normal that is
/// given is judged once, when two bodies meet: turned round it would let them pass into each other without a word.
class meetings {
  public:
    using pair = std::array<std::size_t, 2>;

    /// The pairs that share nodes now; those that part are judged anew when they meet again.
    template <class Nodes> void are_of(const Nodes& nodes) {
        now_.clear();
        for (const auto& e : nodes)
            if (now_.empty() || now_.back() != e.field) now_.push_back(e.field);
        std::erase_if(judged_, [this](const pair& p) { return !contains(now_, p); });
    }
    /// Is there a pair that was not judged?
    bool any_new() const { return now_.size() > judged_.size(); }
    /// Judges the new pairs: `along(e)` is how far a node's second body is from the first along its normal and without
    /// regard to it, both times something of the node's mass. Throws `error` where a normal points the wrong way.
    template <class Nodes, class Along> void judge(const Nodes& nodes, const Along& along) {
        for (const pair& p : now_) {
            if (contains(judged_, p)) continue;
            double sum = 0, most = 0;
            for (const auto& e : nodes)
                if (e.field == p) {
                    const std::array<double, 2> more = along(e);
                    sum += more[0];
                    most += more[1];
                }
            if (sum < -clearly * most)
                throw error(sentence("contact: where body ", p[0], " and body ", p[1],
                                     " of bodies(...), counted from 0, meet, the given normal points from body ", p[1],
                                     " to body ", p[0],
                                     "; it must point from the one named first to the later one: name body ", p[1],
                                     " before body ", p[0], ", or give the opposite normal"));
            judged_.push_back(p);
        }
    }
    void forget() { judged_.clear(); }

  private:
    static constexpr double clearly = 0.1;  // beside each other, bodies are on no side of the normal
    std::vector<pair> now_, judged_;

    static bool contains(const std::vector<pair>& all, const pair& p) {
        return std::find(all.begin(), all.end(), p) != all.end();
    }
};

}  // namespace tamis::detail
