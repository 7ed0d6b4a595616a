#pragma once

namespace tamis::detail {

/// Numbers of particles per cell along an axis that the table of critical Courant numbers knows: 1 to this.
inline constexpr int critical_per_cell = 4;
/// Orders k that it knows. PIC is FMPM(1).
inline constexpr int critical_xpic[] = {2, 4, 8, 16};
inline constexpr int critical_fmpm[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 64};
/// Of one shape and stress order: FLIP, XPIC(k), FMPM(k).
inline constexpr int critical_updates = 1 + 4 + 11;
/// The share of an inner node's mass that the lightest node has where the numbers of free ends fall to 0 with it
/// (linear functions that strain by the velocity of the step).
inline constexpr double critical_share = 0.01;

/// One composition.
struct critical_row {
    short inner[critical_per_cell], free_end[critical_per_cell];
};

}  // namespace tamis::detail
