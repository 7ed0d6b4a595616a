#pragma once
#include <tamis/core/error.hpp>
#include <tamis/core/names.hpp>
#include <tamis/core/space.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string_view>

namespace tamis {

/// Bodies in one velocity field: they stick where they share nodes, and never slide or part. The default, and free.
struct one_velocity {
    static constexpr bool never = true;
};

// Laws: how much tangential impulse goes with a normal one (>= 0) where sticking would take `stick` (N s).

/// A perfect interface: the bodies move as one on shared nodes, in tension too.
struct bonded {
    static constexpr std::string_view name = "bonded";
    static constexpr bool always = true;
    template <class real> real tangential(const real&, const real& stick) const { return stick; }
};
/// Sliding without friction.
struct frictionless {
    static constexpr std::string_view name = "frictionless";
    template <class real> real tangential(const real&, const real&) const { return real(0); }
};
/// Coulomb friction: the tangential impulse is at most mu times the normal one.
class coulomb {
  public:
    static constexpr std::string_view name = "coulomb";
    /// Throws `error` if mu is negative.
    explicit coulomb(double mu) : mu_(mu) {
        if (!(mu >= 0)) throw error(detail::sentence("coulomb: mu is ", mu, "; give 0 or more"));
    }
    /// Coefficient of friction.
    double mu() const { return mu_; }
    template <class real> real tangential(const real& normal, const real& stick) const {
        return std::min<real>(static_cast<real>(mu_) * normal, stick);
    }

  private:
    double mu_;
};

// Normals, from the first body to the second.

/// Along the difference of the two bodies' sums G_pi M_p, which point out of them.
struct normal_by_mass {
    using on_nodes = fields<field::mass_gradient>;
};
/// Of the plane that divides the particles of the two bodies around the node most probably: logistic regression (Nairn,
/// Hammerquist & Smith 2020, CMAME 362, 112859). The default.
struct normal_by_regression {
    /// How far from the node it looks at particles, in sides of a cell: no less than the shape's functions reach.
    double reach = 2.5;
    /// Of |n|^2, n in sides of a cell: the less, the more it is the particles nearest to the plane that count.
    double penalty = 1e-7;
};
/// The same everywhere, or normal(at): a unit vector from the body named first in bodies(...) to the later one.
template <class Normal> struct given_normal {
    /// A vector, or a function of the place (m).
    Normal normal;
    /// The normal at a place (m).
    template <class Point> Point operator()(const Point& at) const {
        // Asked this way round: an Eigen vector can be "called" with another, as with a list of indices.
        if constexpr (std::convertible_to<Normal, Point>)
            return normal;
        else {
            static_assert(
                std::invocable<const Normal&, const Point&>,
                "tamis: the contact's normal is neither a vector of the grid's dimension nor a function of the "
                "place; give as many components as the grid has axes");
            return normal(at);
        }
    }
};
template <class Normal> given_normal(Normal) -> given_normal<Normal>;

/// Detection: bodies touch on a node they share if they approach there.
struct by_approach {};
/// Bodies touch on a node they share if they approach there and are nearer to each other than `cells` cell sides: by
/// their particles' mean places, sum S_pi M_p X_p / m.
struct by_separation {
    using on_nodes = fields<field::mass_place>;
    /// In sides of a cell.
    double cells = 0.8;
};
/// Bodies touch on a node they share if they approach there and the extents of their particles meet: where their
/// nearest particles within the shape's reach of the node, each by its deformed domain, are no farther apart along the
/// normal than `cells` cell sides (Nairn, Hammerquist & Smith 2020). The default.
struct by_extents {
    /// In sides of a cell.
    double cells = 1e-3;
};

namespace detail {

/// What contact does to the increments of a full mass matrix's series, beyond the lumped velocity.
enum class contact_terms { untouched, each, first, net };

}  // namespace detail

/// Where contact enters a full mass matrix's series, of FMPM(k) and of XPIC(k).
namespace contact_method {

/// On the lumped momentum and on every further increment (docs/method.md, Contact), as the lumped momentum decided who
/// sticks, slides or is apart. The default.
struct incremental {
    static constexpr bool on_momentum = true, on_velocity = false;
    static constexpr auto terms = detail::contact_terms::each;
};
/// The same, but who touches and how is decided anew with every increment, for the sum so far: that obeys the law.
struct net {
    static constexpr bool on_momentum = true, on_velocity = false;
    static constexpr auto terms = detail::contact_terms::net;
};
/// On the lumped momentum only, before the series.
struct lumped {
    static constexpr bool on_momentum = true, on_velocity = false;
    static constexpr auto terms = detail::contact_terms::untouched;
};
/// XPIC contact, and the like for FMPM (Nairn, Hammerquist & Smith 2020): on the lumped momentum; of its change at the
/// step's start, d = J/m, only the last term A^(k-1) d is left in the series, so that it filters what particles have
/// and not what contact did.
struct filtered {
    static constexpr bool on_momentum = true, on_velocity = false;
    static constexpr auto terms = detail::contact_terms::first;
};
/// On the momentum of the step's start and, in place of p+, on the velocity the series gave, after it.
struct velocity {
    static constexpr bool on_momentum = false, on_velocity = true;
    static constexpr auto terms = detail::contact_terms::untouched;
};

}  // namespace contact_method

/// Each body has a velocity field of its own; on nodes that two of them reach their momenta are corrected.
///
///     solver mpm{grid, fmpm<2>{}, contact{coulomb{0.3}}};
///     mpm.step(bodies(block, floor), dt);
template <class Law, class Normal = normal_by_regression, class Detection = by_extents,
          class Method = contact_method::incremental>
struct contact {
    static_assert(
        requires(const Law& l) {
            { l.tangential(1., 1.) } -> std::convertible_to<double>;
        },
        "tamis: the contact law has no tangential(normal, stick), the tangential impulse that goes with a "
        "normal one; give it that member, or take bonded, frictionless or coulomb");
    /// Type of the law.
    using law_type = Law;
    /// Type of the method.
    using method_type = Method;
    /// Do the bodies stick always?
    static constexpr bool always = requires { requires Law::always; };
    /// Are normals made of the masses?
    static constexpr bool by_mass = !always && std::same_as<Normal, normal_by_mass>;
    /// Are the particles' mean places needed?
    static constexpr bool by_place = !always && std::same_as<Detection, by_separation>;
    /// Are normals fitted between the particles?
    static constexpr bool by_regression = !always && std::same_as<Normal, normal_by_regression>;
    /// Are they neither of these, but told?
    static constexpr bool by_given = !always && !by_mass && !by_regression;
    /// Are the extents of particles needed?
    static constexpr bool by_extents = !always && std::same_as<Detection, tamis::by_extents>;
    /// Does it look at the particles around nodes in every step?
    static constexpr bool by_particles = by_regression || by_extents;
    using on_nodes = typename detail::concatenate<detail::fields_if<by_mass, field::mass_gradient>,
                                                  detail::fields_if<by_place, field::mass_place>>::type;
    /// What happens where bodies touch.
    Law law;
    /// In which direction.
    [[no_unique_address]] Normal normal{};
    /// When they touch.
    [[no_unique_address]] Detection detection{};
    /// Where that enters the series of a full mass matrix.
    [[no_unique_address]] Method method{};
};
template <class Law> contact(Law) -> contact<Law>;
template <class Law, class Normal> contact(Law, Normal) -> contact<Law, Normal>;
template <class Law, class Normal, class Detection> contact(Law, Normal, Detection) -> contact<Law, Normal, Detection>;
template <class Law, class Normal, class Detection, class Method> contact(Law, Normal, Detection, Method)
    -> contact<Law, Normal, Detection, Method>;

}  // namespace tamis
