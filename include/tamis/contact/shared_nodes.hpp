#pragma once
#include <tamis/contact/dividing_plane.hpp>
#include <tamis/contact/meetings.hpp>
#include <tamis/contact/particle_clouds.hpp>
#include <tamis/contact/policies.hpp>
#include <tamis/core/execution.hpp>
#include <tamis/engine/node_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace tamis::detail {

enum class contact_state { apart, sticks, slides };

/// A node that two bodies reach, and what contact does there.
template <int D, class real> struct shared_node {
    using vector = point<D, real>;
    std::size_t place = 0;
    std::array<std::size_t, 2> field{};
    std::array<real, 2> mass{};
    real reduced{}, friction{}, heat{};  // friction: tangential over normal impulse
    vector normal = vector::Zero(), tangent = vector::Zero(), force = vector::Zero();
    struct {
        vector impulse = vector::Zero();
        real heat{};
    } of_start;  // impulse at the momentum of the start, or extrapolated last
    vector wanted = vector::Zero(), given = vector::Zero();  // relative velocity without contact, and impulse for it
    contact_state state = contact_state::apart;
    contact_state told = contact_state::apart;  // of the forces, or of the velocity that particles take
};

/// Finds the nodes that two bodies reach, and where they touch (docs/method.md, Contact).
template <class S, class Shape, class Contact> class shared_nodes {
  public:
    using real = typename S::real;
    using vector = point<S::dim, real>;
    using lattice_type = lattice<S, Shape>;
    static constexpr int D = S::dim;

    shared_nodes(const Contact& policy, const lattice_type& lattice) : policy_(policy), lattice_(lattice) {}

    /// Finds the nodes that two fields share; `mass_of(field, place)`.
    template <class Fields, class Mass> void find(const Fields& fields, Mass mass_of) {
        nodes_.clear();
        gathered_ = false;
        constexpr auto W = static_cast<std::size_t>(S::width);
        for (std::size_t b = 1; b < fields.size(); ++b)
            for (std::size_t a = 0; a < b; ++a) {
                shared_.clear();
                const auto &on_a = fields[a]->active(), &on_b = fields[b]->active();
                std::set_intersection(on_a.begin(), on_a.end(), on_b.begin(), on_b.end(), std::back_inserter(shared_));
                for (const std::uint32_t block : shared_)
                    for (std::size_t place = block * W; place < (block + 1) * W; ++place) {
                        entry e;
                        e.mass[0] = mass_of(a, place);
                        e.mass[1] = mass_of(b, place);
                        if (!(e.mass[0] >= least_mass<real>() && e.mass[1] >= least_mass<real>())) continue;
                        e.place = place;
                        e.field = {a, b};
                        e.reduced = e.mass[0] * (e.mass[1] / (e.mass[0] + e.mass[1]));
                        nodes_.push_back(e);
                    }
            }
        if constexpr (Contact::by_given) meetings_.are_of(nodes_);
    }
    bool any() const { return !nodes_.empty(); }
    /// Is it to look at particles, by `gather`?
    bool looks_at_particles() const {
        return any() && (Contact::by_particles || (Contact::by_given && meetings_.any_new()));
    }
    /// Looks at the particles around the shared nodes; each_body(f) calls f(store) for the bodies in their order.
    template <class EachBody> void gather(std::size_t bodies, const EachBody& each_body) {
        clouds_.begin(lattice_, bodies, std::max(nearest, reach_of_normal()));
        for (const entry& e : nodes_) clouds_.attend(lattice_, e.place);
        clouds_.end();
        std::size_t k = 0;
        each_body([&](const auto& store) { clouds_.add(lattice_, k++, store); });
        gathered_ = true;
    }
    /// Normals and distances, where the policy needs them; their node fields are complete now.
    template <class Fields, class Execution = serial>
    void measure(const Fields& fields, [[maybe_unused]] const Execution& run = {}) {
        if constexpr (!Contact::always) {
            const auto set_normal = [&](std::size_t k) {
                entry& e = nodes_[k];
                e.normal = normal_of(e, fields);
                const real length = e.normal.norm();
                if (length > real(0))
                    e.normal /= length;
                else
                    e.normal.setZero();
            };
            // A user's function is not asked by several threads at a time.
            if constexpr (Contact::by_regression)
                run.for_each(nodes_.size(), set_normal);
            else
                serial{}.for_each(nodes_.size(), set_normal);
            if constexpr (Contact::by_given)
                if (gathered_) meetings_.judge(nodes_, [this](const entry& e) { return side(e); });
            std::erase_if(nodes_, [&](const entry& e) { return e.normal.isZero(real(0)) || !near(e, fields); });
        }
    }

  protected:
    using entry = shared_node<D, real>;
    Contact policy_;
    const lattice_type& lattice_;
    std::vector<entry> nodes_;

    void forget_meetings() { meetings_.forget(); }

  private:
    using clouds_type = particle_clouds<S, Shape>;
    using cloud_vector = typename clouds_type::vector;
    /// How far functions reach, in sides of a cell: particles farther off are none of the node's.
    static constexpr double nearest = Shape::support / 2.;
    clouds_type clouds_;
    std::vector<std::uint32_t> shared_;
    meetings meetings_;
    bool gathered_ = false;

    double reach_of_normal() const {
        if constexpr (Contact::by_regression)
            return policy_.normal.reach;
        else
            return 0;
    }
    /// Particles that the normal does not know of must not tell how far the bodies are apart along it.
    bool in_sight(const cloud_vector& x) const {
        if constexpr (Contact::by_regression)
            return x.squaredNorm() < policy_.normal.reach * policy_.normal.reach;
        else
            return true;
    }
    template <class Fields> vector normal_of(const entry& e, const Fields& fields) const {
        if constexpr (Contact::by_mass)
            // G_pi slopes up towards the node, so the sum points out of the body.
            return fields[e.field[0]]->template get<field::mass_gradient>(e.place) -
                   fields[e.field[1]]->template get<field::mass_gradient>(e.place);
        else if constexpr (Contact::by_regression) {
            typename dividing_plane<D>::points all;
            for (std::size_t k = 0; k < 2; ++k)
                clouds_.each(lattice_, e.field[k], e.place, [&](const auto&, const cloud_vector& x) {
                    if (in_sight(x)) all.emplace_back(k == 0 ? -1. : 1., x);
                });
            return dividing_plane<D>(policy_.normal.penalty).normal(all).template cast<real>();
        } else
            return as_point<D, real>(policy_.normal(lattice_.place_of(e.place)));
    }
    template <class Fields> bool near(const entry& e, const Fields& fields) const {
        if constexpr (Contact::by_place) {
            const vector apart = fields[e.field[1]]->template get<field::mass_place>(e.place) / e.mass[1] -
                                 fields[e.field[0]]->template get<field::mass_place>(e.place) / e.mass[0];
            return apart.dot(e.normal) < constant<real>(policy_.detection.cells) * lattice_.grid().spacing();
        } else if constexpr (Contact::by_extents)
            return !gathered_ || gap(e) <= policy_.detection.cells;
        else
            return true;
    }
    /// How far the second body's particles around a node are from the first's along the normal, and how far at all, in
    /// the mean and times mass.
    std::array<double, 2> side(const entry& e) const {
        cloud_vector apart = cloud_vector::Zero();
        for (std::size_t k = 0; k < 2; ++k) {
            cloud_vector sum = cloud_vector::Zero();
            double count = 0;
            clouds_.each(lattice_, e.field[k], e.place, [&](const auto&, const cloud_vector& x) {
                sum += x;
                ++count;
            });
            if (count == 0) return {0, 0};
            apart += (k == 0 ? -1 : 1) / count * sum;
        }
        const double mass = to_double(e.reduced);
        return {mass * apart.dot(e.normal.template cast<double>()), mass * apart.norm()};
    }
    /// How far the bodies' nearest particles around a node are apart along its normal, from edge to edge, in sides of a
    /// cell.
    double gap(const entry& e) const {
        const cloud_vector normal = e.normal.template cast<double>();
        double nearest_of[2];
        for (std::size_t k = 0; k < 2; ++k) {
            const double sign = k == 0 ? -1 : 1;
            nearest_of[k] = std::numeric_limits<double>::infinity();
            clouds_.each(lattice_, e.field[k], e.place, [&](const auto& p, const cloud_vector& x) {
                if (in_sight(x) && x.cwiseAbs().maxCoeff() < nearest)
                    nearest_of[k] = std::min(nearest_of[k], sign * x.dot(normal) - p.extent(normal));
            });
        }
        return nearest_of[0] + nearest_of[1];
    }
};

}  // namespace tamis::detail
