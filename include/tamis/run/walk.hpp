#pragma once
#include <tamis/run/body.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace tamis {

/// What kind of value a field has: a number, a vector, a tensor, a symmetric one, or numbers that are none of these.
enum class field_kind { scalar, vector, tensor, symmetric, other };

namespace detail {

/// What is of no use between steps, or stands first.
template <class F> inline constexpr bool is_not_walked =
    std::same_as<F, field::position> || std::same_as<F, field::step_displacement>;
template <class Shape> inline constexpr bool is_not_walked<held_weights<Shape>> = true;

template <class Found, class List> struct walk_list { using type = Found; };
template <class... Found, class F, class... Rest> struct walk_list<fields<Found...>, fields<F, Rest...>>
    : walk_list<std::conditional_t<is_not_walked<F>, fields<Found...>, fields<Found..., F>>, fields<Rest...>> {};

template <class F> constexpr field_kind kind_of() {
    if (std::is_base_of_v<scalar_field, F>) return field_kind::scalar;
    if (std::is_base_of_v<vector_field, F>) return field_kind::vector;
    if (std::is_base_of_v<tensor_field, F>) return field_kind::tensor;
    if (std::is_base_of_v<symmetric_field, F>) return field_kind::symmetric;
    return field_kind::other;
}

/// Row and column of component c of a tensor of so many rows, of which symmetric ones have only the upper half,
/// diagonal first.
constexpr std::array<int, 2> place_in_tensor(field_kind kind, int rows, int c) {
    if (kind == field_kind::tensor) return {c / rows, c % rows};
    for (int d = 0; d < rows; ++d)
        for (int e = d; e < rows; ++e)
            if (packed(rows, d, e) == c) return {d, e};
    return {0, 0};
}

/// Units of fields are given for any number of dimensions: "kg/m^Dim" is "kg/m^2" in 2D.
inline std::string unit_in(std::string_view unit, int dim) {
    constexpr std::string_view any = "^Dim";
    std::string text(unit);
    const std::size_t at = text.find(any);
    if (at != std::string::npos) text.replace(at, any.size(), dim == 1 ? "" : "^" + std::to_string(dim));
    return text;
}

}  // namespace detail

/// A field as the walk over a body's fields shows it: what it is called, what it has, and its values.
template <class Body, class F> struct stored_field {
    /// The field.
    using field_type = F;
    /// Type of its numbers.
    using real = typename Body::real;
    /// Number of dimensions.
    static constexpr int dim = Body::dim;
    static constexpr std::string_view name = F::name;
    /// What kind of value it has.
    static constexpr field_kind kind = detail::kind_of<F>();
    /// How many numbers that is.
    static constexpr int components = F::template components<space<dim, real>>;
    /// Rows of a tensor.
    static constexpr int rows = std::is_base_of_v<symmetric_3x3_field, F> ? 3 : dim;

    /// As the field says, "kg/m^2"; empty if it says nothing.
    static std::string unit() {
        if constexpr (requires { F::unit; })
            return detail::unit_in(F::unit, dim);
        else
            return {};
    }
    /// "x", "y", "z" of a vector; "xx", "xy", ... of a tensor, row by row, of a symmetric one the diagonal first ("xx",
    /// "yy", "zz", "xy", "xz", "yz"); "0", "1", ... of other numbers; empty where there is but one.
    static std::string component(int c) {
        constexpr std::string_view axes = "xyz";
        if (components == 1) return {};
        if (kind == field_kind::other) return std::to_string(c);
        if (kind == field_kind::vector) return std::string(1, axes[static_cast<std::size_t>(c)]);
        const auto [row, column] = detail::place_in_tensor(kind, rows, c);
        return {axes[static_cast<std::size_t>(row)], axes[static_cast<std::size_t>(column)]};
    }
    /// The name of a column of a table: "velocity_x", "mass".
    static std::string column(int c) {
        const std::string which = component(c);
        return which.empty() ? std::string(name) : std::string(name) + '_' + which;
    }
    /// The values that a particle has.
    template <class Particle> static std::array<real, static_cast<std::size_t>(components)> values(const Particle& p) {
        const auto& seen = p[F{}];
        std::array<real, static_cast<std::size_t>(components)> all;
        for (int c = 0; c < components; ++c) {
            real& to = all[static_cast<std::size_t>(c)];
            if constexpr (kind == field_kind::scalar)
                to = seen;
            else if constexpr (kind == field_kind::vector)
                to = seen[c];
            else if constexpr (kind == field_kind::other)
                to = seen[c * Body::space_type::width];
            else {
                const auto [row, column] = detail::place_in_tensor(kind, rows, c);
                to = seen(row, column);
            }
        }
        return all;
    }
};

/// The fields that the walk over a body shows, in its order: the position, also where particles are held and keep
/// weights in its place, then all others that the body stores, in the order of storage; not the way of a step, which
/// means nothing after it.
template <class Body> using stored_fields =
    typename detail::walk_list<fields<field::position>, typename Body::field_list>::type;

/// A walk over the fields that a body stores, those of one's own too: f(stored_field) for each.
///
///     each_stored_field(bar, [&](auto field) {
///         std::printf("%s has %d numbers", field.name.data(), field.components);
///         for (const auto p : std::as_const(bar)) std::printf(" %g", field.values(p)[0]);
///     });
template <class Body, class F> void each_stored_field(const Body&, F&& f) {
    detail::each_field<stored_fields<Body>>::run(
        [&](auto tag) { f(stored_field<Body, typename decltype(tag)::type>{}); });
}

}  // namespace tamis
