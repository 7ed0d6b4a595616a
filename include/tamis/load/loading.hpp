#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/load/loads.hpp>
#include <tamis/load/surface.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tamis::detail {

/// Areas of the faces at a new body's surface that its surface loads take.
template <class Body, class Load> void take_faces(Body& body, const Load& load) {
    using real = typename Body::real;
    using at_point = point<Body::dim, real>;
    constexpr int D = Body::dim, W = Body::space_type::width;
    std::vector<surface_particle<D, real>> particles;
    for (const auto p : std::as_const(body))
        particles.push_back({p[symbols::x], p[symbols::V], side_of<D>(real(p[symbols::V]))});
    if (particles.empty()) return;
    const auto& grid = body.lattice().grid();
    const body_surface<D, real> surface(particles, grid.lower(), grid.spacing());
    std::vector<std::array<real, 2 * D>> areas(particles.size());
    for (auto& of_particle : areas) of_particle.fill(real(0));
    for (int side = 0; side < 2 * D; ++side)
        surface.each_face(side / 2, side % 2 == 1,
                          [&](std::size_t k, const real& area) { areas[k][static_cast<std::size_t>(side)] = area; });
    each_load(load, [&](auto k, const auto& one) {
        using type = std::remove_cvref_t<decltype(one)>;
        if constexpr (SurfaceLoad<type, at_point>) {
            std::size_t number = 0;
            for (auto p : body) {
                real* to = p[field::faces<decltype(k)::value>{}];
                for (int side = 0; side < 2 * D; ++side) {
                    at_point normal = at_point::Zero(), centre = particles[number].at;
                    normal[side / 2] = real(side % 2 == 0 ? -1 : 1);
                    centre += normal * (particles[number].side / real(2));
                    const real& area = areas[number][static_cast<std::size_t>(side)];
                    to[side * W] =
                        area > real(0) && one.takes(std::as_const(centre), std::as_const(normal)) ? area : real(0);
                }
                ++number;
            }
        }
    });
}

/// Which particles of a new body, and which of their faces, loads act on.
template <class Body, class Load> void load_body(Body& body, const Load& load) {
    using real = typename Body::real;
    using at_point = point<Body::dim, real>;
    each_load(load, [&](auto k, const auto& one) {
        if constexpr (ParticleLoad<std::remove_cvref_t<decltype(one)>, at_point>)
            for (auto p : body) {
                const at_point x = p[symbols::x];
                p[field::chosen<decltype(k)::value>{}] = real(one.chooses(x) ? 1 : 0);
            }
    });
    if constexpr (load_kinds<Load, at_point>::by_face) take_faces(body, load);
}

/// Which loads on particles and faces have found some to act on, in the bodies so far: others may come.
template <class Load, class Point> class load_targets {
    using kinds = load_kinds<Load, Point>;
    static constexpr bool any = kinds::by_particle || kinds::by_face;

  public:
    template <class... Body> void look(const Load& load, const std::tuple<Body&...>& all) {
        if constexpr (any)
            each_load(load, [&](auto k, const auto& one) {
                if (!found_[k]) each_of(all, [&](const auto& body) { found_[k] = found_[k] || acts<k>(one, body); });
            });
    }
    /// A sentence about those that have found none; empty if all have.
    std::string missing(const Load& load) const {
        std::string text;
        if constexpr (any)
            each_load(load, [&](auto k, const auto& one) {
                using type = std::remove_cvref_t<decltype(one)>;
                if (found_[k]) return;
                if constexpr (ParticleLoad<type, Point>)
                    text += sentence(text.empty() ? "" : "; ", "load ", decltype(k)::value + 1,
                                     ", a force on particles, has no particle in its region; check it against the "
                                     "particles' places when their body is made");
                if constexpr (SurfaceLoad<type, Point>)
                    text +=
                        sentence(text.empty() ? "" : "; ", "load ", decltype(k)::value + 1,
                                 ", a traction, has no face in its region: it is asked for the centre and normal of "
                                 "particles' faces at the body's surface, half a particle's side outside their "
                                 "places; make the region reach them, with room for round-off");
            });
        return text;
    }

  private:
    std::array<bool, std::tuple_size_v<typename load_list<Load>::type>> found_{};

    template <int K, class One, class Body> static bool acts(const One&, const Body& body) {
        using real = typename Body::real;
        bool some = false;
        if constexpr (ParticleLoad<One, Point>)
            for (const auto p : body) some = some || p[field::chosen<K>{}] != real(0);
        if constexpr (SurfaceLoad<One, Point>)
            for (const auto p : body) {
                const real* areas = p[field::faces<K>{}];
                for (int f = 0; f < 2 * Body::dim; ++f) some = some || areas[f * Body::space_type::width] != real(0);
            }
        return some;
    }
};

}  // namespace tamis::detail
