#pragma once
#include <tamis/boundary/held_nodes.hpp>
#include <tamis/grid/wrap.hpp>
#include <tamis/solver/composition.hpp>
#include <tamis/solver/kernels.hpp>
#include <tamis/solver/reached_blocks.hpp>
#include <tamis/solver/sweeps.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace tamis::detail {

/// Nodes with one velocity each: the passes over them, the conditions that hold them, and which of them particles
/// reach.
template <class C> struct velocity_field {
    using S = typename C::S;
    using sweeps_type = detail::sweeps<S, typename C::shape, typename C::node_fields, typename C::execution, C::moves>;
    using lattice_type = typename sweeps_type::lattice_type;
    using held_type = held_nodes<S, typename C::shape, typename C::boundary, typename C::method, typename C::sums>;

    sweeps_type sweeps;
    held_type held;

    velocity_field(const typename C::shape& functions, const lattice_type& lattice, const typename C::execution& run,
                   const typename C::boundary& boundary, const typename C::method& method)
        : sweeps(functions, lattice, run), held(boundary, lattice, method) {}

    /// The nodes that these tiles reach are in use from now on.
    void attend(const std::vector<placed_tiles>& tiles, const lattice_type& lattice) {
        reached_.mark(tiles, lattice);
        sweeps.nodes().set_active(reached_.blocks());
        held.attend(reached_.marks());
        if constexpr (!C::moves) sweeps.nodes().template set_zero<field::mass>();
    }
    /// The nodes have the masses that held particles give them; they keep 1/m.
    void keep_masses(const lattice_type& lattice) {
        wrap(lattice, sweeps.nodes(), fields<field::mass>{});
        held.take_masses(sweeps.nodes());
        sweeps.each_node(invert_mass::list{}, invert_mass{});
    }
    /// The smallest mass of the nodes that are reached and not held (kg); infinity if there is none.
    double lightest_free_node() const {
        double lightest = std::numeric_limits<double>::infinity();
        const std::vector<std::size_t> held_places = held.places();
        const auto& nodes = sweeps.nodes();
        constexpr auto W = static_cast<std::size_t>(S::width);
        for (const std::uint32_t block : nodes.active())
            for (std::size_t place = block * W; place < (block + 1) * W; ++place) {
                const double there = to_double(nodes.template at<field::mass>(place));
                if (!(there > 0)) continue;
                const double mass = C::moves ? there : 1 / there;
                if (mass < lightest && !std::binary_search(held_places.begin(), held_places.end(), place))
                    lightest = mass;
            }
        return lightest;
    }

  private:
    reached_blocks reached_;
};

}  // namespace tamis::detail
