#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/memory.hpp>
#include <tamis/engine/columns.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace tamis::detail {

/// Node fields in the columns of a layout, and which blocks of W nodes are in use. In 1D they lie in columns, one per
/// component. Beyond, all components of a block lie side by side: a tile reaches many rows of nodes, and each row would
/// else take as many pages of memory as there are components.
template <class S, class Layout> class node_table {
  public:
    using real = typename S::real;
    using row = column_row<S, Layout>;
    using layout = Layout;
    static constexpr int components = row::components;
    static constexpr bool in_columns = S::dim == 1;

    /// Memory is taken for nodes in use only. `reach` places before the first and after the last may be read, in 1D no
    /// more than columns have between them: they are zero. Throws `error` if there are too many nodes for it.
    explicit node_table(std::size_t places, std::size_t reach = 0)
        // Not a power of two: columns stay out of each other's cache sets.
        : places_(places),
          stride_((places + 63) / 64 * 64 + 80),
          data_(allocate(places, margin(reach) + stride_ * static_cast<std::size_t>(components) + margin(reach))),
          first_(data_.data() + margin(reach)) {}

    /// The first of the columns of F.
    template <class F> static constexpr int first_column() {
        return row::template first<typename column_of<Layout, F>::type>();
    }
    /// Where the numbers are. A copy of it stays in registers: no store to a node can change it.
    struct columns_type {
        real* first;
        std::size_t stride;
        template <class F> TAMIS_INLINE real* column(int c = 0) const {
            static_assert(in_columns);
            return first + static_cast<std::size_t>(first_column<F>() + c) * stride;
        }
        /// `place` may be before the first one, by the reach that the table was made for.
        template <class F, class Place> TAMIS_INLINE real* block(Place place, int c = 0) const {
            const auto at = static_cast<std::ptrdiff_t>(place);
            if constexpr (in_columns)
                return column<F>(c) + at;
            else
                return first + at * components + (first_column<F>() + c) * S::width;
        }
    };
    TAMIS_INLINE columns_type columns() const { return {first_, stride_}; }
    /// Component c of field F, over all places, in 1D.
    template <class F> TAMIS_INLINE real* column(int c = 0) const { return columns().template column<F>(c); }
    /// Component c of field F at W places, the first a multiple of W.
    template <class F, class Place> TAMIS_INLINE real* block(Place place, int c = 0) const {
        return columns().template block<F>(place, c);
    }
    /// ... at one place.
    template <class F> TAMIS_INLINE real& at(std::size_t place, int c = 0) const {
        constexpr auto W = static_cast<std::size_t>(S::width);
        return block<F>(place / W * W, c)[place % W];
    }
    /// f(values of component c of F over all places, which it may change where nodes are in use).
    template <class F, class Change> void with_column(int c, Change f) {
        if constexpr (in_columns)
            f(column<F>(c));
        else {
            constexpr auto W = static_cast<std::size_t>(S::width);
            zeros<real> all(places_);
            for (const std::uint32_t b : active_) std::copy_n(block<F>(b * W, c), W, all.data() + b * W);
            f(all.data());
            for (const std::uint32_t b : active_) std::copy_n(all.data() + b * W, W, block<F>(b * W, c));
        }
    }
    /// A vector field at one place.
    template <class F> TAMIS_INLINE point<S::dim, real> get(std::size_t place) const {
        point<S::dim, real> value;
        for (int d = 0; d < S::dim; ++d) value[d] = at<F>(place, d);
        return value;
    }
    template <class F> TAMIS_INLINE void put(std::size_t place, const point<S::dim, real>& value) const {
        for (int d = 0; d < S::dim; ++d) at<F>(place, d) = value[d];
    }
    template <class... F> void set_zero() {
        if constexpr (in_columns)
            (clear_columns<F>(), ...);
        else
            set_zero_in<F...>(0, active_.size());
    }
    /// ... in the active blocks from the first-th to the one before the last-th.
    template <class... F> void set_zero_in(std::size_t first, std::size_t last) {
        static_assert(!in_columns);
        constexpr auto W = static_cast<std::size_t>(S::width);
        for (std::size_t k = first; k < last; ++k)
            (std::fill_n(block<F>(active_[k] * W), W * static_cast<std::size_t>(F::template components<S>), real(0)),
             ...);
    }

    /// Blocks of W places that particles reach, each once, ascending.
    const std::vector<std::uint32_t>& active() const { return active_; }
    void set_active(std::vector<std::uint32_t> blocks) {
        constexpr auto W = static_cast<std::size_t>(S::width);
        check_memory(blocks.size());
        // Blocks that are left must not keep values: nobody writes there any more, but held nodes may be read.
        std::size_t k = 0;
        for (const std::uint32_t b : active_) {
            while (k < blocks.size() && blocks[k] < b) ++k;
            if (k < blocks.size() && blocks[k] == b) continue;
            if constexpr (in_columns)
                for (int c = 0; c < components; ++c)
                    std::fill_n(first_ + static_cast<std::size_t>(c) * stride_ + b * W, W, real(0));
            else
                std::fill_n(first_ + b * W * static_cast<std::size_t>(components),
                            W * static_cast<std::size_t>(components), real(0));
        }
        active_ = std::move(blocks);
        runs_.clear();
        if constexpr (!in_columns) return;
        for (const std::uint32_t b : active_) {
            const std::size_t first = b * W;
            if (!runs_.empty() && runs_.back().first + runs_.back().count == first)
                runs_.back().count += W;
            else
                runs_.push_back({first, W});
        }
    }

  private:
    struct run {
        std::size_t first, count;
    };
    template <class F> void clear_columns() {
        for (int c = 0; c < F::template components<S>; ++c)
            for (const auto& r : runs_) std::fill_n(column<F>(c) + r.first, r.count, real(0));
    }
    /// Numbers before the first place, as many as after the last; whole cache lines.
    static std::size_t margin(std::size_t reach) {
        return (reach + 63) / 64 * 64 * static_cast<std::size_t>(in_columns ? 1 : components);
    }
    static zeros<real> allocate(std::size_t places, std::size_t count) {
        try {
            // Blocks of places have 32-bit numbers.
            if (places / static_cast<std::size_t>(S::width) >= std::numeric_limits<std::uint32_t>::max())
                throw std::bad_alloc();
            return zeros<real>(count);
        } catch (const std::bad_alloc&) {
            throw error(sentence("the grid's ", places, " nodes are more than can be numbered; take fewer cells"));
        }
    }
    static void check_memory(std::size_t blocks) {
        constexpr std::size_t block = sizeof(real) * static_cast<std::size_t>(components * S::width);
        const double bytes = static_cast<double>(blocks) * static_cast<double>(block);
        if (bytes > memory_of_machine())
            throw error(sentence("the nodes that particles reach need ", bytes / 1e9, " GB of memory, ",
                                 sizeof(real) * static_cast<std::size_t>(components),
                                 " bytes each, which this machine has not; take fewer cells"));
    }
    std::size_t places_, stride_;
    zeros<real> data_;
    real* first_;
    std::vector<std::uint32_t> active_;
    std::vector<run> runs_;
};

}  // namespace tamis::detail
