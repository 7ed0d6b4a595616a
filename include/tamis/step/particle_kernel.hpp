#pragma once
#include <tamis/engine/sweeps.hpp>
#include <tamis/update/update.hpp>

#include <cstdint>
#include <type_traits>

namespace tamis::detail {

/// Members of a part of a pass over particles that only gives to nodes.
template <class Sums, class Reads, bool BySlopes = false, bool ByOffsets = false> struct gives {
    using sums = Sums;
    using reads = Reads;
    using gathers = tamis::detail::gathers<>;
    static constexpr bool by_slopes = BySlopes, by_offsets = ByOffsets, updates = false, moves = false;
};
/// ... of one that updates particles.
template <class Gathers, class Reads> struct updates_particles {
    using sums = fields<>;
    using reads = Reads;
    using gathers = Gathers;
    static constexpr bool by_slopes = false, by_offsets = false, updates = true, moves = false;
};

/// A slot as the parts of one pass see it: what one of them makes and another uses up is not stored.
template <class Slot, class Local> struct slot_in_pass {
    using list = typename Slot::list;
    Slot& slot;
    Local& local;
    template <class F> TAMIS_INLINE auto& get() const {
        if constexpr (stores<typename Slot::list, F>)
            return slot.template get<F>();
        else
            return local.template get<F>();
    }
};

template <int K, class Part> struct numbered_part { Part part; };
template <class S, class Numbers, class... Part> struct particle_kernel_of_parts;

/// The parts of a pass over particles as one kernel for the engine: it gathers what all of them want in one go, updates
/// a slot by one after the other, and gives the nodes the terms of all.
template <class S, int... K, class... Part>
struct particle_kernel_of_parts<S, std::integer_sequence<int, K...>, Part...> : numbered_part<K, Part>... {
    using gathers = merge_gathers<typename Part::gathers...>;
    using sums = typename concatenate<fields<>, typename Part::sums...>::type;
    using reads = merge<typename Part::reads...>;
    static constexpr bool sums_by_slopes = (Part::by_slopes || ...), sums_by_offsets = (Part::by_offsets || ...);
    static constexpr bool updates = (Part::updates || ...), moves = (Part::moves || ...);

    template <class Slot> TAMIS_INLINE void update(Slot& slot, std::uint32_t occupied, const frame<S>& at,
                                                   const auto& g, const auto& flow) const {
        values<S, fields<field::step_displacement>> local;
        slot_in_pass<Slot, decltype(local)> p{slot, local};
        (update_one<K, Part>(p, occupied, at, g, flow), ...);
    }
    TAMIS_INLINE auto make(const auto& slot, const frame<S>& at, const auto& g) const {
        return make_of(typename giving<void, K...>::type{}, slot, at, g);
    }
    auto look() const { return look_of<K...>(); }
    auto fence() const { return fence_of<K...>(); }

  private:
    template <int J> static constexpr bool gives_terms =
        !std::same_as<typename std::tuple_element_t<static_cast<std::size_t>(J), std::tuple<Part...>>::sums, fields<>>;
    template <class Void, int... J> struct giving {
        template <int... G> static std::integer_sequence<int, G...> only(std::integer_sequence<int, G...>);
        template <class... Sequence> struct join { using type = std::integer_sequence<int>; };
        template <int... A> struct join<std::integer_sequence<int, A...>> {
            using type = std::integer_sequence<int, A...>;
        };
        template <int... A, int... B, class... Rest>
        struct join<std::integer_sequence<int, A...>, std::integer_sequence<int, B...>, Rest...>
            : join<std::integer_sequence<int, A..., B...>, Rest...> {};
        using type = typename join<
            std::conditional_t<gives_terms<J>, std::integer_sequence<int, J>, std::integer_sequence<int>>...>::type;
    };
    template <int J> TAMIS_INLINE const auto& part_at() const {
        return numbered_part<J, std::tuple_element_t<static_cast<std::size_t>(J), std::tuple<Part...>>>::part;
    }
    template <int J, class P> TAMIS_INLINE void update_one(auto& p, std::uint32_t occupied, const frame<S>& at,
                                                           const auto& g, const auto& flow) const {
        if constexpr (P::updates) numbered_part<J, P>::part.update(p, occupied, at, g, flow);
    }
    template <int J> TAMIS_INLINE auto make_of(std::integer_sequence<int, J>, const auto& slot, const frame<S>& at,
                                               const auto& g) const {
        return part_at<J>().make(slot, at, g);
    }
    template <int J, int... More> TAMIS_INLINE auto make_of(std::integer_sequence<int, J, More...>, const auto& slot,
                                                            const frame<S>& at, const auto& g) const
        requires(sizeof...(More) > 0) {
        return terms<decltype(part_at<J>().make(slot, at, g)), decltype(part_at<More>().make(slot, at, g))...>{
            {part_at<J>().make(slot, at, g)}, {part_at<More>().make(slot, at, g)}...};
    }
    template <int First, int... Rest> auto look_of() const {
        if constexpr (requires { part_at<First>().look(); })
            return part_at<First>().look();
        else if constexpr (sizeof...(Rest) > 0)
            return look_of<Rest...>();
        else
            return no_look{};
    }
    template <int First, int... Rest> auto fence_of() const {
        if constexpr (requires { part_at<First>().fence(); })
            return part_at<First>().fence();
        else if constexpr (sizeof...(Rest) > 0)
            return fence_of<Rest...>();
        else
            return no_fence{};
    }
};
template <class S, class... Part> using particle_kernel =
    particle_kernel_of_parts<S, std::make_integer_sequence<int, static_cast<int>(sizeof...(Part))>, Part...>;
template <class S, class... Part> particle_kernel<S, Part...> kernel_of_parts(const Part&... part) {
    return {{part}...};
}

}  // namespace tamis::detail
