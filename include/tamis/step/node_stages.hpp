#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/lanes.hpp>
#include <tamis/step/schedule.hpp>

#include <string>

namespace tamis::detail {

// Stages over nodes. Each declares the node fields that it reads (const F) and makes, and holds one formula, for W
// nodes at a time: `i` shows those fields.

struct over_nodes {
    static constexpr over where = over::nodes;
    using on_particles = fields<>;
};

/// 1/m; 0 where there is no mass.
template <class Mass, class Inverse> struct invert : over_nodes {
    using on_nodes = fields<const Mass, Inverse>;
    struct formula {
        TAMIS_INLINE void operator()(auto i) const { i[Inverse{}] = inverse_or_zero(i[Mass{}]); }
    };
    static formula bind(const auto&) { return {}; }
    static std::string text() { return letter<Inverse>(); }
};
/// A velocity or acceleration: a momentum or force over the mass.
template <class Momentum, class Velocity> struct divide : over_nodes {
    // FLIP of held particles needs no velocity of nodes where another strains them.
    static constexpr bool optional = !std::same_as<Velocity, field::acceleration>;
    using made = Velocity;
    using on_nodes = fields<const field::inverse_mass, const Momentum, Velocity>;
    struct formula {
        TAMIS_INLINE void operator()(auto i) const { i[Velocity{}] = i[symbols::im] * i[Momentum{}]; }
    };
    static formula bind(const auto&) { return {}; }
    static std::string text() { return letter<Velocity>() + " = " + letter<Momentum>() + "/m"; }
};

/// Thrown where a number that is none has come to the nodes.
struct not_a_number {};
[[noreturn]] TAMIS_SELDOM inline void throw_not_a_number() { throw not_a_number{}; }

/// A stage over nodes that throws `not_a_number` where the vector that it makes is none. In each lane what it makes is
/// added up, for a sum is finite only if all terms are: that costs an addition for each number, and one look for many
/// nodes.
template <class Stage> struct watched : Stage {
    template <class S> struct formula : Stage::formula {
        typename S::vector sum = S::vector::Zero();
        TAMIS_INLINE void operator()(auto i) {
            Stage::formula::operator()(i);
            unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA { sum[int(d)] += i[typename Stage::made{}][int(d)]; });
        }
        TAMIS_INLINE void finish() const {
            using T = typename S::scalar;
            T all = sum[0];
            for (int d = 1; d < S::dim; ++d) all += sum[d];
            if (lane<T>::any(!(all - all <= constant<T>(0)))) throw_not_a_number();
        }
    };
    template <class Now> static formula<typename Now::S> bind(const Now&) { return {}; }
};
/// To = From + a dt. XPIC does not read v.
template <class From, class To> struct advance : over_nodes {
    static constexpr bool optional = true;
    using on_nodes = fields<const From, const field::acceleration, To>;
    template <class T> struct formula {
        T dt;
        TAMIS_INLINE void operator()(auto i) const { i[To{}] = i[From{}] + dt * i[symbols::a]; }
    };
    static auto bind(const auto& now) { return formula<std::remove_cvref_t<decltype(now.lanes_dt())>>{now.lanes_dt()}; }
    static std::string text() { return letter<To>() + " = " + letter<From>() + " + a dt"; }
};

/// A formula that is shown the fields of a list.
template <class List, class Formula> struct shown_formula {
    Formula formula;
    TAMIS_INLINE void operator()(auto& row) { formula(view<std::remove_reference_t<decltype(row)>, List>{row}); }
    TAMIS_INLINE void finish() const {
        if constexpr (requires { formula.finish(); }) formula.finish();
    }
};
/// The formulas of a pass over nodes, one after the other. `All`: the fields that they name.
template <class All, class... Shown> struct node_kernel : Shown... {
    using all = All;
    TAMIS_INLINE void operator()(auto& row) { (static_cast<Shown&>(*this)(row), ...); }
    /// What formulas do after the last row.
    TAMIS_INLINE void finish() const { (static_cast<const Shown&>(*this).finish(), ...); }
};
template <class... Stage, class Now> auto node_kernel_of(stages<Stage...>, const Now& now) {
    return node_kernel<merge<typename Stage::on_nodes...>,
                       shown_formula<typename Stage::on_nodes, decltype(Stage::bind(now))>...>{{Stage::bind(now)}...};
}

}  // namespace tamis::detail
