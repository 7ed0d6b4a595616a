#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/solver/motion.hpp>
#include <tamis/transfer/body_load.hpp>
#include <tamis/transfer/flow.hpp>
#include <tamis/transfer/strain.hpp>

#include <utility>

// What the passes of a step do to a particle or a node. Named types, not lambdas inside the solver: compositions that
// need the same pass share its code. Numbers stand before vectors: the other order is one more kind of expression of
// Eigen, and each takes long to compile.
namespace tamis::detail {

/// Nothing is the same for every node around a particle.
struct nothing {};

/// m = S^T M.
struct mass_to_nodes {
    using reads = fields<field::mass>;
    static constexpr bool uses_slopes = false;
    TAMIS_INLINE static nothing make(const auto&, const auto&) { return {}; }
    TAMIS_INLINE void operator()(auto p, auto near, const nothing&) const {
        using namespace symbols;
        for (const auto& [i, w, dw] : near) i[m] += w * p[m];
    }
};

/// Particles to nodes: mass, momentum, force, as far as they are wanted.
template <class S, class Shape, class Load, class Sums, bool Mass, bool Momentum, bool Force> struct to_nodes {
    static constexpr typename Sums::mass m{};
    static constexpr typename Sums::momentum mv{};
    static constexpr typename Sums::force f{};
    using list =
        typename concatenate<fields_if<Mass, typename Sums::mass>, fields_if<Momentum, typename Sums::momentum>,
                             fields_if<Force, typename Sums::force>>::type;
    using kinds = load_kinds<Load, point<S::dim, typename S::real>>;
    static constexpr bool loaded = Force && kinds::on_particles, on_faces = loaded && kinds::by_face;
    static constexpr bool uses_slopes = Force;
    using reads =
        merge<fields<field::mass>, fields_if<Momentum, field::velocity>, fields_if<Force, field::volume, field::stress>,
              std::conditional_t<loaded, typename kinds::particle_fields, fields<>>>;
    /// What is the same for every node around a particle: M V, V0 tau and what loads give.
    struct carried {
        typename S::vector momentum;
        symmetric_field::value<S> stress;
        loading<S, on_faces> load;
    };
    const Load& load;
    double time;

    template <class Slot> TAMIS_INLINE carried make(const Slot& slot, [[maybe_unused]] const frame<S>& at) const {
        const auto& mass = slot.template get<field::mass>();
        carried of;
        if constexpr (Momentum) of.momentum = mass * slot.template get<field::velocity>();
        // By components: a matrix times a scalar keeps copies of the scalar in memory.
        if constexpr (Force)
            unroll<symmetric_field::components<S>>([&](auto c) TAMIS_INLINE_LAMBDA {
                of.stress[c] = slot.template get<field::stress>()[c] * slot.template get<field::volume>();
            });
        if constexpr (loaded) of.load = loading_of<S, Shape>(load, slot, at, time);
        return of;
    }
    TAMIS_INLINE void operator()(auto p, auto near, const carried& of) const {
        for (const auto& [i, w, dw] : near) {
            if constexpr (Mass) i[m] += w * p[symbols::m];
            if constexpr (Momentum) i[mv] += w * of.momentum;
            if constexpr (Force) i[f] -= unpack<S>(of.stress) * dw;
            if constexpr (loaded) i[f] += w * of.load.force;
            if constexpr (on_faces) i[f] += of.load.couple * dw;
        }
    }
};

/// What contact measures on nodes: mass gradient, mean place of the particles.
template <class S, class Shape, bool Gradient, bool Place> struct contact_to_nodes {
    using reads = fields<field::mass>;
    static constexpr bool uses_slopes = Gradient;
    template <class Slot> TAMIS_INLINE typename S::vector make(const Slot& slot, const frame<S>& at) const {
        typename S::vector moment = S::vector::Constant(typename S::scalar(typename S::real(0)));
        if constexpr (Place) moment = places<S, Shape>(slot, at) * slot.template get<field::mass>();
        return moment;
    }
    TAMIS_INLINE void operator()(auto p, auto near, const typename S::vector& moment) const {
        for (const auto& [i, w, dw] : near) {
            if constexpr (Gradient) i[field::mass_gradient{}] += p[symbols::m] * typename S::vector(dw);
            if constexpr (Place) i[field::mass_place{}] += w * moment;
        }
    }
};

/// SdV = S^T M S dv, dv in `From`.
template <class From> struct spread {
    using reads = fields<field::mass>;
    static constexpr bool uses_slopes = false;
    /// M S dv.
    TAMIS_INLINE static auto make(const auto& slot, const auto& dv_p) {
        return (dv_p.sums.template get<From>() * slot.template get<field::mass>()).eval();
    }
    TAMIS_INLINE void operator()(auto, auto near, const auto& momentum) const {
        for (const auto& [i, w, dw] : near) i[symbols::Sdv] += w * momentum;
    }
};

/// m becomes 1/m.
struct invert_mass {
    using list = fields<const field::mass, field::inverse_mass>;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        i[im] = inverse_or_zero(i[m]);
    }
};

/// p becomes v; m becomes 1/m first where it is new.
template <bool MassIsNew> struct velocity_of_momentum {
    using list = typename concatenate<fields_if<MassIsNew, const field::mass, field::inverse_mass>,
                                      fields_if<!MassIsNew, const field::inverse_mass>,
                                      fields<const field::momentum, field::velocity>>::type;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        if constexpr (MassIsNew) i[im] = inverse_or_zero(i[m]);
        i[v] = i[im] * i[mv];
    }
};

/// f and v become a and v+; before that p becomes v and m becomes 1/m, where they are still to. `Keep`: v is kept.
template <class T, class Sums, bool MassIsNew, bool FromMomentum, bool Keep> struct accelerate {
    T dt;
    TAMIS_INLINE void operator()(auto i) const {
        using namespace symbols;
        if constexpr (MassIsNew) i[im] = inverse_or_zero(i[typename Sums::mass{}]);
        if constexpr (FromMomentum) i[v] = i[im] * i[typename Sums::momentum{}];
        if constexpr (Keep) i[v_start] = i[v];
        i[a] = i[im] * i[typename Sums::force{}];
        i[v] += dt * i[a];
    }
    using list = typename concatenate<fields_if<MassIsNew, const typename Sums::mass, field::inverse_mass>,
                                      fields_if<!MassIsNew, const field::inverse_mass>,
                                      fields_if<FromMomentum, const typename Sums::momentum>,
                                      fields_if<Keep, field::start_velocity>,
                                      fields<const typename Sums::force, field::acceleration, field::velocity>>::type;
};

/// The gathered gradient strains the particles, which then move if they are to.
template <class S, class Law, bool Move, class Look = no_flow> struct strain_particles {
    const Law& law;
    typename S::scalar dt;
    [[no_unique_address]] Look look{};
    template <class Slot, class... Flow> TAMIS_INLINE void operator()(Slot& slot, std::uint32_t occupied,
                                                                      const frame<S>& at, const auto& g,
                                                                      const Flow&... flow) const {
        strain_slot<S>(law, slot, occupied, at, g.gradient, dt, flow...);
        if constexpr (Move)
            slot.template get<field::position>() +=
                typename S::scalar(at.inverse_spacing) * slot.template get<field::displacement>();
    }
};

/// Nodes to particles: V', X', and the strain where it uses the same velocities (`Strains`). `Gathers`: the node fields
/// that the update reads.
template <class S, class Law, class Update, class Gathers, bool Strains, where_to Moves, class Look = no_flow>
struct update_particles {
    const Law& law;
    const Update& update;
    typename S::scalar dt, strain_dt;
    [[no_unique_address]] Look look{};
    template <class Slot, class Gathered, class... Flow>
    TAMIS_INLINE void operator()(Slot& slot, [[maybe_unused]] std::uint32_t occupied, const frame<S>& at,
                                 const Gathered& g, [[maybe_unused]] const Flow&... flow) const {
        const gathered_nodes<S, decltype(g.sums), Gathers> near{g.sums};
        auto& velocity = slot.template get<field::velocity>();
        // By components: copies of vectors go through memory in pieces, and wait for each other.
        typename S::vector before, after;
        before = std::as_const(velocity);
        const auto& result = update.velocity(slot_row<S, Slot, on_particles_t<Update>>{slot, at}, near, dt);
        after = result;
        velocity = std::as_const(after);
        if constexpr (Strains) strain_slot<S>(law, slot, occupied, at, g.gradient, strain_dt, flow...);
        if constexpr (Moves != where_to::nowhere) {
            const typename S::vector moved = update.displacement(before, after, near, dt);
            if constexpr (stores<typename Slot::list, field::update_error>)
                slot.template get<field::update_error>() =
                    moved / dt - (before + after) * constant<typename S::scalar>(0.5);
            if constexpr (Moves == where_to::displacement)
                slot.template get<field::displacement>() = moved;
            else
                slot.template get<field::position>() += typename S::scalar(at.inverse_spacing) * moved;
        }
    }
};

}  // namespace tamis::detail
