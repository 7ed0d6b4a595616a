#pragma once
#include <tamis/core/values.hpp>

#include <cstddef>

namespace tamis::detail {

/// Sums over a row of tiles in the order of their nodes, in 1D. A tile gives to its own block of W nodes and to the one
/// after it. What it gives to the latter waits until the tile of that block has come by: so every block is written
/// once, whole, and none is read. They are the sums that `flush` makes, bit for bit.
template <class S, int N, class List> class running_sums;
template <class S, int N, class... F> class running_sums<S, N, fields<F...>> {
  public:
    using T = typename S::scalar;
    using list = fields<F...>;
    using sums_type = values<S, list>;
    static constexpr int W = S::width;
    static_assert(S::dim == 1 && W > 1 && W >= N - 1);

    running_sums() { waiting_.set_zero(); }

    /// A tile's sums at the a-th node of each cell; its block begins at a place of the nodes' columns.
    template <class Nodes> TAMIS_INLINE void add(const sums_type (&of_tile)[N], const Nodes& nodes, std::size_t place) {
        if (place != next_) {
            if (next_ != nowhere) write_waiting(nodes);
            waiting_.set_zero();
        }
        each([&](auto tag, auto c) TAMIS_INLINE_LAMBDA {
            using G = typename decltype(tag)::type;
            const auto of = [&](int a) TAMIS_INLINE_LAMBDA -> const T& {
                return component<S>(of_tile[a].template get<G>(), c);
            };
            T low = of(0) + lane<T>::template up<1>(of(1)), high = lane<T>::template over<1>(of(1));
            unroll<N - 2>([&](auto a) TAMIS_INLINE_LAMBDA {
                low += lane<T>::template up<a + 2>(of(a + 2));
                high += lane<T>::template over<a + 2>(of(a + 2));
            });
            T& waiting = component<S>(waiting_.template get<G>(), c);
            lane<T>::store(nodes.template column<G>(c) + place, waiting + low);
            waiting = high;
        });
        next_ = place + static_cast<std::size_t>(W);
    }
    /// Where what still waits belongs; `nowhere` if no tile came by.
    std::size_t next() const { return next_; }
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
    /// To a block that no tile has.
    template <class Nodes> void write_waiting(const Nodes& nodes) const {
        each([&](auto tag, auto c) {
            using G = typename decltype(tag)::type;
            lane<T>::store(nodes.template column<G>(c) + next_, component<S>(waiting_.template get<G>(), c));
        });
    }
    /// To a block that another row has written.
    template <class Nodes> void add_waiting(const Nodes& nodes) const {
        each([&](auto tag, auto c) {
            using G = typename decltype(tag)::type;
            auto* const at = nodes.template column<G>(c) + next_;
            lane<T>::store(at, lane<T>::load(at) + component<S>(waiting_.template get<G>(), c));
        });
    }

  private:
    sums_type waiting_;
    std::size_t next_ = nowhere;

    template <class Use> TAMIS_INLINE static void each(Use use) {
        (unroll<F::template components<S>>([&](auto c) TAMIS_INLINE_LAMBDA { use(std::type_identity<F>{}, c); }), ...);
    }
};

}  // namespace tamis::detail
