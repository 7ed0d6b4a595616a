#pragma once
#include <tamis/material/linear_elastic.hpp>
#include <tamis/run/solver.hpp>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace tamis::stability {

/// Which particle of a set, counted as they were given.
struct particle_number : scalar_field {
    static constexpr std::string_view name = "particle_number";
};
/// Values of a particle that a step of small waves changes: velocities, then stresses, those of the diagonal first.
template <int Dim> inline constexpr int values_of = Dim + Dim*(Dim + 1) / 2;

namespace detail {

template <int Dim, class Particle> auto& value_of(const Particle& p, int value) {
    if (value < Dim) return p[symbols::v][value];
    if (value < 2 * Dim) return p[symbols::sigma](value - Dim, value - Dim);
    const int pair = value - 2 * Dim;  // xy, xz, yz
    return p[symbols::sigma](pair == 2 ? 1 : 0, pair == 0 ? 1 : 2);
}

}  // namespace detail

/// What a step makes of unit values: columns for the values of `count` particles from the `first` on, rows for the
/// values of all. For held particles and Hooke's law a step is linear in them, so these are its matrix's columns
/// exactly; that of moving ones is the same around a body at rest without stress (tests/unit/stability). P waves have
/// speed 1, density is 1, nodes are 1 apart in a box of `cells` per axis without conditions.
template <int Dim, class... Policies> Eigen::MatrixXd responses(const std::vector<point<Dim, double>>& places,
                                                                double volume, int cells, double poisson, int first,
                                                                int count, double dt, const Policies&... policies) {
    const double nu = poisson;
    const linear_elastic law{.young = Dim == 1 ? 1 : (1 + nu) * (1 - 2 * nu) / (1 - nu), .poisson = nu, .density = 1};
    double lower[Dim], upper[Dim];
    for (int d = 0; d < Dim; ++d) lower[d] = 0, upper[d] = cells;
    solver mpm{uniform_grid<Dim, double>{lower, upper, 1.}, policies..., held{}, one_lane{}};
    auto body = mpm.make_body_at(law, places, volume, fields<particle_number>{});
    // Stored in another order than they were given.
    const auto key = [](const point<Dim, double>& at) {
        std::array<long, Dim> rounded;
        for (int d = 0; d < Dim; ++d) rounded[static_cast<std::size_t>(d)] = std::lround(at[d] * 1e7);
        return rounded;
    };
    std::map<std::array<long, Dim>, double> numbers;
    for (const auto& at : places) numbers.emplace(key(at), static_cast<double>(numbers.size()));
    for (auto p : body) p[particle_number{}] = numbers.at(key(p[symbols::x]));
    constexpr int values = values_of<Dim>;
    Eigen::MatrixXd columns(static_cast<Eigen::Index>(places.size()) * values, count * values);
    for (int column = 0; column < count * values; ++column) {
        for (auto p : body) {
            const int number = static_cast<int>(p[particle_number{}]);
            for (int value = 0; value < values; ++value)
                detail::value_of<Dim>(p, value) = number == first + column / values && value == column % values ? 1 : 0;
        }
        mpm.step(bodies(body), dt);
        for (auto p : body) {
            const int number = static_cast<int>(p[particle_number{}]);
            for (int value = 0; value < values; ++value)
                columns(number * values + value, column) = detail::value_of<Dim>(p, value);
        }
    }
    return columns;
}

}  // namespace tamis::stability
