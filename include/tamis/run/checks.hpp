#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/run/body.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>

namespace tamis {

template <class Grid, class... Policies> class solver;
/// What begins with something else than a grid.
template <class First, class... Policies>
requires(!detail::GridOfCells<First>) class solver<First, Policies...> {
    static_assert(sizeof(First) == 0,
                  "tamis: the first argument of solver{...} is the grid, the policies come after it in any order: "
                  "solver{uniform_grid{lower, upper, spacing}, linear{}, flip{}}");

  public:
    /// Never made.
    explicit solver(const First&, const Policies&...) {}
};

namespace detail {

inline void check_step(double dt, double time, double end) {
    if (!(dt > 0 && std::isfinite(dt)))
        throw error(sentence("step: the time step is ", dt, "; give a positive, finite number"));
    if (!(end > time && std::isfinite(end)))
        throw error(sentence("step: it would end at t = ", end, ", and the time is ", time,
                             " already; give a later, finite end, or a longer step"));
}

/// No body may be given twice.
template <std::size_t N> void check_different(const std::array<const void*, N>& places) {
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (places[i] == places[j]) throw error("step: the same body is given twice; name each body once");
}

/// Particles that a user could have changed must still make sense.
template <class Body, class Grid> void check_particles(const Body& b, const Grid& grid, long steps, double time) {
    using namespace symbols;
    using real = typename Body::real;
    if (b.moved_from())
        throw error(
            "step: a body has no particles, for it was moved from; step the body that it was moved to, or assign one "
            "to "
            "it");
    const auto& other = b.lattice().grid();
    bool same = other.lower() == grid.lower() && other.upper() == grid.upper();
    for (int d = 0; d < Body::dim; ++d)
        same = same && other.cells(d) == grid.cells(d) && other.wraps(d) == grid.wraps(d);
    if (!same) throw error("step: a body was made on another grid; make it with this solver's make_body");
    long k = 0;
    for (const auto p : b) {
        const auto bad = [&](const std::string& why) {
            return error(
                sentence("particle ", k, " at (", list_of(p[x]), "), step ", steps, ", t = ", time, ": ", why));
        };
        const auto usable = [](const real& number) { return number > real(0) && number - number == real(0); };
        if (!usable(p[m])) throw bad(sentence("its mass is ", p[m], "; give a positive density"));
        if (!usable(p[V])) throw bad(sentence("its volume is ", p[V], "; give a positive, finite number"));
        for (int d = 0; d < Body::dim; ++d)
            if (p[v][d] - p[v][d] != real(0)) throw bad("its velocity is not finite; check the initial velocity");
        if constexpr (requires { b.law.check(p); }) {
            try {
                b.law.check(p);
            } catch (const error& e) {
                throw bad(e.what());
            }
        }
        ++k;
    }
}

/// Throws if a particle's velocity or stress is not a number, or if its law refuses it.
template <class... Body> void check_finite(const std::tuple<Body&...>& all, long steps, double time, double dt) {
    const auto one = [&](const auto& body) {
        long k = 0;
        for (const auto p : body) {
            const double sum = detail::to_double(p[symbols::v].sum() + p[symbols::sigma].sum());
            std::string why;
            if constexpr (requires { body.law.check(p); }) {
                try {
                    body.law.check(p);
                } catch (const error& e) {
                    why = e.what();
                }
            }
            using type = std::remove_cvref_t<decltype(body)>;
            if constexpr (keeps_first_place<typename type::field_list>) {
                const double J = to_double(determinant(matrix<type::dim, typename type::real>(p[symbols::F])));
                if (!(J > 0) && why.empty())
                    why = sentence("it is turned inside out (det F = ", J,
                                   "). Likely causes: a time step too long for its strain (dt = ", dt,
                                   "), or a load that crushes it");
            }
            if (!std::isfinite(sum))
                why = sentence(
                    "its velocity or stress is not a number. Likely causes: a time step above the stability "
                    "limit (dt = ",
                    dt, "), or a law that returned one", why.empty() ? "" : ". Its law says: ", why);
            if (!why.empty())
                throw error(sentence("particle ", k, " at (", list_of(p[symbols::x]), "), step ", steps, ", t = ", time,
                                     ": ", why));
            ++k;
        }
    };
    detail::each_of(all, one);
}

}  // namespace detail
}  // namespace tamis
