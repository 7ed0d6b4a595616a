#pragma once
#include "support/scene.hpp"

/// Shock: the left half of a bar starts compressed, strain e0 = -A, all at rest. Two fronts leave the middle at c;
/// between them strain and velocity are e0/2 and -c e0/2 (d'Alembert). The ends are held, the left one against the
/// stress of its half; the fronts would reach them at t = 0.5.
inline bar_scene shock() {
    return {.name = "shock",
            .about = "The left half of a bar starts compressed, strain -A; two fronts run from the middle.",
            .cells = 400,
            .amplitude = 0.001,
            .time = 0.4,
            .courant = 0.2,
            .amplitude_is = "Strain A of the left half's compression, e0 = -A",
            .ends = [](double) { return bar_ends{}; },
            .exact = [](double a) -> bar_answer { return exact::shock{-a}; },
            .scale = 0.5,
            .fronts = true};
}
