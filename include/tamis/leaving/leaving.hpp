#pragma once

namespace tamis {

/// Where a particle leaves the grid the run stops with an `error` that names it, its place, velocity and likely cause.
/// The default.
struct leaving_stops {
    /// What may happen: the run stops, the particle is put back into the box, or it is taken out.
    enum class choice { stop, clamp, remove };
    static constexpr choice when_leaving = choice::stop;
};
/// A particle that leaves the grid is put back on the wall, its velocity unchanged.
struct leaving_clamps {
    static constexpr auto when_leaving = leaving_stops::choice::clamp;
};
/// A particle that leaves the grid is removed, with its mass and momentum.
struct leaving_removes {
    static constexpr auto when_leaving = leaving_stops::choice::remove;
};

}  // namespace tamis
