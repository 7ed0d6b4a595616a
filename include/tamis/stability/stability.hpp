#pragma once
#include <tamis/core/error.hpp>
#include <tamis/material/linear_elastic.hpp>
#include <tamis/run/solver.hpp>
#include <tamis/stability/dual.hpp>
#include <tamis/stability/responses.hpp>
#include <tamis/stability/step_matrix.hpp>

#include <array>
#include <vector>

/// Linear stability of a composition, from the composition itself: the exact Jacobian of one step of an elastic bar.
namespace tamis::stability {

/// A bar of unit modulus and density on a grid of spacing 1, at rest and without stress.
struct bar {
    /// Cells of the bar, and particles per cell.
    int cells = 8, per_cell = 2;
    /// Where its first particles' cell begins, in cells from a node, 0 to 1: only for free ends.
    double offset = 0;
    /// Free at both ends, with empty cells beyond; else fixed, and filling the grid.
    bool free = false;
};

namespace detail {

inline void check(const bar& set) {
    if (set.cells < 1 || set.cells > 1000 || set.per_cell < 1 || set.per_cell > 100)
        throw error(tamis::detail::sentence("stability::bar: ", set.cells, " cells of ", set.per_cell,
                                            " particles; give 1 to 1000 cells and 1 to 100 particles"));
    if (!(set.offset >= 0 && set.offset <= 1) || (set.offset > 0 && !set.free))
        throw error(tamis::detail::sentence("stability::bar: the offset is ", set.offset,
                                            "; give one from 0 to 1 for free ends, 0 for fixed ones"));
}

template <class Real, class... Policies> auto solver_of(const bar& set, const Policies&... policies) {
    const int margin = set.free ? 4 : 0, last = set.cells + 2 * margin;
    const bool is_free = set.free;
    const auto held_there = [=](const auto& at) { return !is_free && (at[0] <= 0 || at[0] >= last); };
    return solver{uniform_grid{{Real(0)}, {Real(last)}, Real(1)}, policies..., fixed{held_there}, one_lane{}};
}

}  // namespace detail

/// Jacobian of a step of `dt` (s; as c = h = 1, the Courant number) by the velocities and stresses of the particles, in
/// that order: the state after the step by the state before. Positions play no part: where there is neither velocity
/// nor stress a step does not depend on them. Policies are those of `solver`, without grid, boundary and lanes.
template <class... Policies> Eigen::MatrixXd jacobian(const bar& set, double dt, const Policies&... policies) {
    using namespace symbols;
    constexpr int batch = 8;
    using real = dual<batch>;
    detail::check(set);
    const int count = set.cells * set.per_cell, size = 2 * count;
    const double side = 1. / set.per_cell, first = set.free ? 4 + set.offset : 0;
    std::vector<point<1, real>> places;
    for (int p = 0; p < count; ++p) places.push_back(point<1, real>(real(first + (p + 0.5) * side)));
    const linear_elastic law{.young = 1, .poisson = 0, .density = 1};

    Eigen::MatrixXd J(size, size);
    for (int start = 0; start < size; start += batch) {
        auto mpm = detail::solver_of<real>(set, policies...);
        auto body = mpm.make_body_at(law, places, real(side), fields<particle_number>{});
        int number = 0;
        for (auto p : body) {
            p[particle_number{}] = real(number);
            real velocity(0), stress(0);
            if (number >= start && number < start + batch) velocity.by[static_cast<std::size_t>(number - start)] = 1;
            const int column = count + number - start;
            if (column >= 0 && column < batch) stress.by[static_cast<std::size_t>(column)] = 1;
            p[v][0] = velocity;
            p[sigma](0, 0) = stress;
            ++number;
        }
        mpm.step(bodies(body), real(dt));
        for (const auto p : std::as_const(body)) {
            const auto row = static_cast<int>(p[particle_number{}]);
            const real velocity = p[v][0], stress = p[sigma](0, 0);
            for (int k = 0; k < batch && start + k < size; ++k) {
                J(row, start + k) = velocity.by[static_cast<std::size_t>(k)];
                J(count + row, start + k) = stress.by[static_cast<std::size_t>(k)];
            }
        }
    }
    return J;
}

/// The Jacobian for every time step.
template <class... Policies> step_matrix<Eigen::MatrixXd> step_of(const bar& set, const Policies&... policies) {
    using matrix = step_matrix<Eigen::MatrixXd>;
    std::array<Eigen::MatrixXd, matrix::samples> at;
    for (int k = 0; k < matrix::samples; ++k)
        at[static_cast<std::size_t>(k)] = jacobian(set, matrix::sample(k), policies...);
    return matrix(at);
}

/// Largest magnitude of the Jacobian's eigenvalues: what a disturbance of the worst shape is multiplied by in a step.
template <class... Policies> double spectral_radius(const bar& set, double courant, const Policies&... policies) {
    return spectral_radius_of([&](double dt) { return jacobian(set, dt, policies...); }, courant);
}

/// The Courant number up to which no disturbance grows: the first at which one does by more than `tolerance` a step is
/// looked for in steps of 1/50, then by bisection to 1e-4; `most` if there is none up to it. Disturbances that a
/// composition does not touch have eigenvalues of 1, which round-off moves by up to 1e-5 where three fall together:
/// what counts is growth that is still there at slightly larger numbers.
template <class... Policies>
double critical_courant(const bar& set, double most, double tolerance, const Policies&... policies) {
    const auto step = step_of(set, policies...);
    return first_unstable(most, 0.02,
                          [&](double courant) { return spectral_radius_of(step, courant) <= 1 + tolerance; });
}

}  // namespace tamis::stability
