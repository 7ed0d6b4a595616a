#pragma once
#include <tamis/core/space.hpp>

#include <concepts>
#include <string_view>
#include <type_traits>

namespace tamis {

// The five kinds of field. A field is an empty struct derived from one of them, with a `name` and, where it has one, a
// `unit` ("kg/m^Dim"), for tables and messages.

/// A field of one number.
struct scalar_field {
    template <class S> using value = typename S::scalar;
    template <class S> static constexpr int components = 1;
};
/// A field of Dim numbers, a vector.
struct vector_field {
    template <class S> using value = typename S::vector;
    template <class S> static constexpr int components = S::dim;
};
/// A field of Dim x Dim numbers, a tensor.
struct tensor_field {
    template <class S> using value = typename S::tensor;
    template <class S> static constexpr int components = (S::dim * S::dim);
};
/// A field that is a symmetric tensor: stored as its upper half, read and written as a full tensor.
struct symmetric_field {
    template <class S> using value = Eigen::Matrix<typename S::scalar, (S::dim * (S::dim + 1)) / 2, 1, S::align>;
    template <class S> static constexpr int components = S::dim*(S::dim + 1) / 2;
    /// As it is read and written.
    template <class S> using full = typename S::tensor;
};
/// A field that is a symmetric 3 x 3 tensor in every dimension, read and written as a full one: for what has a part out
/// of the plane. Stored are xx, yy, zz in 1D, xy beside them in 2D, xz and yz too in 3D; the others stay zero in
/// uniaxial and plane strain.
struct symmetric_3x3_field : symmetric_field {
    template <class S> static constexpr int components = S::dim == 1 ? 3 : S::dim == 2 ? 4 : 6;
    template <class S> using value = Eigen::Matrix<typename S::scalar, components<S>, 1, S::align>;
    /// As it is read and written.
    template <class S> using full = typename S::tensor_3x3;
};

/// A field: an empty type that says its name and how many numbers it holds in a space.
template <class F>
concept Field = std::is_empty_v<std::remove_const_t<F>> && requires {
    { std::remove_const_t<F>::name } -> std::convertible_to<std::string_view>;
    typename std::remove_const_t<F>::template value<space<1, double>>;
};

/// A list of fields a policy asks for; `const F` is only read.
template <Field... F> struct fields {};

/// Is F, const or not, in the list?
template <class List, class F> inline constexpr bool contains = false;
template <class... L, class F>
inline constexpr bool contains<fields<L...>, F> = (std::same_as<std::remove_const_t<L>, std::remove_const_t<F>> || ...);
/// Is F in the list, and not only read?
template <class List, class F> inline constexpr bool writes = false;
template <class... L, class F> inline constexpr bool writes<fields<L...>, F> = (std::same_as<L, F> || ...);
/// Is there a column for F in storage made for the list?
template <class List, class F> inline constexpr bool stores = contains<List, F>;

namespace detail {

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

/// Union of lists.
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

}  // namespace detail

/// The fields of all lists: each once, const dropped.
template <class... Lists> using merge = typename detail::merge_names<fields<>, Lists...>::type;
/// What a policy asks for on particles; nothing if it does not say.
template <class P> using on_particles_t = typename detail::on_particles<P>::type;
/// What a policy asks for on nodes; nothing if it does not say.
template <class P> using on_nodes_t = typename detail::on_nodes<P>::type;

}  // namespace tamis
