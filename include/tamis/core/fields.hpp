#pragma once
#include <tamis/core/space.hpp>

#include <concepts>
#include <string_view>
#include <type_traits>

namespace tamis {

/// The four kinds of field. A field is an empty struct derived from one of them, with a `name`.
struct scalar_field {
    template <class S> using value = typename S::scalar;
    template <class S> static constexpr int components = 1;
};
struct vector_field {
    template <class S> using value = typename S::vector;
    template <class S> static constexpr int components = S::dim;
};
struct tensor_field {
    template <class S> using value = typename S::tensor;
    template <class S> static constexpr int components = (S::dim * S::dim);
};
/// A symmetric tensor: stored as its upper half, read and written as a full tensor.
struct symmetric_field {
    template <class S> using value = Eigen::Matrix<typename S::scalar, (S::dim * (S::dim + 1)) / 2, 1, S::align>;
    template <class S> static constexpr int components = S::dim*(S::dim + 1) / 2;
};

/// A field: an empty type that says its name and how many numbers it holds in a space.
template <class F>
concept Field = std::is_empty_v<std::remove_const_t<F>> && requires {
    { std::remove_const_t<F>::name } -> std::convertible_to<std::string_view>;
    typename std::remove_const_t<F>::template value<space<1, double>>;
};

/// A list of fields a policy asks for; `const F` is only read.
template <Field... F> struct fields {};

namespace detail {

/// The field whose column F lives in. A field may overwrite another that nobody reads any more, as the node velocity
/// does with the momentum: it says so with `using shares = other;`.
template <class F> struct column_of { using type = F; };
template <class F>
requires requires { typename F::shares; }
struct column_of<F> {
    using type = typename F::shares;
};
template <class F> using column_of_t = typename column_of<std::remove_const_t<F>>::type;

template <class Set, class... Lists> struct merge_columns { using type = Set; };

}  // namespace detail

/// Is F, const or not, in the list?
template <class List, class F> inline constexpr bool contains = false;
template <class... L, class F>
inline constexpr bool contains<fields<L...>, F> = (std::same_as<std::remove_const_t<L>, std::remove_const_t<F>> || ...);
/// Is F in the list, and not only read?
template <class List, class F> inline constexpr bool writes = false;
template <class... L, class F> inline constexpr bool writes<fields<L...>, F> = (std::same_as<L, F> || ...);
/// Is there a column for F in storage made for the list?
template <class List, class F> inline constexpr bool stores = contains<List, detail::column_of_t<F>>;

namespace detail {

template <class... S, class... Rest> struct merge_columns<fields<S...>, fields<>, Rest...>
    : merge_columns<fields<S...>, Rest...> {};
template <class... S, class F, class... L, class... Rest> struct merge_columns<fields<S...>, fields<F, L...>, Rest...>
    : merge_columns<
          std::conditional_t<contains<fields<S...>, column_of_t<F>>, fields<S...>, fields<S..., column_of_t<F>>>,
          fields<L...>, Rest...> {};

template <class P> struct on_particles { using type = fields<>; };
template <class P>
requires requires { typename P::on_particles; }
struct on_particles<P> {
    using type = typename P::on_particles;
};
template <class P> struct on_nodes { using type = fields<>; };
template <class P>
requires requires { typename P::on_nodes; }
struct on_nodes<P> {
    using type = typename P::on_nodes;
};

template <class List> struct each_field;
template <class... F> struct each_field<fields<F...>> {
    template <class Kernel> TAMIS_INLINE static constexpr void run(Kernel&& kernel) {
        (kernel(std::type_identity<F>{}), ...);
    }
};

/// Union of lists with every field under its own name.
template <class Set, class... Lists> struct merge_names { using type = Set; };
template <class... S, class... Rest> struct merge_names<fields<S...>, fields<>, Rest...>
    : merge_names<fields<S...>, Rest...> {};
template <class... S, class F, class... L, class... Rest> struct merge_names<fields<S...>, fields<F, L...>, Rest...>
    : merge_names<std::conditional_t<contains<fields<S...>, F>, fields<S...>, fields<S..., std::remove_const_t<F>>>,
                  fields<L...>, Rest...> {};
/// Lists one after the other, as they are.
template <class... Lists> struct concatenate;
template <class... F> struct concatenate<fields<F...>> { using type = fields<F...>; };
template <class... F, class... G, class... Rest> struct concatenate<fields<F...>, fields<G...>, Rest...>
    : concatenate<fields<F..., G...>, Rest...> {};
template <bool Wanted, class... F> using fields_if = std::conditional_t<Wanted, fields<F...>, fields<>>;

template <class... Lists> using merge_as_is = typename merge_names<fields<>, Lists...>::type;

}  // namespace detail

/// The columns that serve all the lists: no duplicates, const dropped, shared columns once.
template <class... Lists> using merge = typename detail::merge_columns<fields<>, Lists...>::type;
/// What a policy asks for on particles and on nodes; nothing if it does not say.
template <class P> using on_particles_t = typename detail::on_particles<P>::type;
template <class P> using on_nodes_t = typename detail::on_nodes<P>::type;

}  // namespace tamis
