#pragma once

/// What compare.hpp declares; to be included by one source file of a program.

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "../reference/dense.hpp"
#include "compare.hpp"

namespace compare {

namespace {

/// Infinite if one of the numbers is none.
double largest(const Eigen::MatrixXd& of) {
    double most = 0;
    for (Eigen::Index k = 0; k < of.size(); ++k) {
        if (!std::isfinite(of.data()[k])) return std::numeric_limits<double>::infinity();
        most = std::max(most, std::abs(of.data()[k]));
    }
    return most;
}

/// Stresses of all particles, one in each row.
Eigen::MatrixXd stresses(const reference::state& state) {
    const Eigen::Index dimension = state.x.cols();
    Eigen::MatrixXd all(state.size(), dimension * dimension);
    for (Eigen::Index k = 0; k < all.rows(); ++k)
        for (Eigen::Index c = 0; c < all.cols(); ++c)
            all(k, c) = state.stress[static_cast<std::size_t>(k)](c / dimension, c % dimension);
    return all;
}

}  // namespace

struct reference_run::data {
    reference::scene set;
    reference::state state;
    std::vector<Eigen::Index> held;  ///< nodes that conditions hold

    int steps = 0;
    double time = 0;
    Eigen::MatrixXd reactions;
    double last_increment = 0;
    std::vector<bool> claimed;
    Eigen::MatrixXd x, v, stress;  ///< found by the library
    std::vector<std::pair<three, three>> found_reactions;

    /// Largest value and difference so far.
    struct extent {
        double size = 0;
        double difference = 0;
    };
    extent position, velocity, tension, reaction;
    deviations result;

    data(const reference::scene& the_set, const reference::state& start)
        : set(the_set), state(start), time(the_set.start_time), claimed(static_cast<std::size_t>(start.size()), false) {
        for (Eigen::Index i = 0; i < set.node_count(); ++i) {
            const Eigen::VectorXd at = set.node_position(i);
            const bool is_held = std::any_of(set.conditions.begin(), set.conditions.end(),
                                             [&](const reference::condition& rule) { return rule.holds(at); });
            if (is_held) held.push_back(i);
        }
        forget();
    }

    /// A particle that is not found differs by more than any number.
    void forget() {
        const double none = std::numeric_limits<double>::quiet_NaN();
        const Eigen::Index count = state.size(), dimension = set.dimension();
        x = Eigen::MatrixXd::Constant(count, dimension, none);
        v = x;
        stress = Eigen::MatrixXd::Constant(count, dimension * dimension, none);
    }

    static void compare(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, extent& so_far, double& worst) {
        so_far.size = std::max(so_far.size, largest(expected));
        so_far.difference = std::max(so_far.difference, largest(found - expected));
        if (!std::isfinite(so_far.size) || !std::isfinite(so_far.difference))
            worst = std::numeric_limits<double>::infinity();
        else if (so_far.difference > 0)
            worst = std::max(worst, so_far.difference / so_far.size);
    }
};

reference_run::reference_run(const reference::scene& set, const reference::state& start)
    : data_(std::make_unique<data>(set, start)) {}
reference_run::~reference_run() = default;

std::size_t reference_run::size() const { return data_->claimed.size(); }

std::pair<std::size_t, particle_values> reference_run::claim(const three& at, double mass, double volume,
                                                             double precision) {
    const reference::state& state = data_->state;
    const Eigen::Index dimension = data_->set.dimension();
    const Eigen::RowVectorXd place = Eigen::Map<const Eigen::RowVectorXd>(at.data(), dimension);
    Eigen::Index k = 0;
    const double distance = std::sqrt((state.x.rowwise() - place).rowwise().squaredNorm().minCoeff(&k));
    const auto number = static_cast<std::size_t>(k);
    if (distance > precision || std::abs(mass / state.mass[k] - 1) > precision ||
        std::abs(volume / state.volume[k] - 1) > precision || data_->claimed[number])
        throw std::logic_error("compare: the body and the reference start with different particles.");
    data_->claimed[number] = true;
    particle_values values;
    values.x = at;
    for (Eigen::Index d = 0; d < dimension; ++d) {
        values.v[static_cast<std::size_t>(d)] = state.v(k, d);
        for (Eigen::Index e = 0; e < dimension; ++e)
            values.stress[static_cast<std::size_t>(d * dimension + e)] = state.stress[number](d, e);
    }
    return {number, values};
}

void reference_run::step(double dt) {
    const reference::step_result told = reference::advance(data_->set, data_->state, data_->time, dt);
    data_->reactions = told.reactions;
    data_->last_increment = told.last_increment;
    ++data_->steps;
    data_->time = data_->set.start_time + data_->steps * dt;
}

double reference_run::last_increment() const { return data_->last_increment; }

void reference_run::found(std::size_t number, const particle_values& values) {
    const auto k = static_cast<Eigen::Index>(number);
    const Eigen::Index dimension = data_->set.dimension();
    for (Eigen::Index d = 0; d < dimension; ++d) {
        data_->x(k, d) = values.x[static_cast<std::size_t>(d)];
        data_->v(k, d) = values.v[static_cast<std::size_t>(d)];
    }
    for (Eigen::Index c = 0; c < dimension * dimension; ++c)
        data_->stress(k, c) = values.stress[static_cast<std::size_t>(c)];
}

void reference_run::compare_particles() {
    const reference::state& state = data_->state;
    data::compare(data_->x, state.x, data_->position, data_->result.position);
    data::compare(data_->v, state.v, data_->velocity, data_->result.velocity);
    data::compare(data_->stress, stresses(state), data_->tension, data_->result.stress);
    data_->forget();
}

void reference_run::found_reaction(const three& at, const three& reaction) {
    data_->found_reactions.emplace_back(at, reaction);
}

void reference_run::compare_reactions() {
    const Eigen::Index dimension = data_->set.dimension();
    bool same_nodes = data_->found_reactions.size() == data_->held.size();
    Eigen::MatrixXd found(data_->found_reactions.size(), dimension), expected = found;
    for (std::size_t n = 0; same_nodes && n < data_->held.size(); ++n) {
        const auto& [at, reaction] = data_->found_reactions[n];
        const Eigen::VectorXd place = data_->set.node_position(data_->held[n]);
        for (Eigen::Index d = 0; d < dimension; ++d) {
            if (std::abs(at[static_cast<std::size_t>(d)] - place[d]) > data_->set.spacing / 100) same_nodes = false;
            found(static_cast<Eigen::Index>(n), d) = reaction[static_cast<std::size_t>(d)];
            expected(static_cast<Eigen::Index>(n), d) = data_->reactions(data_->held[n], d);
        }
    }
    if (!same_nodes) throw std::logic_error("compare: the library and the reference hold different nodes.");
    data::compare(found, expected, data_->reaction, data_->result.reaction);
    data_->found_reactions.clear();
}

const deviations& reference_run::result() const { return data_->result; }

double growth(const reference::scene& set, const reference::state& start, double dt, int steps) {
    const double small = 1e-9;
    reference::state body = start;
    reference::state other = start;
    for (Eigen::Index p = 0; p < other.size(); ++p)
        for (Eigen::Index d = 0; d < other.x.cols(); ++d) {
            const auto k = static_cast<double>(p + 3 * d);
            other.x(p, d) += small * set.spacing * std::cos(23 * k);
            other.v(p, d) *= 1 + small * std::sin(17 * k);
        }
    double most = 0;
    for (int n = 0; n < steps; ++n) {
        const double t = set.start_time + n * dt;
        reference::step(set, body, t, dt);
        reference::step(set, other, t, dt);
        const double now = std::max(largest(other.v - body.v) / largest(body.v),
                                    largest(stresses(other) - stresses(body)) / largest(stresses(body)));
        if (!std::isfinite(now)) return std::numeric_limits<double>::infinity();
        most = std::max(most, now);
    }
    return most / small;
}

}  // namespace compare
