#pragma once
// Rough bodies, and all that a run of them leaves behind, by the public interface only.
#include <tamis/tamis.hpp>

#include "account.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace bits {

using namespace tamis;

/// Numbers from -1 to 1 without pattern, the same on every machine (splitmix64).
class noise {
  public:
    explicit noise(std::uint64_t seed) : state_(seed) {}
    double operator()() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
    }

  private:
    std::uint64_t state_;
};

// No number here is round in binary, nor has a round inverse: products with a power of two are exact, and would hide
// that they are made in another order.

/// Side of all cells, and the lower corner of all boxes along each axis (m); the time step (s).
inline constexpr double side = 0.21, corner = -0.3, step_size = 0.0151;

/// A box of so many cells.
template <class Real, int D> uniform_grid<D, Real> box_of(const int (&cells)[D]) {
    Real lower[D], upper[D];
    for (int d = 0; d < D; ++d) {
        lower[d] = static_cast<Real>(corner);
        upper[d] = static_cast<Real>(corner + side * cells[d]);
    }
    return {lower, upper, static_cast<Real>(side)};
}
/// One of a size at which slots of every width have neighbours.
template <int D, class Real = double> uniform_grid<D, Real> box() {
    if constexpr (D == 1)
        return box_of<Real>({44});
    else if constexpr (D == 2)
        return box_of<Real>({24, 9});
    else
        return box_of<Real>({19, 7, 6});
}
/// From how many cells off the lower corner to how many a body reaches along an axis.
struct extent {
    double from, to;
};
/// A body that ends in the middle of cells, with room around.
inline constexpr double middle_ends[3] = {38.5, 17.5, 12.5};
template <int D> inline constexpr extent middle[3] = {{2.5, middle_ends[D - 1]}, {1.5, 6.}, {1.5, 4.}};

/// Two places per cell and axis, each off its own by up to `off` of its distance to the next.
template <int D, class Real>
std::vector<point<D, Real>> rough_points(const extent (&reach)[3], double off, std::uint64_t seed) {
    noise random(seed);
    std::vector<point<D, Real>> all;
    const double gap = side / 2;
    int count[3] = {1, 1, 1};
    for (int d = 0; d < D; ++d) count[d] = static_cast<int>(std::lround(2 * (reach[d].to - reach[d].from)));
    for (int k = 0; k < count[2]; ++k)
        for (int j = 0; j < count[1]; ++j)
            for (int i = 0; i < count[0]; ++i) {
                const int index[3] = {i, j, k};
                point<D, Real> at;
                for (int d = 0; d < D; ++d)
                    at[d] = static_cast<Real>(corner + side * reach[d].from + gap * (index[d] + 0.5 + off * random()));
                all.push_back(at);
            }
    return all;
}

/// Where a particle was made.
struct origin : vector_field {
    static constexpr std::string_view name = "origin";
};
/// What no policy asks for but the library keeps current.
using kept = fields<field::density, field::strain, field::deformation, field::update_error, origin>;

/// A velocity along (1, -0.6, 0.4) times `drift` with noise, stresses and densities with noise, and what laws store. A
/// particle's noise goes by its place: places in storage depend on how many lanes there are.
template <class Body> void roughen(Body& body, double drift, double speed, double stress, std::uint64_t seed = 5) {
    using namespace symbols;
    using real = typename Body::real;
    constexpr int D = Body::dim;
    constexpr double way[3] = {1, -0.6, 0.4};
    for (auto p : body) {
        noise random(seed);
        for (int d = 0; d < D; ++d)
            random = noise(std::bit_cast<std::uint64_t>(random() + static_cast<double>(p[x][d])));
        const auto about = [&](double share) { return static_cast<real>(1 + share * random()); };
        for (int d = 0; d < D; ++d) p[v][d] = static_cast<real>(drift * way[d] + speed * random());
        for (int d = 0; d < D; ++d)
            for (int e = 0; e <= d; ++e) p[sigma](d, e) += static_cast<real>(stress * random());
        p[m] *= about(0.2);
        if constexpr (Body::has(rho)) p[rho] = p[m] / p[V];
        if constexpr (Body::has(F))
            for (int d = 0; d < D; ++d)
                for (int e = 0; e < D; ++e) p[F](d, e) += static_cast<real>(0.05 * random());
        if constexpr (Body::has(E)) p[E] *= about(0.3);
        if constexpr (Body::has(field::pressure{})) p[field::pressure{}] *= about(0.1);
        if constexpr (Body::has(field::internal_energy{})) p[field::internal_energy{}] *= about(0.1);
        if constexpr (Body::has(origin{})) p[origin{}] = p[x];
    }
}

/// A body of the law at rough places, without more of them than its cells.
template <class Solver, class L, class... Extra> auto rough_body(const Solver& mpm, const L& law,
                                                                 const extent (&reach)[3], fields<Extra...> more = {},
                                                                 std::uint64_t seed = 3) {
    using real = typename Solver::real;
    double volume = 1;
    for (int d = 0; d < Solver::dim; ++d) volume *= side / 2;
    return mpm.make_body_at(law, rough_points<Solver::dim, real>(reach, 0.3, seed), static_cast<real>(volume), more);
}

/// A line of a number, a vector or a tensor.
template <class Value, class Which>
void put(account& out, std::string_view owner, std::string_view what, const Which& which, const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
        const auto number = static_cast<double>(value);
        out.line(owner, what, which, std::span(&number, 1));
    } else {
        constexpr int rows = Value::RowsAtCompileTime, columns = Value::ColsAtCompileTime;
        std::array<double, static_cast<std::size_t>(rows * columns)> numbers;
        std::size_t n = 0;
        for (int c = 0; c < columns; ++c)
            for (int r = 0; r < rows; ++r) numbers[n++] = static_cast<double>(value(r, c));
        out.line(owner, what, which, numbers);
    }
}

/// All fields of all particles, in the order of iteration. (Areas of faces under traction never change, and the
/// displacement is of use within a step only.)
template <class Body> void put_particles(account& out, const std::string& name, const Body& body) {
    long k = 0;
    for (const auto p : body) {
        put(out, name, "position", k, p[symbols::x]);
        const auto column = [&]<class F>(F, std::string_view what = F::name) {
            if constexpr (Body::has(F{})) put(out, name, what, k, p[F{}]);
        };
        column(field::velocity{});
        column(field::mass{});
        column(field::volume{});
        column(field::stress{});
        column(field::density{});
        column(field::strain{});
        column(field::deformation{});
        column(field::update_error{});
        column(field::internal_energy{});
        column(field::pressure{});
        column(field::modulus{});
        column(field::chosen<0>{}, "chosen0");
        column(field::chosen<1>{}, "chosen1");
        column(field::chosen<2>{}, "chosen2");
        column(field::chosen<3>{}, "chosen3");
        column(origin{});
        ++k;
    }
    out.tell(name + "size", static_cast<double>(body.size()));
    using tensor = matrix<Body::dim, typename Body::real>;
    if constexpr (requires { body.law.energy(*body.begin(), tensor()); })
        out.tell(name + "energy", static_cast<double>(elastic_energy(body)));
}

/// Does the solver give the field of its nodes to users? One that asks for a field the composition has not ends the
/// compilation, so the list of those stored is looked at, where there is such a list.
template <class Solver, class F> consteval bool offers() {
    if constexpr (!requires(const Solver& mpm, F f) { mpm.on_node(f, std::array<int, 3>{}); })
        return false;
    else if constexpr (requires { Solver::keeps(F{}); })
        return Solver::keeps(F{});
    else
        return stores<typename Solver::composition_type::node_fields, F>;
}

/// Fields of all nodes, and what the solver tells.
template <class Solver> void put_solver(account& out, const Solver& mpm) {
    const auto& grid = mpm.grid();
    const auto last = [&](int d) { return d < Solver::dim ? grid.cells(d) : 0; };
    const auto column = [&]<class F>(F) {
        if constexpr (offers<Solver, F>()) {
            for (int k = 0; k <= last(2); ++k)
                for (int j = 0; j <= last(1); ++j)
                    for (int i = 0; i <= last(0); ++i) {
                        const std::array<int, 3> node{i, j, k};
                        put(out, "node.", F::name, node, mpm.on_node(F{}, node));
                    }
        }
    };
    column(field::velocity{});
    // Of the two, headers before those of the step's text had only one, in one column.
    using scheme = std::remove_cvref_t<decltype(mpm.scheme())>;
    if constexpr (contains<on_nodes_t<typename scheme::mass_type>, field::filtered_velocity>)
        column(field::filtered_velocity{});
    else
        column(field::acceleration{});
    column(field::start_velocity{});
    column(field::strain_velocity{});
    column(field::full_acceleration{});
    column(field::mass_gradient{});
    column(field::mass_place{});

    long k = 0;
    for (const auto& node : mpm.reactions()) {
        put(out, "reaction.", "at", k, node.at);
        put(out, "reaction.", "force", k, node.reaction);
        put(out, "reaction.", "velocity", k, node.velocity);
        ++k;
    }
    out.tell("boundary_work", mpm.boundary_work());
    if constexpr (requires { mpm.touching(); }) {
        k = 0;
        for (const auto& node : mpm.touching()) {
            put(out, "touching.", "at", k, node.at);
            put(out, "touching.", "first", k, node.first);
            put(out, "touching.", "second", k, node.second);
            put(out, "touching.", "normal", k, node.normal);
            put(out, "touching.", "force", k, node.force);
            put(out, "touching.", "slides", k, node.slides ? 1 : 0);
            ++k;
        }
        if (k == 0) out.complain("no bodies touch");
        out.tell("friction_heat", mpm.friction_heat());
    }
    out.tell("series.terms", mpm.series().terms);
    out.tell("series.last_increment", mpm.series().last_increment);
    if constexpr (requires { mpm.load().alpha(); }) out.tell("alpha", mpm.load().alpha());
    out.tell("time", mpm.time());
    out.tell("steps", static_cast<double>(mpm.steps()));
    out.tell("crossings", static_cast<double>(mpm.crossings()));
}

template <class Solver, class... Body> void put_all(account& out, const Solver& mpm, const Body&... body) {
    int k = 0;
    (put_particles(out, "body" + std::to_string(k++) + ".", body), ...);
    put_solver(out, mpm);
    out.remark = std::to_string((body.size() + ...)) + " particles, " + std::to_string(mpm.steps()) + " steps, " +
                 std::to_string(mpm.crossings()) + " crossings" +
                 (mpm.steps_in_one_pass() > 0 ? ", " + std::to_string(mpm.steps_in_one_pass()) + " in one pass" : "") +
                 (mpm.steps_in_waves() > 0 ? ", " + std::to_string(mpm.steps_in_waves()) + " in waves" : "");
}

/// Steps of two sizes; half way a user has access to the particles.
template <class Solver, class... Body> void steps(Solver& mpm, int count, double dt, Body&... body) {
    using real = typename Solver::real;
    for (int k = 0; k < count; ++k) {
        if (k == count / 2) (static_cast<void>(body.begin()), ...);
        mpm.step(bodies(body...), static_cast<real>(k % 5 == 3 ? 0.61 * dt : dt));
    }
}

#if defined(_OPENMP)
inline auto two_threads() { return threads{2}; }
#else
inline auto two_threads() { return serial{}; }
#endif

inline linear_elastic rubber() { return {.young = 9.7, .poisson = 0.3, .density = 1.9}; }

/// The order is USL- where none is named, whatever the default of the headers that are compared.
template <class Grid, class... Policies> auto solver_of(const Grid& grid, const Policies&... policies) {
    if constexpr ((StressOrder<Policies> || ...))
        return solver{grid, policies...};
    else
        return solver{grid, policies..., usl_minus{}};
}

/// One rough body, some steps, and what they leave.
template <class Grid, class L, class Extra, class... Policies> void one_body(account& out, const Grid& grid,
                                                                             const extent (&reach)[3], const L& law,
                                                                             Extra more, const Policies&... policies) {
    auto mpm = solver_of(grid, policies...);
    auto body = rough_body(mpm, law, reach, more);
    roughen(body, 1.2, 0.4, 0.5);
    steps(mpm, 14, step_size, body);
    put_all(out, mpm, body);
    if (body.has(field::position{}) && mpm.crossings() < body.size() / 4) out.complain("few particles change cells");
}
/// One of rubber in the middle of the box.
template <int D, class Extra, class... Policies> void block(account& out, Extra more, const Policies&... policies) {
    one_body(out, box<D>(), middle<D>, rubber(), more, policies...);
}
/// One above four megabytes, so that passes over it are run together.
template <class Extra, class Grid, class... Policies>
void large(account& out, const Grid& grid, const extent (&reach)[3], Extra more, const Policies&... policies) {
    auto mpm = solver_of(grid, policies...);
    auto body = rough_body(mpm, rubber(), reach, more);
    roughen(body, 2, 0.4, 0.5);
    steps(mpm, 5, step_size, body);
    put_all(out, mpm, body);
    if (mpm.steps_in_waves() == 0) out.complain("no step is made in waves");
}

/// The lower end along x sways, and the lower wall along the last axis holds what is across it.
template <int D, class Real = double> auto swaying() {
    const Real reach = static_cast<Real>(corner + 4.1 * side);
    const auto left = [=](const auto& at) { return at[0] < reach; };
    const auto speed = [](const auto& at, auto t) {
        auto u = (at * 0).eval();
        for (int d = 0; d < D; ++d) u[d] = static_cast<Real>(0.4 * std::sin(9. * t + d + at[d]));
        return u;
    };
    if constexpr (D == 1)
        return prescribed{left, speed};
    else {
        const Real low = static_cast<Real>(corner + 2.1 * side);
        point<D, Real> up = point<D, Real>::Zero();
        up[D - 1] = 1;
        const auto floor = [=](const auto& at) { return at[D - 1] < low && !left(at); };
        return conditions{prescribed{left, speed}, slip{floor, up}};
    }
}

}  // namespace bits
