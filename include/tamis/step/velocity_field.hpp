#pragma once
#include <tamis/boundary/held_nodes.hpp>
#include <tamis/engine/reached_blocks.hpp>
#include <tamis/engine/sweeps_ahead.hpp>
#include <tamis/engine/wrap.hpp>
#include <tamis/step/composition.hpp>
#include <tamis/step/particle_stages.hpp>
#include <tamis/step/text.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace tamis::detail {

/// Nodes with one velocity each: the passes over them, the conditions that hold them, and which of them particles
/// reach.
template <class C> struct velocity_field {
    using S = typename C::S;
    using layout = typename schedule_of<C>::layout;
    using sweeps_type =
        std::conditional_t<C::sums_ahead, sweeps_ahead<S, typename C::shape, layout, typename C::execution, C::moves>,
                           detail::sweeps<S, typename C::shape, layout, typename C::execution, C::moves, C::places>>;
    using lattice_type = lattice<S, typename C::shape>;
    using held_type = held_nodes<S, typename C::shape, typename C::boundary, typename C::method>;

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
    }
    /// Sums over particles at the two places of a node at a periodic wall are one.
    template <class... F> void exchange(const lattice_type& lattice, fields<F...> sums) {
        if (any_axis_wraps(lattice)) wrap(lattice, sweeps.nodes(), sums);
    }
    /// Field F becomes the mass that the particles of some bodies give to the nodes.
    template <class F, class EachBody> void sum_masses(const lattice_type& lattice, const EachBody& each_body) {
        sweeps.template set_zero<F>();
        each_body([&](auto& body) { sweeps.scatter(body, kernel_of_parts<S>(typename p2g<F>::part{})); });
        exchange(lattice, fields<F>{});
    }
    /// The nodes have the masses that held particles give them; they keep 1/m.
    void invert_held_masses() {
        held.template take_masses<field::inverse_mass>(sweeps.nodes());
        sweeps.each_node(invert_in_place{});
    }
    /// The smallest mass of the nodes that are reached and not held (kg); infinity if there is none.
    double lightest_free_node() const {
        using F = std::conditional_t<C::moves, field::mass, field::inverse_mass>;
        double lightest = std::numeric_limits<double>::infinity();
        const std::vector<std::size_t> held_places = held.places();
        const auto& nodes = sweeps.nodes();
        constexpr auto W = static_cast<std::size_t>(S::width);
        for (const std::uint32_t block : nodes.active())
            for (std::size_t place = block * W; place < (block + 1) * W; ++place) {
                const double there = to_double(nodes.template at<F>(place));
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
