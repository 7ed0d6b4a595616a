#pragma once
#include "support/scene.hpp"

/// Reflection: the right end of a bar at rest is driven with v0 sin(10 t), the left one is fixed. The wave arrives
/// there at t = 1 and, reflected, is back at T = 2 s. Until then its energy is v0^2 (t/2 - sin(20 t)/40), the work of
/// the driven end: the wall does none.
inline bar_scene reflection() {
    constexpr double omega = 10;
    return {.name = "reflection",
            .about = "The right end of a bar is driven with A sin(10 t); the wave is reflected by the fixed left end.",
            .cells = 100,
            .amplitude = 0.01,
            .time = 2,
            .courant = 0.1,
            .amplitude_is = "Velocity v0 of the driven end",
            .ends =
                [](double v0) {
                    return bar_ends{v0, omega};
                },
            .exact = [](double v0) -> bar_answer {
                return exact::reflection{v0, omega};
            }};
}
