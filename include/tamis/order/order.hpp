#pragma once
#include <concepts>
#include <string_view>

namespace tamis {

/// When particles are strained (docs/method.md, Stress orders): the parts of the step before the forces and after the
/// particles' update, whether the later part uses velocities extrapolated again from the new V, and whether forces,
/// strains and conditions are all those of the step's start.
template <class O>
concept StressOrder = requires {
    requires O::before + O::after == 1.0;
    { O::remap } -> std::convertible_to<bool>;
    { O::explicit_euler } -> std::convertible_to<bool>;
};

/// Update stress first, with the velocity of t.
struct usf {
    static constexpr std::string_view name = "usf";
    static constexpr double before = 1, after = 0;
    static constexpr bool remap = false, explicit_euler = false;
};
/// Update stress last, with the velocity that updated the particles.
struct usl_minus {
    static constexpr std::string_view name = "usl-";
    static constexpr double before = 0, after = 1;
    static constexpr bool remap = false, explicit_euler = false;
};
/// Update stress last, with the new particle velocities extrapolated to the nodes once more (MUSL).
struct usl_plus {
    static constexpr std::string_view name = "usl+";
    static constexpr double before = 0, after = 1;
    static constexpr bool remap = true, explicit_euler = false;
};
/// Half first, half last as in USL-.
struct usavg_minus {
    static constexpr std::string_view name = "usavg-";
    static constexpr double before = 0.5, after = 0.5;
    static constexpr bool remap = false, explicit_euler = false;
};
/// Half first, half last as in USL+.
struct usavg_plus {
    static constexpr std::string_view name = "usavg+";
    static constexpr double before = 0.5, after = 0.5;
    static constexpr bool remap = true, explicit_euler = false;
};
/// ADMPM's order: forces from the stress of t, strain from the velocity of t, conditions one step late. Explicit Euler
/// in both, so energy grows at every time step; offered to reproduce ADMPM, not for use.
struct euler {
    static constexpr std::string_view name = "euler";
    static constexpr double before = 0, after = 1;
    static constexpr bool remap = false, explicit_euler = true;
};

}  // namespace tamis
