#pragma once
#include "manufactured.hpp"

#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <concepts>
#include <utility>

namespace manufactured {

/// sin(pi X_i) and cos(pi X_i) of the undeformed place: all that the body force asks of it.
struct sine : tamis::vector_field {
    static constexpr std::string_view name = "sine";
};
struct cosine : tamis::vector_field {
    static constexpr std::string_view name = "cosine";
};

/// The body force by mass: u_tt - (dP_i/dX_i)/rho0, with P the nominal stress of `tamis::neo_hookean`.
template <int D> struct body_force {
    std::array<answer, D> axes;
    double mu, lambda;
    static constexpr bool by_fields = true;
    using on_particles = tamis::fields<const sine, const cosine>;
    auto acceleration_of(auto p, double t) const {
        using std::log;
        auto b = p[sine{}];
        using T = typename std::remove_cvref_t<decltype(b)>::Scalar;
        const T one = tamis::constant<T>(1);
        auto F = b;
        T J = one;
        for (int d = 0; d < D; ++d) {
            const double factor = axes[static_cast<std::size_t>(d)].factor(t);
            F[d] = one + tamis::constant<T>(factor * std::numbers::pi) * p[cosine{}][d];
            J = J * F[d];
        }
        const T both = tamis::constant<T>(mu + lambda) - tamis::constant<T>(lambda) * log(J);
        for (int d = 0; d < D; ++d) {
            const double factor = axes[static_cast<std::size_t>(d)].factor(t);
            const T stiffness = tamis::constant<T>(mu - young) + both / (F[d] * F[d]);
            b[d] = b[d] * stiffness * tamis::constant<T>(factor * std::numbers::pi * std::numbers::pi / density);
        }
        return b;
    }
};

/// The two walls across an axis.
template <int D> struct walls {
    int axis;
    bool holds(const auto& at) const { return at[axis] <= 1e-9 || at[axis] >= 1 - 1e-9; }
    auto velocity(const auto& at, auto) const { return (at * 0).eval(); }
    auto normal(const auto&) const { return tamis::point<D, double>(tamis::point<D, double>::Unit(axis)); }
};

template <int D> std::array<answer, D> axes_of(const manufactured_options& o) {
    std::array<answer, D> all{};
    for (int d = 0; d < D; ++d) all[static_cast<std::size_t>(d)] = {o.amplitude, phase(D, d)};
    return all;
}

template <int D> std::vector<tamis::point<D, double>> places_at_start(const manufactured_options& o) {
    const auto axes = axes_of<D>(o);
    const int n = o.cells * o.per_cell;
    std::vector<double> along[D];
    for (int d = 0; d < D; ++d)
        for (int k = 0; k < n; ++k) {
            const double X = (k + 0.5) / n;
            along[d].push_back(X + axes[static_cast<std::size_t>(d)].displacement(X, 0));
        }
    std::vector<tamis::point<D, double>> all(static_cast<std::size_t>(std::lround(std::pow(n, D))));
    std::size_t each = 0;
    for (auto& at : all) {
        std::size_t rest = each++;
        for (int d = 0; d < D; ++d) {
            at[d] = along[d][rest % static_cast<std::size_t>(n)];
            rest /= static_cast<std::size_t>(n);
        }
    }
    return all;
}

/// What of a run does not depend on its transfer and stress order is compiled once for a law and a set of fields.
template <int D, class Body> void start(Body& block, const manufactured_options& o) {
    using namespace tamis::symbols;
    const auto axes = axes_of<D>(o);
    for (auto p : block) {
        tamis::matrix<D, double> gradient = tamis::matrix<D, double>::Identity();
        for (int d = 0; d < D; ++d) {
            const answer& u = axes[static_cast<std::size_t>(d)];
            const double X = u.start_of(p[x][d], 0);
            p[sine{}][d] = std::sin(std::numbers::pi * X);
            p[cosine{}][d] = std::cos(std::numbers::pi * X);
            p[v][d] = u.velocity(X, 0);
            gradient(d, d) = u.stretch(X, 0);
        }
        p[F] = gradient;
        p[sigma] = block.law.at_deformation(gradient);
    }
}

template <int D, class Body> void measure(const Body& block, const manufactured_options& o, manufactured_result& r) {
    using namespace tamis::symbols;
    using std::numbers::pi;
    const auto axes = axes_of<D>(o);
    double exact_energy = 0, energy = 0, mass = 0;
    for (const auto p : block) {
        double place = 0, speed = 0, exact_speed = 0;
        tamis::matrix<D, double> exact = tamis::matrix<D, double>::Identity();
        for (int d = 0; d < D; ++d) {
            const answer& u = axes[static_cast<std::size_t>(d)];
            const double X = std::atan2(p[sine{}][d], p[cosine{}][d]) / pi;
            const double way = p[x][d] - X - u.displacement(X, o.time), v_exact = u.velocity(X, o.time);
            place += way * way;
            speed += (p[v][d] - v_exact) * (p[v][d] - v_exact);
            exact_speed += v_exact * v_exact;
            exact(d, d) = u.stretch(X, o.time);
        }
        place = std::sqrt(place) / o.amplitude;
        speed = std::sqrt(speed) / (o.amplitude * pi);
        r.place_l2 += place * place;
        r.velocity_l2 += speed * speed;
        // Written so that a NaN is kept.
        if (!(place <= r.place_max)) r.place_max = place;
        if (!(speed <= r.velocity_max)) r.velocity_max = speed;
        energy += p[m] * p[v].squaredNorm() / 2 + p[V] * block.law.energy(p, p[sigma]);
        exact_energy += p[m] * exact_speed / 2 + p[V] * block.law.energy_at(exact);
        mass += p[m];
    }
    const auto n = static_cast<double>(block.size());
    r.particles = block.size();
    r.place_l2 = std::sqrt(r.place_l2 / n);
    r.velocity_l2 = std::sqrt(r.velocity_l2 / n);
    // The mean of sin^2 is 1/2 along each axis.
    r.energy_error = (energy - exact_energy) / (mass * D * o.amplitude * o.amplitude * pi * pi / 4);
}

template <class Shape> Shape shape_for(const manufactured_options& o) {
    if constexpr (std::constructible_from<Shape, int>)
        return Shape{o.per_cell};
    else
        return Shape{};
}
template <class Scheme> Scheme scheme_for(const manufactured_options& o) {
    if constexpr (requires { Scheme{o.order}; })
        return Scheme{o.order};
    else
        return Scheme{};
}

template <int D, class Shape, class Scheme, class Order> manufactured_result run(const manufactured_options& o) {
    using namespace tamis;
    const neo_hookean law{.young = young, .poisson = o.poisson, .density = density};
    const body_force<D> push{axes_of<D>(o), tamis::detail::lame_mu(young, o.poisson),
                             tamis::detail::lame_lambda(young, o.poisson)};
    const auto held = []<int... d>(std::integer_sequence<int, d...>) { return conditions{walls<D>{d}...}; }
    (std::make_integer_sequence<int, D>{});
    const double low[D] = {};
    double high[D];
    std::fill(high, high + D, 1.);
    solver mpm{uniform_grid<D, double>(low, high, 1. / o.cells),
               shape_for<Shape>(o),
               scheme_for<Scheme>(o),
               Order{},
               held,
               push};
    auto block = mpm.make_body_at(law, places_at_start<D>(o), std::pow(1. / (o.cells * o.per_cell), D));
    start<D>(block, o);
    manufactured_result result;
    const auto begun = std::chrono::steady_clock::now();
    result.steps = integrate(mpm, bodies(block), interval{0, o.time}, courant{o.courant});
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    result.crossings = mpm.crossings();
    measure<D>(std::as_const(block), o, result);
    return result;
}

struct compiled {
    manufactured_composition names;
    manufactured_result (*run)(const manufactured_options&);
};
/// The compositions of each dimension, each in a file of its own.
const std::vector<compiled>& compiled_2d();
const std::vector<compiled>& compiled_3d();

}  // namespace manufactured
