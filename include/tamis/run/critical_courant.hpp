#pragma once
#include <tamis/core/error.hpp>
#include <tamis/shape/gimp.hpp>
#include <tamis/step/composition.hpp>
#include <tamis/run/critical_table.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

namespace tamis {

class adaptive_mass;
namespace detail {
template <int K> struct periodic_mass;
struct periodic_update;
}  // namespace detail

/// Courant numbers c dt/h up to which small waves in a body at rest do not grow (docs/stability.md).
struct critical_courant {
    /// Inside a body and between held ends, at the worst place of the particles in their cells.
    double inner;
    /// Where a body ends free, if the lightest node there has the given share of an inner node's mass.
    double free_end(double share) const {
        return falls_with_mass ? std::min(inner, at_free_end * std::sqrt(share / detail::critical_share)) : at_free_end;
    }
    /// Where a body ends free, by the least light node of the table.
    double at_free_end;
    /// Does the number of free ends fall with the root of the lightest node's mass? Else it is that of the worst place.
    bool falls_with_mass;
};

namespace detail {

/// The number of waves along an axis bounds the step in two and three dimensions too; but with one particle per cell,
/// near its corner, waves along the diagonal of a cube do, by the root of 2/3 (docs/stability.md).
inline double critical_by_dimension(int dim, double per_cell) { return dim == 3 && per_cell < 1.5 ? 0.816 : 1; }

/// What corners of free bodies have of the number of a bar's end, at least: a pressure there pushes light nodes along
/// all axes at once, and dim lambda + 2 mu answers in place of the lambda + 2 mu of P waves (docs/stability.md). A law
/// without a Poisson's ratio may have no shear modulus.
template <int Dim, class Law> double critical_at_corner(const Law& law) {
    double poisson = 0.5;
    if constexpr (requires { law.poisson; }) poisson = static_cast<double>(law.poisson);
    return Dim == 1 ? 1 : std::sqrt(std::min(1., (1 - poisson) / (1 + (Dim - 2) * poisson)));
}

/// Row of a shape's first composition, -1 if the table does not know it.
template <class Shape> inline constexpr int critical_shape = -1;
template <> inline constexpr int critical_shape<linear> = 0;
template <> inline constexpr int critical_shape<quadratic_spline> = 3 * critical_updates;
template <> inline constexpr int critical_shape<cubic_spline> = 6 * critical_updates;
template <> inline constexpr int critical_shape<ugimp> = 9 * critical_updates;
template <> inline constexpr int critical_shape<cpgimp> = 9 * critical_updates;

/// USL-, USAVG- and those that strain by velocities extrapolated from particles: USL+ and USAVG+ have USF's numbers.
template <class Order> inline constexpr int critical_order = -1;
template <> inline constexpr int critical_order<usl_minus> = 0;
template <> inline constexpr int critical_order<usavg_minus> = 1;
template <> inline constexpr int critical_order<usf> = 2;
template <> inline constexpr int critical_order<usl_plus> = 2;
template <> inline constexpr int critical_order<usavg_plus> = 2;

/// Blends of PIC and FLIP have numbers between those of the two, and steps of FLIP and FMPM(k) by turns grow no faster
/// than either (tests/unit/stability): the smaller of both counts.
enum class critical_family { none, flip, xpic, fmpm, flip_and_fmpm };
template <class Mass, class Update> inline constexpr critical_family critical_family_of = critical_family::none;
template <> inline constexpr critical_family critical_family_of<lumped_mass, tamis::add_acceleration> =
    critical_family::flip;
template <> inline constexpr critical_family critical_family_of<lumped_mass, tamis::add_acceleration_modified> =
    critical_family::flip;
template <> inline constexpr critical_family critical_family_of<lumped_mass, set_velocity> = critical_family::fmpm;
template <int K> inline constexpr critical_family critical_family_of<filtered_mass<K>, set_filtered_velocity> =
    critical_family::xpic;
template <int K> inline constexpr critical_family critical_family_of<full_mass<K>, set_velocity_move_by_mean> =
    critical_family::fmpm;
template <> inline constexpr critical_family critical_family_of<adaptive_mass, set_velocity_move_by_mean> =
    critical_family::fmpm;
template <> inline constexpr critical_family critical_family_of<lumped_mass, blend_velocity> =
    critical_family::flip_and_fmpm;
template <> inline constexpr critical_family critical_family_of<lumped_mass, blend_velocity_graphics> =
    critical_family::flip_and_fmpm;
template <int K> inline constexpr critical_family critical_family_of<periodic_mass<K>, periodic_update> =
    critical_family::flip_and_fmpm;

/// Row of the first order k of `known` that is not below k, and of the one before: numbers in between lie in between.
template <std::size_t N> std::pair<int, int> critical_rows(const int (&known)[N], int k) {
    int at = 0;
    while (at + 1 < static_cast<int>(N) && known[at] < k) ++at;
    return {at, known[at] > k && at > 0 ? at - 1 : at};
}

/// Smaller of two numbers, or of two compositions'.
inline critical_courant smaller(const critical_courant& a, const critical_courant& b) {
    return {std::min(a.inner, b.inner), std::min(a.at_free_end, b.at_free_end), a.falls_with_mass};
}

/// Numbers of a composition with so many particles per cell along an axis; none if the table does not know it.
template <class C> std::optional<critical_courant> critical_of(const typename C::transfer& transfer, double per_cell) {
    constexpr int shape = critical_shape<typename C::shape>, order = critical_order<typename C::order>;
    constexpr critical_family family = critical_family_of<typename C::mass, typename C::update>;
    if constexpr (shape < 0 || order < 0 || family == critical_family::none)
        return std::nullopt;
    else {
        int k = 1;
        if constexpr (requires { transfer.mass.terms(); }) k = transfer.mass.terms();
        const int first = shape + order * critical_updates;
        constexpr int flip_row = 0, first_xpic = 1, first_fmpm = 5;
        std::pair<int, int> rows{flip_row, flip_row};
        if constexpr (family != critical_family::flip) {
            const bool filtered = family == critical_family::xpic && k > 1;
            rows = filtered ? critical_rows(critical_xpic, k) : critical_rows(critical_fmpm, k);
            rows.first += filtered ? first_xpic : first_fmpm;
            rows.second += filtered ? first_xpic : first_fmpm;
        }
        const auto clamp = [](double n) { return std::clamp(static_cast<int>(n), 1, critical_per_cell) - 1; };
        const int low = clamp(std::floor(per_cell + 1e-3)), high = clamp(std::ceil(per_cell - 1e-3));
        // Beyond the table's last order numbers at free ends fall with the root of k.
        constexpr int last = critical_fmpm[std::size(critical_fmpm) - 1];
        const double by = critical_by_dimension(C::dim, per_cell);
        const auto of = [&](int row, int n) {
            const critical_row& r = critical_table[first + row];
            const double more = k > last ? std::sqrt(static_cast<double>(last) / k) : 1;
            return critical_courant{by * r.inner[n] / 1000, by * more * r.free_end[n] / 1000,
                                    shape == 0 && C::order::after > 0 && !C::order::remap};
        };
        const auto of_both = [&](int row) { return smaller(of(row, low), of(row, high)); };
        const critical_courant found = smaller(of_both(rows.first), of_both(rows.second));
        return family == critical_family::flip_and_fmpm ? smaller(found, of_both(flip_row)) : found;
    }
}

/// "linear, fmpm(4), usl-".
template <class C> std::string name_of_composition(const typename C::transfer& transfer) {
    std::string name;
    const auto add = [&](const auto& policy, const char* other) {
        if constexpr (requires { std::string(policy.name); })
            name += std::string(policy.name);
        else
            name += other;
    };
    if constexpr (requires { typename C::shape; }) {
        if constexpr (requires { C::shape::name; })
            name += std::string(C::shape::name);
        else
            name += "own shape";
    }
    name += ", ";
    add(transfer, "own update");
    if constexpr (requires { transfer.mass.terms(); }) name += sentence("(", transfer.mass.terms(), ")");
    name += ", ";
    if constexpr (requires { C::order::name; })
        name += std::string(C::order::name);
    else
        name += "own stress order";
    return name;
}

}  // namespace detail
}  // namespace tamis
