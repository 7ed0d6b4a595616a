#pragma once
#include <tamis/core/names.hpp>
#include <tamis/load/body_load.hpp>
#include <tamis/motion/motion.hpp>
#include <tamis/step/node_stages.hpp>
#include <tamis/step/particle_kernel.hpp>
#include <tamis/update/carried.hpp>

#include <limits>
#include <string>
#include <string_view>

namespace tamis::detail {

// Stages over particles. Each declares the fields that it reads (const F) and makes, of particles and of nodes, and
// holds one formula, for the W particles of a slot at a time. What is summed to nodes is given in factors of weights,
// slopes and offsets (engine/terms.hpp).

struct over_particles {
    static constexpr over where = over::particles;
};

/// Particles to nodes: the sum that a node field is.
template <class Sum, class... How> struct p2g;

/// ... the mass.
template <class Mass> struct p2g<Mass> : over_particles {
    using on_particles = fields<const field::mass>;
    using on_nodes = fields<Mass>;
    struct part : gives<fields<Mass>, fields<field::mass>> {
        TAMIS_INLINE auto make(const auto& slot, const auto&, const auto&) const {
            return plain<Mass>(slot.template get<field::mass>());
        }
    };
    static part bind(const auto&, const auto&, auto&) { return {}; }
    static std::string text() { return letter<Mass>() + " = S^T M"; }
};
/// The momentum of what particles carry.
template <class Momentum, class Carried> struct p2g<Momentum, Carried> : over_particles {
    static constexpr bool optional = true;
    using on_particles = typename Carried::on_particles;
    using on_nodes = fields<Momentum>;
    template <class S> struct part : gives<fields<Momentum>, merge<on_particles>, false, Carried::by_offsets> {
        TAMIS_INLINE auto make(const auto& slot, const auto&, const auto&) const {
            return Carried::template momentum<Momentum, S>(slot);
        }
    };
    template <class Now> static part<typename Now::S> bind(const Now&, const auto&, auto&) { return {}; }
    static std::string text() { return letter<Momentum>() + " = " + std::string(Carried::text); }
};
/// The force of stresses and of loads on particles.
template <class Load, class Motion> struct p2g<field::force, Load, Motion> : over_particles {
    static constexpr bool total = is_total_lagrangian<Motion>;
    // Loads may look at what a particle has.
    using on_particles =
        typename concatenate<fields<const field::volume, const field::stress>,
                             fields_if<total, const field::deformation>,
                             fields_if<total && !std::same_as<Load, unloaded>, const field::displacement>,
                             fields_if<!std::same_as<Load, unloaded>, const field::mass, const field::velocity>>::type;
    using on_nodes = fields<field::force>;
    template <class S, class Shape> struct part {
        using kinds = load_kinds<Load, point<S::dim, typename S::real>>;
        using sums = fields<field::force>;
        using gathers = tamis::detail::gathers<>;
        using reads = merge<fields<field::mass, field::volume, field::stress>, on_particles_t<Motion>,
                            std::conditional_t<kinds::on_particles, fields<field::velocity>, fields<>>,
                            typename kinds::particle_fields>;
        static constexpr bool by_slopes = true, by_offsets = false, updates = false, moves = false;
        const Load& load;
        double time;
        TAMIS_INLINE auto make(const auto& slot, [[maybe_unused]] const frame<S>& at, const auto&) const {
            using forces = plain_term<field::force, typename S::vector>;
            using couples = slope_term<field::force, typename S::tensor>;
            const auto pull = pull_of(slot);
            using stresses = std::remove_cv_t<decltype(pull)>;
            if constexpr (!kinds::on_particles)
                return pull;
            else {
                const auto loads = loading_of<S, Shape>(load, slot, at, time);
                if constexpr (kinds::by_face)
                    return terms<stresses, forces, couples>{{pull}, {{loads.force}}, {{loads.couple}}};
                else
                    return terms<stresses, forces>{{pull}, {{loads.force}}};
            }
        }
        /// What stresses do: -V0 tau dw, or -V0 tau F^-T dw of the reference.
        TAMIS_INLINE static auto pull_of(const auto& slot) {
            if constexpr (!total) {
                // By components: a matrix times a scalar keeps copies of the scalar in memory.
                stress_term<S, field::force> pull;
                unroll<symmetric_field::components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                    pull.value[c] = slot.template get<field::stress>()[c] * slot.template get<field::volume>();
                });
                return pull;
            } else {
                const typename S::tensor F = slot.template get<field::deformation>();
                using T = typename S::scalar;
                const T volume = slot.template get<field::volume>(), J = determinant(F), none = constant<T>(0);
                // What is turned inside out stops the run; lanes without a particle have no F.
                const T wrong = select(volume > none, constant<T>(std::numeric_limits<double>::quiet_NaN()), none);
                const T there = select(J > none, volume / J, wrong);
                slope_term<field::force, typename S::tensor> pull{unpack<S>(slot.template get<field::stress>()) *
                                                                  cofactor(F)};
                unroll<S::dim * S::dim>([&](auto c) TAMIS_INLINE_LAMBDA { pull.value.data()[c] *= -there; });
                return pull;
            }
        }
    };
    template <class Now> static part<typename Now::S, typename Now::C::shape> bind(const Now& now, const auto&, auto&) {
        return {now.template load_as<Load>(), now.time};
    }
    static std::string text() {
        return std::string("f = -G^T V0 tau") + (total ? " F^-T" : "") +
               (std::same_as<Load, unloaded> ? "" : " + loads");
    }
};

/// `near` of a particle update: what its particles gathered of the node fields that it declares.
template <class S, class Shape, class Gathered, class Shown> struct gathered_near {
    using T = typename S::scalar;
    const Gathered& all;
    const T spacing;
    /// S F.
    template <class F> TAMIS_INLINE const auto& sum(F) const {
        static_assert(contains<Shown, F>,
                      "tamis: a policy reads a node field it did not declare; add it to the "
                      "policy's on_nodes list");
        return all.template sum<F>();
    }
    /// sum F_i (x) grad w_i.
    template <class F> TAMIS_INLINE const auto& gradient(F) const { return all.template gradient<F>(); }
    /// B D^-1, B = sum w_i F_i (x) (x_i - X), D = sum w_i (x_i - X)^2 along each axis: h^2/4 for quadratic splines. At
    /// a wall, where functions are folded, D goes to 0; a hundredth of h^2 is its least value here.
    template <class F> TAMIS_INLINE typename S::tensor slope_by_moment(F) const {
        if constexpr (constant_slope<Shape>)
            return all.template gradient<F>();
        else {
            typename S::tensor slope;
            const T least = spacing * spacing * constant<T>(0.01);
            unroll<S::dim>([&](auto d) TAMIS_INLINE_LAMBDA {
                const T& D = all.second_moment[d];
                const T inverse = T(typename S::real(1)) / select(D > least, D, least);
                unroll<S::dim>([&](auto c) TAMIS_INLINE_LAMBDA {
                    slope(int(c), int(d)) = all.template moment<F>()(int(c), int(d)) * inverse;
                });
            });
            return slope;
        }
    }
};

/// Nodes to particles: V', and X' - X where particles move; what else the update says they carry.
template <class Update, class Motion, class Shape> struct g2p : over_particles {
    static constexpr bool total = is_total_lagrangian<Motion>, Moves = Motion::moves || total;
    using way = std::conditional_t<total, field::displacement, field::step_displacement>;
    using wanted = update_fields<Update, Shape>;
    using gathers = typename wanted::template gathers<Moves>;
    static constexpr bool looks_for_mass = gathers::by_slopes;
    using on_nodes = typename wanted::template on_nodes<Moves>;
    using on_particles = typename concatenate<on_particles_t<Update>, fields<field::velocity>,
                                              fields_if<Moves, const field::velocity, way>, fields_if<total, const way>,
                                              fields_if<wanted::affine, field::affine_velocity>>::type;
    template <class S> struct part : updates_particles<gathers, merge<on_particles_t<Update>>> {
        const Update& update_;
        typename S::scalar dt;
        TAMIS_INLINE void update(auto& p, std::uint32_t, const frame<S>& at, const auto& g, const auto&) const {
            const gathered_near<S, Shape, std::remove_cvref_t<decltype(g)>, on_nodes> near{
                g, typename S::scalar(at.spacing)};
            auto& slot = p.slot;
            using slot_type = std::remove_reference_t<decltype(slot)>;
            auto& velocity = slot.template get<field::velocity>();
            // By components: copies of vectors go through memory in pieces, and wait for each other.
            typename S::vector before, after;
            before = std::as_const(velocity);
            const auto& result = update_.velocity(slot_row<S, slot_type, on_particles_t<Update>>{slot, at}, near, dt);
            after = result;
            velocity = std::as_const(after);
            if constexpr (wanted::affine) slot.template get<field::affine_velocity>() = update_.affine_velocity(near);
            if constexpr (Moves) {
                const typename S::vector moved = update_.displacement(before, after, near, dt);
                if constexpr (stores<typename slot_type::list, field::update_error>)
                    slot.template get<field::update_error>() =
                        moved / dt - (before + after) * constant<typename S::scalar>(0.5);
                if constexpr (total)
                    slot.template get<way>() += moved;
                else
                    p.template get<way>() = moved;
            }
        }
    };
    template <class Now> static part<typename Now::S> bind(const Now& now, const auto&, auto&) {
        return {{}, now.update(), now.lanes_dt()};
    }
    static std::string text() {
        std::string all = wanted::text();
        const auto u = all.find("; U"), after = u == std::string::npos ? u : all.find(';', u + 1);
        if (!Moves && u != std::string::npos) all.erase(u, after == std::string::npos ? after : after - u);
        if (total && u != std::string::npos) all.replace(u, 5, "; u +=");
        return all;
    }
};

/// Walls of held nodes, as the engine sees them.
template <class Walls> struct fence_of_walls {
    static constexpr bool there = true;
    Walls* walls;
    typename Walls::real inverse_dt;
    void keep(const auto& store, std::size_t slab, const tile& t) const { walls->keep(store, slab, t); }
    void stop(auto& store, const auto& lattice, std::size_t slab, const tile& t) const {
        walls->stop(store, lattice, slab, t, inverse_dt);
    }
};

/// X' = X + U, up to walls of held nodes.
struct move : over_particles {
    using on_nodes = fields<>;
    using on_particles = fields<const field::step_displacement, const field::position, field::position>;
    template <class S, class Fence> struct part : updates_particles<gathers<>, fields<field::position>> {
        static constexpr bool moves = true;
        [[no_unique_address]] Fence fence_;
        Fence fence() const { return fence_; }
        TAMIS_INLINE void update(auto& p, std::uint32_t, const frame<S>& at, const auto&, const auto&) const {
            p.slot.template get<field::position>() +=
                typename S::scalar(at.inverse_spacing) * p.template get<field::step_displacement>();
        }
    };
    template <class Now> static auto bind(const Now& now, auto& body, auto& sweeps) {
        if constexpr (Now::held_type::any) {
            auto& walls = now.held_of(sweeps).walls();
            walls.have_slabs(body.store().slabs());
            walls.mark_tiles(body.store(), now.work.lattice);
            using fence = fence_of_walls<std::remove_reference_t<decltype(walls)>>;
            return part<typename Now::S, fence>{{}, {&walls, now.inverse_dt}};
        } else
            return part<typename Now::S, no_fence>{};
    }
    static std::string text() { return "X += U"; }
};

/// Particles go to the cells where they are now.
struct migrate {
    static constexpr over where = over::storage;
    using on_nodes = fields<>;
    using on_particles = fields<>;
    static std::string text() { return "migrate"; }
};

}  // namespace tamis::detail
