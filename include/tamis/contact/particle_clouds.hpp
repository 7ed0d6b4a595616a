#pragma once
#include <tamis/engine/tile_store.hpp>
#include <tamis/grid/lattice.hpp>
#include <tamis/load/body_load.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tamis::detail {

/// A particle as contact sees it, in sides of a cell from node (0, 0, 0).
template <int D> struct cloud_particle {
    using vector = Eigen::Matrix<double, D, 1, Eigen::DontAlign>;
    vector at;
    /// F times half its side when undeformed.
    Eigen::Matrix<double, D, D, Eigen::DontAlign> half;
    /// How far it reaches along a unit vector: the ellipsoid that its sphere became. Unlike a box it needs not be told
    /// how the particles were laid out.
    double extent(const vector& along) const { return (half.transpose() * along).norm(); }
};

/// The particles of each body around some nodes: their clouds.
template <class S, class Shape> class particle_clouds {
  public:
    static constexpr int D = S::dim;
    using real = typename S::real;
    using lattice_type = lattice<S, Shape>;
    using particle_type = cloud_particle<D>;
    using vector = typename particle_type::vector;

    /// Of no node yet; `reach`: how far from a node, along every axis, its clouds reach, in sides of a cell.
    void begin(const lattice_type& lattice, std::size_t bodies, double reach) {
        for (const std::size_t place : nodes_) number_of_[place] = 0;
        number_of_.resize(lattice.size(), 0);
        nodes_.clear();
        particles_.clear();
        bodies_ = bodies;
        reach_ = reach;
        low_.fill(1 << 30);
        high_.fill(-(1 << 30));
    }
    void attend(const lattice_type& lattice, std::size_t place) {
        if (number_of_[place] != 0) return;
        nodes_.push_back(place);
        number_of_[place] = static_cast<std::uint32_t>(nodes_.size());
        const auto node = lattice.node_of(place);
        for (std::size_t d = 0; d < 3; ++d) {
            low_[d] = std::min(low_[d], node[d]);
            high_[d] = std::max(high_[d], node[d]);
        }
    }
    /// All nodes are told.
    void end() {
        clouds_.resize(std::max(clouds_.size(), nodes_.size() * bodies_));
        for (std::size_t k = 0; k < nodes_.size() * bodies_; ++k) clouds_[k].clear();
    }
    /// Adds the particles of a body, in the order of storage, which threads do not change.
    template <class Store> void add(const lattice_type& lattice, std::size_t body, const Store& store) {
        store.deliver_all();
        for (const tile& t : store.tiles) {
            if (!may_reach(t)) continue;
            for (std::uint32_t s = t.first; s < t.first + t.count; ++s)
                for (int l = 0; l < S::width; ++l)
                    if (store.occupied[s] >> l & 1u) add(lattice, body, seen(lattice, store, t, s, l));
        }
    }
    /// f(particle, its offset from the node) for the cloud of a body at the node at a storage place.
    template <class F> void each(const lattice_type& lattice, std::size_t body, std::size_t place, const F& f) const {
        const auto node = lattice.node_of(place);
        vector at;
        for (int d = 0; d < D; ++d) at[d] = node[static_cast<std::size_t>(d)];
        for (const std::uint32_t k : clouds_[(number_of_[place] - 1) * bodies_ + body])
            f(particles_[k], vector(particles_[k].at - at));
    }

  private:
    std::vector<particle_type> particles_;
    std::vector<std::size_t> nodes_;
    std::vector<std::uint32_t> number_of_;            // per place, from 1; 0: none
    std::vector<std::vector<std::uint32_t>> clouds_;  // per node and body
    std::size_t bodies_ = 0;
    double reach_ = 0;
    std::array<int, 3> low_{}, high_{};  // of the nodes

    bool may_reach(const tile& t) const {
        for (int d = 0; d < D; ++d) {
            const auto a = static_cast<std::size_t>(d);
            const double first = (d == 0 ? t.at[0] * S::width : t.at[a]) - Shape::shift;
            const double last = first + (d == 0 ? S::width : 1);
            if (last < low_[a] - reach_ || first > high_[a] + reach_) return false;
        }
        return true;
    }
    template <class Store>
    static particle_type seen(const lattice_type& lattice, const Store& store, const tile& t, std::uint32_t s, int l) {
        using slot = typename Store::slot;
        using list = typename slot::list;
        constexpr int W = S::width;
        const real* const first = store.lane_of(s, l);
        const auto number = [&](auto field, int c) {
            return to_double(first[(slot::template first<decltype(field)>() + c) * W]);
        };
        particle_type p;
        for (int d = 0; d < D; ++d) {
            const int cell = d == 0 ? t.at[0] * W + l : t.at[static_cast<std::size_t>(d)];
            double r;
            if constexpr (stores<list, field::position>)
                r = number(field::position{}, d);
            else {
                using weights = held_weights<Shape>;
                const real* const kept = first + slot::template first<weights>() * W;
                r = to_double(weights::template place<S>(d, [&](int c) { return kept[c * W]; }));
            }
            p.at[d] = cell - Shape::shift + r;
        }
        const double half = side_of<D>(number(field::volume{}, 0)) / to_double(lattice.grid().spacing()) / 2;
        p.half.setIdentity();
        if constexpr (stores<list, field::deformation>) {
            for (int c = 0; c < D * D; ++c) p.half(c % D, c / D) = number(field::deformation{}, c);
            p.half *= half;
        } else if constexpr (stores<list, field::volume_ratio>)
            p.half *= half * std::pow(number(field::volume_ratio{}, 0), 1. / D);
        else
            p.half *= half;
        return p;
    }
    void add(const lattice_type& lattice, std::size_t body, const particle_type& p) {
        std::array<int, 3> from{0, 0, 0}, to{0, 0, 0}, node;
        for (int d = 0; d < D; ++d) {
            const auto a = static_cast<std::size_t>(d);
            from[a] = std::max(static_cast<int>(std::ceil(p.at[d] - reach_)), low_[a]);
            to[a] = std::min(static_cast<int>(std::floor(p.at[d] + reach_)), high_[a]);
        }
        bool kept = false;
        for (node[2] = from[2]; node[2] <= to[2]; ++node[2])
            for (node[1] = from[1]; node[1] <= to[1]; ++node[1])
                for (node[0] = from[0]; node[0] <= to[0]; ++node[0]) {
                    const std::uint32_t number = number_of_[lattice.node_place(node)];
                    if (number == 0) continue;
                    if (!kept) particles_.push_back(p);
                    kept = true;
                    clouds_[(number - 1) * bodies_ + body].push_back(static_cast<std::uint32_t>(particles_.size() - 1));
                }
    }
};

}  // namespace tamis::detail
