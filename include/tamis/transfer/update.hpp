#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>

namespace tamis {

// A particle update (docs/method.md, Particle updates) is two formulas. `velocity(p, near, dt)` gives V',
// `displacement(V, V', near, dt)` gives X' - X. `on_nodes` are the node fields the first reads, `to_move` those the
// second reads besides: particles that are held never gather them. `start_share` is the part of what the conditions do
// to the momentum of the step's start that reaches the particles.

/// PIC: V' = S v+, X' = X + S v+ dt.
struct set_velocity {
    using on_nodes = fields<const field::velocity>;
    using to_move = fields<const field::velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v); }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

/// FMPM: V' = S v+(k), X' = X + (V + V') dt/2.
struct set_velocity_move_by_mean {
    using on_nodes = fields<const field::velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v); }
    auto displacement(const auto& before, const auto& after, auto, auto dt) const {
        return ((before + after) * (dt / 2)).eval();
    }
};

/// FLIP: V' = V + a dt, X' = X + S v+ dt, with a = S m^-1 f.
struct add_acceleration {
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::acceleration>;
    using to_move = fields<const field::velocity>;
    static constexpr double start_share() { return 0; }
    auto velocity(auto p, auto near, auto dt) const {
        using namespace symbols;
        return (p[v] + dt * near.sum(a)).eval();
    }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

/// FLIP(psi): as FLIP, X' = X + (S v+ - psi a dt/2) dt. psi = 1 is FMPM(0) and XPIC(0).
struct add_acceleration_modified {
    double psi = 1;
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::acceleration>;
    using to_move = fields<const field::velocity>;
    static constexpr double start_share() { return 0; }
    auto velocity(auto p, auto near, auto dt) const {
        using namespace symbols;
        return (p[v] + dt * near.sum(a)).eval();
    }
    auto displacement(const auto& before, const auto& after, auto near, auto dt) const {
        return (dt * near.sum(symbols::v) - (after - before) * (dt * constant<decltype(dt)>(psi / 2))).eval();
    }
};

/// FLIP/PIC blend: V' = alpha V + S m^-1 (p+ - alpha p), X' = X + S v+ dt.
struct blend_velocity {
    double alpha = 0.99;
    using on_particles = fields<const field::velocity>;
    using on_nodes = fields<const field::velocity, const field::acceleration>;
    double start_share() const { return 1 - alpha; }
    // With p+ = p + m a dt: alpha (V + a dt) + (1 - alpha) S v+.
    auto velocity(auto p, auto near, auto dt) const {
        using namespace symbols;
        using T = decltype(dt);
        return ((p[v] + dt * near.sum(a)) * constant<T>(alpha) + near.sum(v) * constant<T>(1 - alpha)).eval();
    }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

/// As blend_velocity, but X' = X + V' dt, the rule of computer graphics.
struct blend_velocity_graphics : blend_velocity {
    auto displacement(const auto&, const auto& after, auto, auto dt) const { return (after * dt).eval(); }
};

/// XPIC: V' = S M^-1 p + a dt, X' = X + [S m^-1 p + (V' - V)/2] dt.
struct set_filtered_velocity {
    using on_nodes = fields<const field::filtered_velocity>;
    using to_move = fields<const field::start_velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v_filtered); }
    auto displacement(const auto& before, const auto& after, auto near, auto dt) const {
        return (dt * near.sum(symbols::v_start) + (after - before) * (dt / 2)).eval();
    }
};

}  // namespace tamis
