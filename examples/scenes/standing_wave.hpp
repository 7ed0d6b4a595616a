#pragma once
#include "support/scene.hpp"

/// Standing wave: a bar with fixed ends rings in its first mode,
///     v = v0 sin(pi x) cos(pi t),  strain = v0 cos(pi x) sin(pi t),
/// for one period, T = 2 s. Cells, particles and amplitude are those of Perez, ADMPM, 2021.
inline bar_scene standing_wave() {
    return {.name = "standing_wave",
            .about = "A bar with fixed ends rings in its first mode, v = A sin(pi x) cos(pi t).",
            .cells = 50,
            .amplitude = 0.01,
            .time = 2,
            .courant = 0.1,
            .amplitude_is = "Largest velocity v0",
            .ends = [](double) { return bar_ends{}; },
            .exact = [](double v0) -> bar_answer { return exact::standing_wave{v0}; }};
}
