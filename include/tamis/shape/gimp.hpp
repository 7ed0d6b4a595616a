#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/shape/axis_weights.hpp>

namespace tamis {

namespace detail {

/// Tents of the nodes at -1, 0 and 1 from the cell's centre, averaged over the particle's domain: from `half` to the
/// left of place r to `half` to the right of it, in cell sides, 0 < half <= 1/2.
template <class T> TAMIS_INLINE axis_weights<T, 3> averaged_tents(const T& r, const T& half) {
    const T zero = constant<T>(0), one = constant<T>(1), two = constant<T>(2), f = r - constant<T>(0.5);
    // How much of the domain is to the right and to the left of the middle node.
    const T up = select(f + half > zero, f + half, zero), down = select(half - f > zero, half - f, zero);
    const T quarter = one / (constant<T>(4) * half);
    const auto all_right = f >= half, all_left = f <= zero - half;
    const T right = select(all_right, f, quarter * up * up), left = select(all_left, zero - f, quarter * down * down);
    const T d_right = select(all_right, one, two * quarter * up), d_left = select(all_left, one, two * quarter * down);
    return {{left, one - left - right, right}, {zero - d_left, d_left - d_right, d_right}};
}

inline double half_of_domain(const char* shape, int per_cell) {
    if (per_cell < 1)
        throw error(sentence(shape, ": per_cell is ", per_cell,
                             "; give the number of particles that share a cell's side, 1 or more"));
    return 0.5 / per_cell;
}

}  // namespace detail

/// Tents averaged over the domain of an undeformed particle, a cell's side over `per_cell` wide along every axis:
/// uniform GIMP (Bardenhagen & Kober 2004). Continuous slopes; `per_cell` is make_body's, and 1 gives
/// `quadratic_spline`. A domain that sticks out of the box reaches the ghost node beyond the wall, which is folded in
/// by u_ghost = 2 u_wall - u_next (docs/method.md).
class ugimp {
  public:
    static constexpr std::string_view name = "ugimp";
    static constexpr int support = 3;
    static constexpr double shift = 0.5;
    /// Particles per cell along an axis, when undeformed. Throws `error` if there are none.
    explicit ugimp(int per_cell = 2) : half_(detail::half_of_domain("ugimp", per_cell)) {}

    template <class T> TAMIS_INLINE axis_weights<T, 3> on_axis(const T& r) const {
        return detail::averaged_tents(r, constant<T>(half_));
    }
    /// Half the width of the domain, in cell sides.
    double half_width() const { return half_; }

  private:
    double half_;
};

/// GIMP whose domains follow the particles' stretch: F_dd times `ugimp`'s along axis d, at most a cell's side
/// (contiguous particle GIMP; Wallstedt & Guilkey 2008). Domains stay parallel to the axes: a particle that turns by a
/// right angle has none left, and linear functions.
class cpgimp {
  public:
    static constexpr std::string_view name = "cpgimp";
    static constexpr int support = 3;
    static constexpr double shift = 0.5;
    using on_particles = fields<const field::deformation>;
    /// Particles per cell along an axis, when undeformed. Throws `error` if there are none.
    explicit cpgimp(int per_cell = 2) : half_(detail::half_of_domain("cpgimp", per_cell)), undeformed_(per_cell) {}

    template <class T> TAMIS_INLINE axis_weights<T, 3> on_axis(const T& r, const auto& p, int d) const {
        // Not 0, that the weights of lanes without a particle, where F is 0, are numbers.
        const T least = constant<T>(1e-6), most = constant<T>(0.5), wish = constant<T>(half_) * p[symbols::F](d, d);
        const T half = select(wish > least, select(wish > most, most, wish), least);
        return detail::averaged_tents(r, half);
    }
    /// The functions of an undeformed particle, for places where there is none.
    const ugimp& undeformed() const { return undeformed_; }

  private:
    double half_;
    ugimp undeformed_;
};

}  // namespace tamis
