#pragma once
#include <tamis/core/values.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace tamis::detail {

/// Node fields in columns, one per component, and which blocks of W nodes are in use.
template <class S, class List> class node_table {
  public:
    using real = typename S::real;
    using row = values<S, List>;
    static constexpr int components = row::components;

    explicit node_table(std::size_t places)
        // Not a power of two: columns stay out of each other's cache sets.
        : stride_((places + 63) / 64 * 64 + 80),
          data_(new (std::align_val_t{64}) real[stride_ * static_cast<std::size_t>(components)]()) {}

    /// Component c of field F, over all places.
    template <class F> TAMIS_INLINE real* column(int c = 0) const {
        return data_.get() + static_cast<std::size_t>(row::template first<F>() + c) * stride_;
    }
    template <class F> void set_zero() {
        for (int c = 0; c < std::remove_const_t<F>::template components<S>; ++c)
            for (const auto& r : runs_) std::fill_n(column<F>(c) + r.first, r.count, real(0));
    }

    /// Blocks of W places that particles reach, each once, ascending.
    const std::vector<std::uint32_t>& active() const { return active_; }
    void set_active(std::vector<std::uint32_t> blocks) {
        active_ = std::move(blocks);
        runs_.clear();
        constexpr auto W = static_cast<std::size_t>(S::width);
        for (const std::uint32_t b : active_) {
            const std::size_t first = b * W;
            if (!runs_.empty() && runs_.back().first + runs_.back().count == first)
                runs_.back().count += W;
            else
                runs_.push_back({first, W});
        }
    }

  private:
    struct free_aligned {
        void operator()(real* p) const { ::operator delete[](p, std::align_val_t{64}); }
    };
    struct run {
        std::size_t first, count;
    };
    std::size_t stride_;
    std::unique_ptr<real[], free_aligned> data_;
    std::vector<std::uint32_t> active_;
    std::vector<run> runs_;
};

}  // namespace tamis::detail
