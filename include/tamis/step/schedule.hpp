#pragma once
#include <tamis/core/names.hpp>
#include <tamis/engine/columns.hpp>
#include <tamis/step/plan.hpp>

#include <bit>
#include <string>
#include <utility>

namespace tamis::detail {

/// The letter that the papers print for a field, or its name.
template <class F> std::string letter() {
    if constexpr (requires { F::letter; })
        return std::string(F::letter);
    else
        return std::string(F::name);
}

/// Stages of a step, in the order of the papers; lists within are part of the text.
template <class... Stage> struct stages {};
template <class... A, class... B> constexpr stages<A..., B...> operator+(stages<A...>, stages<B...>) { return {}; }
template <class Stage> struct flat_list { using type = stages<Stage>; };
template <class... Stage> struct flat_list<stages<Stage...>> {
    using type = decltype((stages<>{} + ... + typename flat_list<Stage>::type{}));
};

// The k-th of many types, at once.
template <std::size_t K, class T> struct leaf {};
template <class Numbers, class... T> struct leaves;
template <std::size_t... K, class... T> struct leaves<std::index_sequence<K...>, T...> : leaf<K, T>... {};
template <std::size_t K, class T> std::type_identity<T> pick_leaf(leaf<K, T>);
template <class... T> using numbered = leaves<std::index_sequence_for<T...>, T...>;
template <class Numbered, std::size_t K> using nth = typename decltype(pick_leaf<K>(Numbered{}))::type;

template <class F, class G> fields<G> column_of_share(shares<F, G>);

/// What a stage says; nothing is said by default.
template <class Stage> using particle_fields_of =
    typename concatenate<typename Stage::on_particles,
                         // Weights are functions of the place.
                         fields_if<Stage::where == over::particles, const field::position>>::type;
template <class Stage> using node_fields_of = typename Stage::on_nodes;
template <class Stage> struct held_fields_of { using type = fields<>; };
template <class Stage>
requires requires { typename Stage::on_held; }
struct held_fields_of<Stage> {
    using type = typename Stage::on_held;
};
template <class Stage> struct scratch_fields_of { using type = fields<>; };
template <class Stage>
requires requires { typename Stage::scratch; }
struct scratch_fields_of<Stage> {
    using type = typename Stage::scratch;
};

template <int N, class S, class... F> constexpr void note_fields([[maybe_unused]] plan<N>& p,
                                                                 [[maybe_unused]] int stage, [[maybe_unused]] int& at,
                                                                 [[maybe_unused]] place where, fields<F...>) {
    (p.note(stage, &tag<std::remove_const_t<F>>, at++, where, F::template components<S>, std::is_const_v<F>), ...);
}
template <int N, class S, class Stage> constexpr void note_stage(plan<N>& p, int stage, int& at) {
    p.where[plan<N>::i(stage)] = Stage::where;
    p.optional[plan<N>::i(stage)] = requires { requires Stage::optional; };
    p.looks_for_mass[plan<N>::i(stage)] = requires { requires Stage::looks_for_mass; };
    note_fields<N, S>(p, stage, at, place::particle, particle_fields_of<Stage>{});
    note_fields<N, S>(p, stage, at, place::node, node_fields_of<Stage>{});
    note_fields<N, S>(p, stage, at, place::held, typename held_fields_of<Stage>::type{});
    note_fields<N, S>(p, stage, at, place::scratch, typename scratch_fields_of<Stage>::type{});
}
template <class S, class... Stage, class... Watched>
consteval auto make_plan(stages<Stage...>, fields<Watched...>, bool ahead) {
    constexpr int N = static_cast<int>(sizeof...(Stage));
    plan<N> p;
    int at = 0, k = 0;
    (note_stage<N, S, Stage>(p, k++, at), ...);
    plan_fields watched = 0;
    ((watched |= p.find(&tag<std::remove_const_t<Watched>>, place::node)), ...);
    p.masses = p.find(&tag<field::mass>, place::node) | p.find(&tag<field::inverse_mass>, place::node);
    p.derive(watched, ahead);
    return p;
}

/// Says at compile time which stage reads what no stage makes, or makes what nobody reads.
template <class Stage, class Field> struct reads_what_no_stage_makes {
    static_assert(
        sizeof(Stage) == 0,
        "tamis: a stage of the step reads a node field that no stage before it makes; put the stage that makes "
        "it before it");
};
template <class Stage> struct makes_what_nobody_reads {
    static_assert(
        sizeof(Stage) == 0,
        "tamis: nobody reads what a stage of the step makes; is the name of a field right? A stage that may be "
        "left out says `static constexpr bool optional = true;`");
};

/// The passes of a step's text, derived from what its stages say they read and make (docs/step.md): stages that nobody
/// needs are left out; each stage is in the earliest pass that its fields allow, so that passes over particles become
/// one where they can; node fields take the columns of those that nobody reads any more; sums are followed by an
/// exchange of what is still to be read. `S`: the space; `Watched`: node fields that somebody reads after the step;
/// `Ahead`: the sums of the first pass are made in the last one of the step before.
template <class S, class Text, class Watched = fields<>, bool Ahead = false> struct schedule {
    using list = typename flat_list<Text>::type;
    template <class... Stage> static numbered<Stage...> number(stages<Stage...>);
    template <class... F> static numbered<F...> number(fields<F...>);
    template <class... Stage> static typename concatenate<
        fields<>,
        typename concatenate<particle_fields_of<Stage>, node_fields_of<Stage>, typename held_fields_of<Stage>::type,
                             typename scratch_fields_of<Stage>::type>::type...>::type uses(stages<Stage...>);
    using all_stages = decltype(number(list{}));
    using all_fields = decltype(number(uses(list{})));

    using text = list;
    static constexpr auto plan = make_plan<S>(list{}, Watched{}, Ahead);
    static constexpr int stage_count = static_cast<int>(plan.where.size()), count = plan.count;
    template <int K> using stage = nth<all_stages, static_cast<std::size_t>(K)>;

    // How the types are made.

    /// The numbers of a set.
    template <std::uint64_t Set> struct chosen {
        static constexpr int count = std::popcount(Set);
        static constexpr auto number = [] {
            std::array<int, 64> all{};
            for (int k = 0, n = 0; k < 64; ++k)
                if (Set >> k & 1) all[static_cast<std::size_t>(n++)] = k;
            return all;
        }();
        using sequence = std::make_index_sequence<static_cast<std::size_t>(count)>;
    };
    template <int K> using field_at =
        std::remove_const_t<nth<all_fields, static_cast<std::size_t>(plan.type[static_cast<std::size_t>(K)])>>;
    template <class Chosen, std::size_t... K> static auto fields_of(std::index_sequence<K...>)
        -> fields<field_at<Chosen::number[K]>...>;
    template <plan_fields Set> using types = decltype(fields_of<chosen<Set>>(typename chosen<Set>::sequence{}));
    template <class Chosen, std::size_t... K> static auto stages_of(std::index_sequence<K...>)
        -> stages<stage<Chosen::number[K]>...>;
    template <std::uint64_t Set> using stages_at = decltype(stages_of<chosen<Set>>(typename chosen<Set>::sequence{}));
    template <class Chosen, std::size_t... K> static auto columns_of(std::index_sequence<K...>)
        -> shared_columns<fields<>, shares<field_at<Chosen::number[K]>,
                                           field_at<plan.owner[static_cast<std::size_t>(Chosen::number[K])]>>...>;
    template <class... Shares> static auto with_columns(shared_columns<fields<>, Shares...>)
        -> shared_columns<merge<decltype(column_of_share(Shares{}))...>, Shares...>;
    using stored_fields = chosen<plan.stored_on_nodes()>;
    using shared = decltype(columns_of<stored_fields>(typename stored_fields::sequence{}));
    template <int K> static consteval bool complete() {
        constexpr auto k = static_cast<std::size_t>(K);
        if constexpr (plan.lacks[k] != 0) {
            using lacking = nth<decltype(number(types<plan.lacks[k]>{})), 0>;
            return sizeof(reads_what_no_stage_makes<stage<K>, lacking>) > 0;
        } else if constexpr (!plan.live[k] && !plan.optional[k])
            return sizeof(makes_what_nobody_reads<stage<K>>) > 0;
        else
            return true;
    }
    template <std::size_t... K> static consteval bool all_complete(std::index_sequence<K...>) {
        return (complete<static_cast<int>(K)>() && ...);
    }
    static_assert(all_complete(std::make_index_sequence<static_cast<std::size_t>(stage_count)>{}));

    // What is derived.

    template <int Pass> static constexpr over kind = plan.kind[static_cast<std::size_t>(Pass)];
    template <int Pass> using stages_of_pass = stages_at<plan.stages_in(Pass)>;
    /// Node fields that a pass reads, and those it makes that are read later.
    template <int Pass> using loads = types<plan.loads[static_cast<std::size_t>(Pass)] & plan.nodes>;
    template <int Pass> using saves = types<plan.saves[static_cast<std::size_t>(Pass)] & plan.nodes>;
    /// Particle fields likewise.
    template <int Pass> using particle_loads = types<plan.loads[static_cast<std::size_t>(Pass)] & plan.particles>;
    template <int Pass> using particle_saves = types<plan.saves[static_cast<std::size_t>(Pass)] & plan.particles>;
    /// Sums of a pass that are to be exchanged.
    template <int Pass> using sums = types<plan.sums[static_cast<std::size_t>(Pass)]>;
    using dropped = stages_at<plan.left_out()>;
    /// The columns of node fields.
    using layout = decltype(with_columns(shared{}));
    /// Does a field hold after the step what its last stage made?
    template <class F> static constexpr bool kept = [] {
        const plan_fields f = plan.find(&tag<F>, place::node);
        return (plan.kept & f) != 0;
    }();
};

}  // namespace tamis::detail
