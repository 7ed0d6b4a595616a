#pragma once
#include <tamis/load/load.hpp>

namespace tamis {

/// force(x, t), in newtons, on each particle whose place is in a region when its body is made; it follows the particle.
/// In 1D a number will do. A body may come later: `integrate` warns at its end if no particle was in the region so far.
template <class Region, class Force> struct particle_force {
    static constexpr std::string_view name = "particle_force";
    Region region;
    /// Force (N) at a place (m) and time (s).
    Force value;
    bool chooses(const auto& x) const { return region(x); }
    auto force(const auto& x, auto t) const {
        static_assert(
            std::invocable<const Force&, decltype(x), decltype(t)>,
            "tamis: the force of particle_force{region, force} is called as force(x, t), with a place and the "
            "time");
        return value(x, t);
    }
};
template <class Region, class Force> particle_force(Region, Force) -> particle_force<Region, Force>;

/// A force per area, value(x, n, t) in Pa, on the faces at a body's surface for which region(x, n), or region(x), is
/// true: x is the face's centre (m), n its outward unit normal, along an axis. A pressure is -p n. Faces are those of
/// the cubes that particles are when the body's first step comes, where there is no particle of the body beyond;
/// particles that are no lattice of equal cubes share the outer faces of cells. They follow the particle and keep the
/// area and direction they had then: the traction is a nominal one. `integrate` warns at its end if no face was in the
/// region so far.
template <class Region, class Value> struct traction {
    static constexpr std::string_view name = "traction";
    Region region;
    /// Traction (Pa) at a place (m), with its outward normal, at a time (s).
    Value value;
    bool takes(const auto& x, const auto& n) const {
        if constexpr (std::invocable<const Region&, decltype(x), decltype(n)>)
            return region(x, n);
        else
            return region(x);
    }
    auto per_area(const auto& x, const auto& n, auto t) const {
        static_assert(std::invocable<const Value&, decltype(x), decltype(n), decltype(t)>,
                      "tamis: the value of traction{region, value} is called as value(x, n, t), with a face's centre, "
                      "its outward normal and the time");
        return value(x, n, t);
    }
};
template <class Region, class Value> traction(Region, Value) -> traction<Region, Value>;

}  // namespace tamis
