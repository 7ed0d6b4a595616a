#pragma once
#include <tamis/core/each_of.hpp>
#include <tamis/core/error.hpp>
#include <tamis/load/loads.hpp>
#include <tamis/particles/body.hpp>
#include <tamis/transfer/body_load.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <type_traits>
#include <vector>

namespace tamis::detail {

/// Where a new body has particles: they are sorted into cubes of a particle's side, the first one's at its centre, so
/// that those of `per_cell` are all at centres.
template <class Body> class occupied_cubes {
  public:
    using real = typename Body::real;
    using place = point<Body::dim, real>;
    explicit occupied_cubes(const Body& body) {
        const auto first = *body.begin();
        origin_ = first[symbols::x];
        side_ = side_of<Body::dim>(real(first[symbols::V]));
        for (const auto p : body) cubes_.push_back(cube_of(p[symbols::x]));
        std::sort(cubes_.begin(), cubes_.end());
    }
    const real& side() const { return side_; }
    bool at(const place& where) const { return std::binary_search(cubes_.begin(), cubes_.end(), cube_of(where)); }

  private:
    place origin_;
    real side_;
    std::vector<std::array<int, 3>> cubes_;
    std::array<int, 3> cube_of(const place& where) const {
        std::array<int, 3> cube{0, 0, 0};
        for (int d = 0; d < Body::dim; ++d)
            cube[static_cast<std::size_t>(d)] = lane<real>::floor((where[d] - origin_[d]) / side_ + real(0.5));
        return cube;
    }
};

/// Areas of the faces at a new body's surface that a load takes.
template <int K, class Body, class Load> void take_faces(Body& body, const Load& load) {
    using real = typename Body::real;
    constexpr int D = Body::dim, W = Body::space_type::width;
    const occupied_cubes<Body> filled(std::as_const(body));
    const real side = filled.side();
    real area(1);
    for (int d = 1; d < D; ++d) area *= side;
    for (auto p : body) {
        real* areas = p[field::faces<K>{}];
        const point<D, real> centre = p[symbols::x];
        for (int k = 0; k < 2 * D; ++k) {
            point<D, real> normal = point<D, real>::Zero();
            normal[k / 2] = real(k % 2 == 0 ? -1 : 1);
            const point<D, real> face = centre + normal * (side / real(2)), beyond = centre + normal * side;
            if (load.takes(face, std::as_const(normal)) && !filled.at(beyond)) areas[k * W] = area;
        }
    }
}

/// Which particles of a new body, and which of their faces, loads act on.
template <class Body, class Load> void load_body(Body& body, const Load& load) {
    using real = typename Body::real;
    using at_point = point<Body::dim, real>;
    each_load(load, [&](auto k, const auto& one) {
        using type = std::remove_cvref_t<decltype(one)>;
        constexpr int K = decltype(k)::value;
        if constexpr (ParticleLoad<type, at_point>)
            for (auto p : body) {
                const at_point x = p[symbols::x];
                p[field::chosen<K>{}] = real(one.chooses(x) ? 1 : 0);
            }
        if constexpr (SurfaceLoad<type, at_point>) take_faces<K>(body, one);
    });
}

/// Throws if a load acts on no particle and no face of the bodies.
template <class Load, class... Body> void check_loaded(const Load& load, const std::tuple<Body&...>& all) {
    using some_body = std::tuple_element_t<0, std::tuple<Body...>>;
    using real = typename some_body::real;
    using at_point = point<some_body::dim, real>;
    const auto in_any_body = [&](const auto& is_loaded) {
        bool found = false;
        const auto look = [&](const auto& body) {
            for (const auto p : body) found = found || is_loaded(p);
        };
        each_of(all, look);
        return found;
    };
    each_load(load, [&](auto k, const auto& one) {
        using type = std::remove_cvref_t<decltype(one)>;
        constexpr int K = decltype(k)::value, W = some_body::space_type::width;
        if constexpr (ParticleLoad<type, at_point>)
            if (!in_any_body([](const auto& p) { return p[field::chosen<K>{}] != real(0); }))
                throw error(sentence("load ", K + 1,
                                     ", a force on particles, has no particle in its region; check it "
                                     "against the particles' places when their body is made"));
        if constexpr (SurfaceLoad<type, at_point>)
            if (!in_any_body([](const auto& p) {
                    const real* areas = p[field::faces<K>{}];
                    bool some = false;
                    for (int f = 0; f < 2 * some_body::dim; ++f) some = some || areas[f * W] != real(0);
                    return some;
                }))
                throw error(sentence("load ", K + 1,
                                     ", a traction, has no face in its region: it is asked for the centre "
                                     "and normal of particles' faces at the body's surface, half a particle's side "
                                     "outside their places; make the region reach them, with room for round-off"));
    });
}

}  // namespace tamis::detail
