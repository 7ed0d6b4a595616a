#pragma once
#include <tamis/core/names.hpp>
#include <tamis/core/tensor.hpp>
#include <tamis/material/grains.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <type_traits>

namespace tamis {

/// Soils and grains at any strain: Mohr and Coulomb's pyramid in Hencky's strain, with a flow rule of its own angle,
/// and the volume that separated grains have gained kept in mind as `drucker_prager` does. With e = 1/2 ln b, b the
/// elastic left Cauchy-Green tensor, and the principal stresses tau_1 >= tau_2 >= tau_3, the Kirchhoff stress is
///
///     tau = 2 mu dev e + kappa tr e 1,    tr tau/3 <= tension
///     (1 + sin(friction)) tau_1 - (1 - sin(friction)) tau_3 <= 2 cohesion cos(friction)
///
/// It slides along (1 + s, 0, -(1 - s)) with s = sin(dilatancy) in the principal axes, and where two principal stresses
/// are equal along two such planes: the return in closed form by regions of de Souza Neto, Peric & Owen 2008
/// (*Computational Methods for Plasticity*, ch. 8) and Clausen, Damkilde & Andersen 2006. Without friction it is
/// Tresca's prism. Beyond the apex, or the tension that is given, the mean stress stays and what is stretched further
/// is open. It is the mean stress that is bounded, not the largest principal one: what opens is kept as a volume, which
/// has no direction; until it has closed, that mean stress is borne. `plastic_strain` grows by sqrt(2/3) |dev| of what
/// slid. Axes beyond the dimension are held: plane strain in 2D, uniaxial strain in 1D. A particle that is
/// turned inside out gets a stress that is no number, which stops the run. Pa and kg/m^Dim.
struct mohr_coulomb {
    /// Young's modulus (Pa), Poisson's ratio, density (kg/m^Dim).
    double young, poisson = 0, density;
    /// Angle of friction, from 0 to less than 90 (degrees), cohesion (Pa).
    double friction, cohesion = 0;
    /// Angle of dilatancy, from 0 to that of friction (degrees).
    double dilatancy = 0;
    /// Largest mean stress (Pa); the apex bounds it too.
    double tension = std::numeric_limits<double>::infinity();
    using on_particles = fields<field::elastic_cauchy_green, field::opening, field::plastic_strain>;
    static constexpr bool three_by_three = true;
    static constexpr std::string_view name = "mohr_coulomb";

    void check() const { detail::check_grains(*this); }
    /// Nothing is deformed at first.
    void start(auto p) const {
        using real = std::remove_cvref_t<decltype(p[open])>;
        p[be] = detail::isotropic<matrix<3, real>>(real(1));
    }
    /// A particle whose elastic strain is none is refused.
    void check(auto p) const { detail::check_elastic_cauchy_green(detail::to_double(p[be].trace())); }
    /// Speed of longitudinal waves where nothing is deformed (m/s); sideways the material is held, in 1D too.
    double wave_speed(int) const { return detail::elastic_wave_speed(3, young, poisson, density); }

    /// Kirchhoff stress of a particle (Pa), out of the plane too: 3 x 3.
    auto full_stress(auto&& p) const { return elastic().stress_of(p[be]); }
    /// Stored elastic energy of a particle per reference volume (J/m^Dim); of its state alone.
    auto energy(auto&& p, const auto&) const { return elastic().energy_of(p[be]); }

    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        static_assert(Tensor::RowsAtCompileTime == 3,
                      "tamis: mohr_coulomb computes with 3x3 tensors; a law that calls it says `static constexpr bool "
                      "three_by_three = true;`");
        using std::sqrt;
        using T = typename Tensor::Scalar;
        const T zero = constant<T>(0);
        auto trial = detail::hencky_trial(Tensor(p[be]), L, T(dt));
        in_order<0, 1>(trial);
        in_order<1, 2>(trial);
        in_order<0, 1>(trial);

        const detail::strain_parts<T> e = detail::parts_of(trial.values);
        // What has come apart closes first.
        const T stretch = e.trace + p[open];
        const double limit = 2 * cohesion * std::cos(friction * degree), most = largest_stretch();
        const auto inside = slide(e.dev, stretch, elastic().kappa, limit);
        // The pyramid's section under the largest mean stress.
        const double section = limit - 2 * sine(friction) * elastic().kappa * most;
        const auto bounded = slide(e.dev, stretch, 0, section);

        const auto opens = inside.trace > constant<T>(most);
        p[open] = select(opens, bounded.trace - constant<T>(most), zero);
        detail::strain_parts<T> left, slid;
        left.trace = select(opens, constant<T>(most), inside.trace);
        for (std::size_t a = 0; a < 3; ++a) {
            left.dev[a] = select(opens, bounded.dev[a], inside.dev[a]);
            slid.dev[a] = e.dev[a] - left.dev[a];
        }
        p[alpha] += constant<T>(std::sqrt(2. / 3)) * sqrt(slid.square());
        p[be] = trial.with(detail::squares_of(left));
        return trial.with(elastic().stress(left));
    }

  private:
    static constexpr field::elastic_cauchy_green be{};
    static constexpr field::opening open{};
    static constexpr field::plastic_strain alpha{};
    static constexpr double degree = std::numbers::pi / 180;

    detail::hencky_elastic elastic() const { return {young, poisson}; }
    static double sine(double degrees) { return std::sin(degrees * degree); }
    /// tr e at the apex or the largest tension; finite, that it can be computed with.
    double largest_stretch() const {
        const double apex = friction > 0 ? cohesion / std::tan(friction * degree) : tension;
        return std::min(std::min(apex, tension) / elastic().kappa, 1e3);
    }

    /// A trial strain, its parts in falling order, led back to 2 mu a.dev e + 2 sin(friction) bulk tr e <= limit for
    /// all a of the pyramid's planes; `bulk` is 0 where the mean stress is held and the limit has it. First along the
    /// plane of the largest and the smallest stress; if that changes their order, to the edge where both are equal that
    /// passed each other. There the flow has two planes' directions, and their sum is what the component that stays
    /// alone, the smallest or the largest, tells. Beyond the apex both orders change, and either edge lies beyond it
    /// too.
    template <class T>
    detail::strain_parts<T> slide(const std::array<T, 3>& dev, const T& stretch, double bulk, double limit) const {
        const T zero = constant<T>(0);
        const double A = sine(friction), B = sine(dilatancy), G = elastic().mu, swells = 4 * bulk * A * B;
        const T beyond = constant<T>(2 * A * bulk) * stretch - constant<T>(limit);

        const T over = constant<T>(2 * G * (1 + A)) * dev[0] - constant<T>(2 * G * (1 - A)) * dev[2] + beyond;
        const T flow = select(over > zero, over / constant<T>(4 * G * (1 + A * B / 3) + swells), zero);
        const std::array<T, 3> plane{dev[0] - constant<T>(1 + B / 3) * flow, dev[1] + constant<T>(2 * B / 3) * flow,
                                     dev[2] + constant<T>(1 - B / 3) * flow};

        // tau_1 = tau_2, the edge through triaxial compression, and tau_2 = tau_3, that through extension.
        const T flow_12 =
                    (beyond - constant<T>(G * (3 - A)) * dev[2]) / constant<T>(G * (3 - A) * (1 - B / 3) + swells),
                flow_23 =
                    (beyond + constant<T>(G * (3 + A)) * dev[0]) / constant<T>(G * (3 + A) * (1 + B / 3) + swells);
        const T stretch_12 = stretch - constant<T>(2 * B) * flow_12,
                stretch_23 = stretch - constant<T>(2 * B) * flow_23;
        // By the pyramid's size there, that a far trial's rounding does not leave it.
        const T x = (constant<T>(limit) - constant<T>(2 * A * bulk) * stretch_12) / constant<T>(2 * G * (3 - A)),
                y = (constant<T>(limit) - constant<T>(2 * A * bulk) * stretch_23) / constant<T>(2 * G * (3 + A));

        const auto at_12 = plane[0] < plane[1], at_23 = plane[1] < plane[2];
        const auto chosen = [&](const T& on_12, const T& on_23, const T& on_plane) {
            return T(select(at_12, on_12, select(at_23, on_23, on_plane)));
        };
        return {{chosen(x, constant<T>(2) * y, plane[0]), chosen(x, zero - y, plane[1]),
                 chosen(constant<T>(-2) * x, zero - y, plane[2])},
                chosen(stretch_12, stretch_23, stretch - constant<T>(2 * B) * flow)};
    }
    /// The larger one of principal values first, each with its axis.
    template <int P, int Q, class T> static void in_order(detail::principal_form<T>& form) {
        const auto swaps = form.values[P] < form.values[Q];
        const auto exchange = [&](T& first, T& second) {
            const T larger = select(swaps, second, first);
            second = select(swaps, first, second);
            first = larger;
        };
        exchange(form.values[P], form.values[Q]);
        for (int i = 0; i < 3; ++i) exchange(form.axes(i, P), form.axes(i, Q));
    }
};

}  // namespace tamis
