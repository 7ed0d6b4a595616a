#pragma once
#include <tamis/core/lanes.hpp>
#include <tamis/core/space.hpp>

#include <array>
#include <cstddef>

namespace tamis {

/// A node that conditions hold, with what they added in the last step.
template <int Dim, class Real> struct held_node {
    /// Where the node is (m).
    point<Dim, Real> at;
    /// Force of the conditions on the node (N), mean over the step: the sum over nodes balances the particles'
    /// momentum.
    point<Dim, Real> reaction;
    /// Held velocity at the end of the step (free directions: 0).
    point<Dim, Real> velocity;
};

namespace detail {

/// What is kept of a held node: its place in storage, the directions that are held and their values, and what a step
/// needs to know of it later.
template <int D, class real> struct held_entry {
    using vector = point<D, real>;
    using values = std::array<real, static_cast<std::size_t>(D)>;

    std::size_t place;
    int directions = 0;
    std::array<vector, static_cast<std::size_t>(D)> normal{};  // orthonormal
    std::array<values, static_cast<std::size_t>(D)> map{};     // normal = map * given
    std::array<int, static_cast<std::size_t>(D)> source{};     // which of the given normals
    values value{}, start_value{};
    real mass{};
    vector momentum = vector::Zero();  // that the step's start left
    vector before = vector::Zero(), lumped = vector::Zero();
    int row = -1;  // of the mass matrix's inverse
    held_node<D, real> node;

    template <class Mass, class Nodes> void take_mass(const Nodes& nodes) {
        mass = nodes.template at<Mass>(place);
        if (!(mass > real(0)) || mass < least_mass<real>()) mass = real(0);
    }
    /// What a velocity's held components lack.
    vector missing(const vector& u) const {
        vector change = vector::Zero();
        for (int k = 0; k < D && k < directions; ++k) {
            const auto i = static_cast<std::size_t>(k);
            change += (value[i] - normal[i].dot(u)) * normal[i];
        }
        return change;
    }
};

}  // namespace detail
}  // namespace tamis
