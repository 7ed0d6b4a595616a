#pragma once
#include <tamis/core/error.hpp>

#include <algorithm>
#include <array>
#include <string_view>

namespace tamis {

namespace detail {

enum class held_by { increments, lumped, velocity, combined, unlumped1, unlumped2, partial, collected };
/// Their names, in that order.
inline constexpr std::array<std::string_view, 8> method_names{"incremental", "lumped",    "velocity", "combined",
                                                              "unlumped1",   "unlumped2", "partial",  "collected"};

/// Is the condition imposed on the lumped momentum, before the mass matrix acts?
constexpr bool on_momentum(held_by how) {
    return how == held_by::increments || how == held_by::lumped || how == held_by::combined;
}
/// Does it need columns of the mass matrix's inverse?
constexpr bool by_columns(held_by how) { return how == held_by::partial || how == held_by::collected; }
/// Does it ask what the lumped velocity lacks, after the mass matrix has acted?
constexpr bool on_lumped(held_by how) { return how == held_by::unlumped1 || how == held_by::partial; }

template <held_by How> struct fixed_method {
    static constexpr held_by how = How;
    static constexpr std::string_view name = method_names[static_cast<std::size_t>(How)];
};
/// Is the method known when compiling, and is it How?
template <class Method> inline constexpr bool is_fixed = requires { std::bool_constant<Method::how == Method::how>{}; };
template <class Method, held_by How> constexpr bool is_always() {
    if constexpr (is_fixed<Method>)
        return Method::how == How;
    else
        return false;
}

}  // namespace detail

/// How a condition v.n = b of a node enters a full mass matrix, FMPM(k) (docs/method.md, Boundary conditions). With a
/// lumped one they are all the same, and only `incremental` can be named. p* is the momentum that no condition has
/// touched, m the lumped mass, M~ = S^T M S, M~_k^-1 the inverse by k terms; "held" means: on held components, 0
/// elsewhere.
///
///     solver mpm{grid, fmpm<4>{}, ends, boundary_method::collected{}};
namespace boundary_method {

/// Lumped momentum takes the value, held components of every further term are zero (Nairn's notes of 2026). The value
/// is held exactly; for k to infinity this is the least-squares solution under the conditions. The default.
struct incremental : detail::fixed_method<detail::held_by::increments> {};
/// Held p+ = m b, and nothing else: v = M~_k^-1 p+ misses b for k > 1.
struct lumped : detail::fixed_method<detail::held_by::lumped> {};
/// v = M~_k^-1 p*; then held v = b.
struct velocity : detail::fixed_method<detail::held_by::velocity> {};
/// First `lumped`, then `velocity`.
struct combined : detail::fixed_method<detail::held_by::combined> {};
/// p+ = p* + M~ (b - m^-1 p*) held.
struct unlumped1 : detail::fixed_method<detail::held_by::unlumped1> {};
/// p+ = p* + M~ (b - M~_k^-1 p*) held.
struct unlumped2 : detail::fixed_method<detail::held_by::unlumped2> {};
/// Node by node, with the inverse's diagonal and the lumped right side: p+ = p* + (b - m^-1 p*)/(M~_k^-1)_ii held.
struct partial : detail::fixed_method<detail::held_by::partial> {};
/// All held nodes together: p+ = p* + j with [M~_k^-1] j = b - M~_k^-1 p* on held components. Holds the value exactly;
/// a sweep and a row of the system for each held node, so dear where walls are long.
struct collected : detail::fixed_method<detail::held_by::collected> {};

/// One of these, by its name, chosen at run time. Throws `error` if there is none of that name.
struct chosen {
    static constexpr std::string_view name = "chosen";
    /// What the name stands for.
    detail::held_by how;
    /// By name, "incremental", "lumped", ...; throws `error` for a name that is none.
    explicit chosen(std::string_view method) : how(named(method)) {}

  private:
    static detail::held_by named(std::string_view method) {
        const auto& names = detail::method_names;
        const auto found = std::find(names.begin(), names.end(), method);
        if (found == names.end())
            throw error(detail::sentence("boundary_method::chosen: there is no method \"", method,
                                         "\"; give incremental, lumped, velocity, combined, unlumped1, unlumped2, "
                                         "partial or collected"));
        return static_cast<detail::held_by>(found - names.begin());
    }
};

}  // namespace boundary_method
}  // namespace tamis
