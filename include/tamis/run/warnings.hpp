#pragma once
#include <tamis/core/error.hpp>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace tamis {

/// What a solver warns of, each kind once in its life.
enum class warning_kind {
    free_end,        ///< A step between the limits of free ends and of inner nodes
    unknown_limit,   ///< A step that `courant{}` chose although nothing is known of the composition
    cut_region,      ///< A region of `make_body` that ends beyond the grid
    idle_condition,  ///< Boundary conditions that hold no node
    overlap,         ///< Particles of two bodies nearer than half their spacing
    idle_load        ///< Loads on particles or faces that have found none by the end of `integrate`
};

/// A warning, as listeners are told it.
struct warning {
    std::string sentence;  ///< What is wrong, and what to do.
    /// Of steps: Courant numbers, the step's, and the one at free ends, or 1.
    double number = 0, limit = 0;
    warning_kind kind = warning_kind::free_end;  ///< What it is about.
};

/// What becomes of warnings: standard error tells them (if nobody listens), they are only kept, or they are thrown.
enum class warnings_are { told, kept, errors };

/// Through which a solver warns. `integrate` tells its observers that take a `const warning&`.
class warning_channel {
  public:
    /// The sentences so far.
    const std::vector<std::string>& warnings() const { return sentences_; }
    /// What becomes of warnings from now on. As errors they are thrown as `error`, where they arise.
    void when_warned(warnings_are how) { how_ = how; }
    /// Who is told from now on instead of standard error; returns who was.
    std::function<void(const warning&)> when_warned(std::function<void(const warning&)> listener) const {
        return std::exchange(listener_, std::move(listener));
    }
    /// Warns, if it is the first of its kind.
    void warn(const warning& what) const {
        if (has_warned(what.kind)) return;
        kinds_.push_back(what.kind);
        sentences_.push_back(what.sentence);
        if (how_ == warnings_are::errors) throw error(what.sentence);
        if (how_ == warnings_are::kept) return;
        if (listener_)
            listener_(what);
        else
            std::fprintf(stderr, "tamis: %s\n", what.sentence.c_str());
    }
    /// ... by what look() finds, a sentence; empty if there is nothing to warn of.
    template <class Look> void warn_if_any(warning_kind kind, const Look& look) const {
        if (has_warned(kind)) return;
        const std::string sentence = look();
        if (!sentence.empty()) warn({sentence, 0, 0, kind});
    }
    /// Was there a warning of this kind?
    bool has_warned(warning_kind kind) const { return std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end(); }

  private:
    // A const solver makes bodies, and may have to warn.
    mutable std::vector<warning_kind> kinds_;
    mutable std::vector<std::string> sentences_;
    mutable std::function<void(const warning&)> listener_;
    warnings_are how_ = warnings_are::told;
};

}  // namespace tamis
