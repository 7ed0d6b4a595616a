#pragma once
#include <nlohmann/json.hpp>

#include <cstddef>

/// What a summary tells of the composition, by the same names in all scenes.
template <class Options>
nlohmann::ordered_json composition_of(const char* scene, int cells, int per_cell, const Options& o) {
    nlohmann::ordered_json all;
    all["scene"] = scene;
    all["cells"] = cells;
    all["per_cell"] = per_cell;
    all["shape"] = o.shape;
    all["update"] = o.update;
    all["order"] = o.has_order() ? nlohmann::ordered_json(o.order) : nlohmann::ordered_json();
    if constexpr (requires { o.alpha; })
        if (o.update == "blend") all["alpha"] = o.alpha;
    all["stress"] = o.stress;
    return all;
}

/// And of what it took.
inline void put_cost(nlohmann::ordered_json& all, std::size_t particles, long steps, double wall_seconds) {
    all["particle_count"] = particles;
    all["steps"] = steps;
    all["wall_seconds"] = wall_seconds;
    all["ns_per_particle_step"] = wall_seconds * 1e9 / (static_cast<double>(particles) * static_cast<double>(steps));
}
