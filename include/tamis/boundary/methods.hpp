#pragma once
#include <tamis/core/error.hpp>

#include <array>
#include <string_view>

namespace tamis {

namespace detail {

enum class held_by {
    increments,
    lumped,
    velocity,
    combined,
    unlumped1,
    unlumped2,
    partial,
    collected,
    chosen_at_run_time
};

/// Is the condition imposed on the lumped momentum, before the mass matrix acts?
constexpr bool on_momentum(held_by how) {
    return how == held_by::increments || how == held_by::lumped || how == held_by::combined;
}
/// Does it need columns of the mass matrix's inverse?
constexpr bool by_columns(held_by how) { return how == held_by::partial || how == held_by::collected; }

}  // namespace detail

/// How a condition v.n = b of a node enters a full mass matrix, FMPM(k) (numerics.md, section 6). With a lumped one
/// they are all the same, and only `incremental` can be named. p* is the momentum that no condition has touched, m the
/// lumped mass, M~ = S^T M S, M~_k^-1 the inverse by k terms; "held" means: on held components, 0 elsewhere.
///
///     solver mpm{grid, fmpm<4>{}, ends, boundary_method::collected{}};
namespace boundary_method {

/// Lumped momentum takes the value, held components of every further term are zero (Nairn's notes of 2026). The value
/// is held exactly; for k to infinity this is the least-squares solution under the conditions. The default.
struct incremental {
    static constexpr std::string_view name = "incremental";
    static constexpr auto how = detail::held_by::increments;
};
/// Held p+ = m b, and nothing else: v = M~_k^-1 p+ misses b for k > 1.
struct lumped {
    static constexpr std::string_view name = "lumped";
    static constexpr auto how = detail::held_by::lumped;
};
/// v = M~_k^-1 p*; then held v = b.
struct velocity {
    static constexpr std::string_view name = "velocity";
    static constexpr auto how = detail::held_by::velocity;
};
/// First `lumped`, then `velocity`.
struct combined {
    static constexpr std::string_view name = "combined";
    static constexpr auto how = detail::held_by::combined;
};
/// p+ = p* + M~ (b - m^-1 p*) held.
struct unlumped1 {
    static constexpr std::string_view name = "unlumped1";
    static constexpr auto how = detail::held_by::unlumped1;
};
/// p+ = p* + M~ (b - M~_k^-1 p*) held.
struct unlumped2 {
    static constexpr std::string_view name = "unlumped2";
    static constexpr auto how = detail::held_by::unlumped2;
};
/// Node by node, with the inverse's diagonal and the lumped right side: p+ = p* + (b - m^-1 p*)/(M~_k^-1)_ii held.
struct partial {
    static constexpr std::string_view name = "partial";
    static constexpr auto how = detail::held_by::partial;
};
/// All held nodes together: p+ = p* + j with [M~_k^-1] j = b - M~_k^-1 p* on held components. Holds the value exactly;
/// a sweep and a row of the system for each held node, so dear where walls are long.
struct collected {
    static constexpr std::string_view name = "collected";
    static constexpr auto how = detail::held_by::collected;
};

/// One of these, by its name, chosen at run time. Throws `error` if there is none of that name.
class chosen {
  public:
    static constexpr std::string_view name = "chosen";
    static constexpr auto how = detail::held_by::chosen_at_run_time;
    explicit chosen(std::string_view method) {
        constexpr std::array names{incremental::name, lumped::name,    velocity::name, combined::name,
                                   unlumped1::name,   unlumped2::name, partial::name,  collected::name};
        for (std::size_t k = 0; k < names.size(); ++k)
            if (names[k] == method) {
                now_ = static_cast<detail::held_by>(k);
                return;
            }
        throw error(detail::sentence("boundary_method::chosen: there is no method \"", method,
                                     "\"; give incremental, lumped, velocity, combined, unlumped1, unlumped2, partial "
                                     "or collected"));
    }
    detail::held_by now() const { return now_; }

  private:
    detail::held_by now_ = detail::held_by::increments;
};

}  // namespace boundary_method

namespace detail {

/// The method of a policy, known now.
template <class Method> constexpr held_by method_of(const Method& method) {
    if constexpr (Method::how == held_by::chosen_at_run_time)
        return method.now();
    else
        return Method::how;
}

}  // namespace detail
}  // namespace tamis
