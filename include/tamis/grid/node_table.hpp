#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/memory.hpp>
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

    /// Throws `error` if the machine has not the memory.
    explicit node_table(std::size_t places)
        // Not a power of two: columns stay out of each other's cache sets.
        : stride_((places + 63) / 64 * 64 + 80), data_(allocate(stride_)) {}

    /// Component c of field F, over all places.
    template <class F> TAMIS_INLINE real* column(int c = 0) const {
        return data_.get() + margin + static_cast<std::size_t>(row::template first<F>() + c) * stride_;
    }
    /// A vector field at one place.
    template <class F> TAMIS_INLINE point<S::dim, real> get(std::size_t place) const {
        point<S::dim, real> value;
        for (int d = 0; d < S::dim; ++d) value[d] = column<F>(d)[place];
        return value;
    }
    template <class F> TAMIS_INLINE void put(std::size_t place, const point<S::dim, real>& value) const {
        for (int d = 0; d < S::dim; ++d) column<F>(d)[place] = value[d];
    }
    template <class F> void set_zero() {
        for (int c = 0; c < std::remove_const_t<F>::template components<S>; ++c)
            for (const auto& r : runs_) std::fill_n(column<F>(c) + r.first, r.count, real(0));
    }

    /// Blocks of W places that particles reach, each once, ascending.
    const std::vector<std::uint32_t>& active() const { return active_; }
    void set_active(std::vector<std::uint32_t> blocks) {
        constexpr auto W = static_cast<std::size_t>(S::width);
        // Blocks that are left must not keep values: nobody writes there any more, but held nodes may be read.
        std::size_t k = 0;
        for (const std::uint32_t b : active_) {
            while (k < blocks.size() && blocks[k] < b) ++k;
            if (k < blocks.size() && blocks[k] == b) continue;
            for (int c = 0; c < components; ++c)
                std::fill_n(data_.get() + margin + static_cast<std::size_t>(c) * stride_ + b * W, W, real(0));
        }
        active_ = std::move(blocks);
        runs_.clear();
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
    static real* allocate(std::size_t stride) {
        const double bytes = static_cast<double>(stride) * components * sizeof(real);
        const auto refuse = [&] {
            return error(sentence("the grid's nodes need ", bytes / 1e9, " GB of memory, ",
                                  sizeof(real) * static_cast<std::size_t>(components),
                                  " bytes each, which this machine has not; take fewer cells"));
        };
        if (bytes > memory_of_machine()) throw refuse();
        try {
            return new (std::align_val_t{64}) real[margin + stride * static_cast<std::size_t>(components)]();
        } catch (const std::bad_alloc&) {
            throw refuse();
        }
    }
    /// Zeros before the first column, as there are after each: neighbours of a column's ends may be read.
    static constexpr std::size_t margin = 64;
    std::size_t stride_;
    std::unique_ptr<real[], free_aligned> data_;
    std::vector<std::uint32_t> active_;
    std::vector<run> runs_;
};

}  // namespace tamis::detail
