#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/engine/gather.hpp>

#include <concepts>
#include <string>
#include <string_view>

namespace tamis {

// A particle update (docs/method.md, Particle updates) is two formulas. `velocity(p, near, dt)` gives V',
// `displacement(V, V', near, dt)` gives X' - X. `on_nodes` are the node fields the first reads, `to_move` those the
// second reads besides: particles that are held never gather them. `start_share` is the part of what the conditions do
// to the momentum of the step's start that reaches the particles. An update that `carries_slope` has a third formula,
// `affine_velocity(near)`, for the slope of its particles' velocity, and names the node fields whose `gradients` it
// reads, and those of which it wants slopes by moments.

/// A particle update says the node fields that it reads, and its share of the start; its formulas are templates.
template <class U>
concept ParticleUpdate = requires(const U& update) {
    typename U::on_nodes;
    { update.start_share() } -> std::convertible_to<double>;
};

namespace detail {

/// The node fields that an update reads.
template <class U, class Shape> class update_fields {
    template <class V> struct moves_by { using type = fields<>; };
    template <class V>
    requires requires { typename V::to_move; }
    struct moves_by<V> {
        using type = typename V::to_move;
    };
    template <class V> struct gradients_of { using type = fields<>; };
    template <class V>
    requires requires { typename V::gradients; }
    struct gradients_of<V> {
        using type = typename V::gradients;
    };
    template <class V> struct by_moment { using type = fields<>; };
    template <class V>
    requires requires { typename V::slopes_by_moment; }
    struct by_moment<V> {
        using type = typename V::slopes_by_moment;
    };
    using slopes_by_moment = typename by_moment<U>::type;
    // Linear functions: B D^-1 is the gradient.
    static constexpr bool moments_are_gradients = constant_slope<Shape>;
    template <class List> struct only_read;
    template <class... F> struct only_read<fields<F...>> { using type = fields<const F...>; };

  public:
    /// Do particles carry the slope of their velocity?
    static constexpr bool affine = requires { requires U::carries_slope; };
    template <bool Moves> using gathers = detail::gathers<
        merge<on_nodes_t<U>, std::conditional_t<Moves, typename moves_by<U>::type, fields<>>>,
        merge<typename gradients_of<U>::type, std::conditional_t<moments_are_gradients, slopes_by_moment, fields<>>>,
        std::conditional_t<moments_are_gradients, fields<>, slopes_by_moment>>;
    template <bool Moves> using on_nodes = typename only_read<typename gathers<Moves>::looks_at>::type;
    static std::string text() {
        if constexpr (requires { U::text; })
            return std::string(U::text);
        else
            return "V', U by an update of your own";
    }
};

}  // namespace detail

/// PIC: V' = S v+, X' = X + S v+ dt.
struct set_velocity {
    static constexpr std::string_view text = "V = S v; U = S v dt";
    using on_nodes = fields<const field::velocity>;
    using to_move = fields<const field::velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v); }
    auto displacement(const auto&, const auto&, auto near, auto dt) const { return (dt * near.sum(symbols::v)).eval(); }
};

/// FMPM: V' = S v+(k), X' = X + (V + V') dt/2.
struct set_velocity_move_by_mean {
    static constexpr std::string_view text = "V = S v; U = (V + V') dt/2";
    using on_nodes = fields<const field::velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v); }
    auto displacement(const auto& before, const auto& after, auto, auto dt) const {
        return ((before + after) * (dt / 2)).eval();
    }
};

/// FLIP: V' = V + a dt, X' = X + S v+ dt, with a = S m^-1 f.
struct add_acceleration {
    static constexpr std::string_view text = "V += S a dt; U = S v dt";
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
    static constexpr std::string_view text = "V += S a dt; U = (S v - psi S a dt/2) dt";
    /// 0 is FLIP, 1 is FMPM(0).
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
    static constexpr std::string_view text = "V = alpha (V + S a dt) + (1 - alpha) S v; U = S v dt";
    /// Share of FLIP, 0 to 1.
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
    static constexpr std::string_view text = "V = alpha (V + S a dt) + (1 - alpha) S v; U = V' dt";
    auto displacement(const auto&, const auto& after, auto, auto dt) const { return (after * dt).eval(); }
};

/// XPIC: V' = S M^-1 p + a dt, X' = X + [S m^-1 p + (V' - V)/2] dt.
struct set_filtered_velocity {
    static constexpr std::string_view text = "V = S v_x; U = (S v0 + (V' - V)/2) dt";
    using on_nodes = fields<const field::filtered_velocity>;
    using to_move = fields<const field::start_velocity>;
    static constexpr double start_share() { return 1; }
    const auto& velocity(auto, auto near, auto) const { return near.sum(symbols::v_filtered); }
    auto displacement(const auto& before, const auto& after, auto near, auto dt) const {
        return (dt * near.sum(symbols::v_start) + (after - before) * (dt / 2)).eval();
    }
};

}  // namespace tamis
