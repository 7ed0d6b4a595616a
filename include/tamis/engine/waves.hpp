#pragma once
#include <tamis/engine/wavefront.hpp>
#include <tamis/engine/wrap.hpp>

#include <cstddef>
#include <vector>

namespace tamis::detail {

/// While it lives, the passes of a step of one body wait and are run together, slab by slab, where that many particles
/// are beyond what caches hold (docs/storage.md, Waves). What throws meanwhile leaves no pass to be run.
template <class Sweeps> class waves_of_step {
  public:
    template <class Body, class Execution>
    waves_of_step(wavefront& waiting, Sweeps& sweeps, const Body& body, const Execution& run)
        : waiting_(waiting), sweeps_(sweeps) {
        if constexpr (Sweeps::runner_type::may_wait) {
            const auto& store = body.store();
            const std::size_t bytes = store.slots.size() * sizeof(store.slots.front());
            if (store.slabs() < 8 || bytes < wait_from || any_axis_wraps(body.lattice())) return;
            std::vector<std::size_t> tiles;
            for (std::size_t k = 0; k < store.slabs(); ++k) tiles.push_back(store.row(k).size());
            waiting_.start(store.first_nodes(body.lattice()), tiles, run.count());
            sweeps_.runner().wait_in(&waiting_);
            runs_ = true;
        }
    }
    waves_of_step(const waves_of_step&) = delete;
    waves_of_step& operator=(const waves_of_step&) = delete;
    ~waves_of_step() {
        if (!runs_) return;
        sweeps_.runner().wait_in(nullptr);
        waiting_.clear();
    }
    bool runs() const { return runs_; }

  private:
    // Blocks of 56^2 to 96^2 cells in 2D, 16^3 and 20^3 in 3D were as fast or faster by passes one by one.
    static constexpr std::size_t wait_from = std::size_t(4) << 20;
    wavefront& waiting_;
    Sweeps& sweeps_;
    bool runs_ = false;
};

}  // namespace tamis::detail
