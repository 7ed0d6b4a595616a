#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "catch.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

template <int Dim> uniform_grid<Dim, double> box() {
    if constexpr (Dim == 1)
        return {{0.}, {21.}, 1.};
    else if constexpr (Dim == 2)
        return {{0., 0.}, {11., 3.}, 1.};
    else
        return {{0., 0., 0.}, {9., 2., 2.}, 1.};
}

struct no_law {
    double density = 1;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto) const { return L; }
};
/// Members of a kernel that sums, and does nothing else.
template <class Sums> struct summing {
    using gathers = detail::gathers<>;
    using sums = Sums;
    using reads = fields<field::mass, field::velocity>;
    static constexpr bool sums_by_slopes = false, sums_by_offsets = false, updates = false, moves = false;
    static detail::no_look look() { return {}; }
};
struct mass_and_momentum : summing<fields<field::mass, field::momentum>> {
    auto make(const auto& slot, const auto&, const auto&) const {
        const auto mass = slot.template get<field::mass>();
        const auto momentum = (mass * slot.template get<field::velocity>()).eval();
        using namespace detail;
        return terms<plain_term<field::mass, std::remove_const_t<decltype(mass)>>,
                     plain_term<field::momentum, std::remove_const_t<decltype(momentum)>>>{
            {plain<field::mass>(mass)}, {plain<field::momentum>(momentum)}};
    }
};
/// Members of a kernel that gathers, and calls f(slot, occupied, gathered).
template <class Gathers, class F> struct gathering {
    using gathers = Gathers;
    using sums = fields<>;
    using reads = fields<>;
    static constexpr bool sums_by_slopes = false, sums_by_offsets = false, updates = true, moves = false;
    F f;
    static detail::no_look look() { return {}; }
    void update(auto& slot, std::uint32_t occupied, const auto&, const auto& g, const auto&) const {
        f(slot, occupied, g);
    }
};
template <class Gathers, class Sweeps, class Body, class F> void gather(Sweeps& sweeps, Body& body, const F& f) {
    sweeps.gather_each(body, gathering<Gathers, F>{f});
}

/// Component d of a velocity that is linear in the place, and its slopes.
double linear_velocity(const auto& at, int d) { return 3. + d + at[0] - 2 * at[at.size() - 1]; }
double slope_along(int axis, int dim) { return (axis == 0 ? 1. : 0.) - (axis == dim - 1 ? 2. : 0.); }

template <int Dim, class F> void each_node(const uniform_grid<Dim, double>& grid, F f) {
    std::array<int, 3> n{0, 0, 0};
    for (int d = 0; d < Dim; ++d) n[static_cast<std::size_t>(d)] = grid.cells(d);
    for (int k = 0; k <= n[2]; ++k)
        for (int j = 0; j <= n[1]; ++j)
            for (int i = 0; i <= n[0]; ++i) f(std::array<int, 3>{i, j, k});
}

/// Particles anywhere in a box, of any mass and velocity, and their sweeps.
template <int Dim, class Shape, class Lanes, std::size_t Count = 130> struct scene {
    using C = detail::composition<uniform_grid<Dim, double>, Shape, pic, Lanes>;
    using S = typename C::S;
    using solver_type = solver<uniform_grid<Dim, double>, Shape, pic, Lanes>;
    solver_type mpm{box<Dim>(), Shape{}, pic{}, Lanes{}};
    typename solver_type::template body_for<no_law> body = mpm.make_body_at(no_law{}, points(), 1.);
    detail::lattice<S, Shape> lattice{box<Dim>()};
    Shape functions{};
    serial run{};
    using node_fields = fields<field::mass, field::momentum, field::force, field::velocity, field::acceleration>;
    detail::sweeps<S, Shape, node_fields, serial, true> sweeps{functions, lattice, run};

    scene() {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> number(0, 1);
        for (auto p : body) {
            p[m] = number(random);
            for (int d = 0; d < Dim; ++d) p[v][d] = number(random) - 0.5;
        }
        body.store().template arrange<Shape::support>();
        std::vector<std::uint32_t> blocks;
        for (std::size_t k = 0; k < lattice.size() / S::width; ++k) blocks.push_back(static_cast<std::uint32_t>(k));
        sweeps.nodes().set_active(blocks);
    }
    static std::vector<point<Dim, double>> points() {
        std::mt19937 random(11);
        std::vector<point<Dim, double>> all(Count);
        for (auto& at : all)
            for (int d = 0; d < Dim; ++d)
                at[d] = std::uniform_real_distribution<double>(0, box<Dim>().upper()[d])(random);
        return all;
    }
    double& node(auto field, const std::array<int, 3>& index, int d = 0) {
        return sweeps.nodes().template at<decltype(field)>(lattice.node_place(index), d);
    }
};

template <int Dim, class Shape, class Lanes> void transfers_are_complete() {
    using S = typename scene<Dim, Shape, Lanes>::S;
    CAPTURE(Dim, Shape::support, S::width);
    scene<Dim, Shape, Lanes> s;
    s.sweeps.scatter(s.body, mass_and_momentum{});
    // The nodes of the box have all mass, and its moments: sums of u . p over nodes are those of u . M V over
    // particles.
    double mass = 0, power = 0;
    for (const auto p : std::as_const(s.body)) {
        mass -= p[m];
        for (int d = 0; d < Dim; ++d) power -= p[m] * p[v][d] * linear_velocity(p[x], d);
    }
    each_node(box<Dim>(), [&](const auto& index) {
        mass += s.node(field::mass{}, index);
        for (int d = 0; d < Dim; ++d) {
            const double u = linear_velocity(box<Dim>().node(index), d);
            power += s.node(field::momentum{}, index, d) * u;
            s.node(field::acceleration{}, index, d) = u;
        }
    });
    CHECK(std::abs(mass) < 1e-12);
    CHECK(std::abs(power) < 1e-11);

    double slope_error = 0;
    gather<detail::gathers<fields<field::acceleration>, fields<field::acceleration>>>(
        s.sweeps, s.body, [&](auto& slot, std::uint32_t occupied, const auto& g) {
            slot.template get<field::velocity>() = g.template sum<field::acceleration>();
            for (int c = 0; c < Dim; ++c)
                for (int d = 0; d < Dim; ++d) {
                    double slopes[S::width];
                    lane<typename S::scalar>::store(slopes, g.template gradient<field::acceleration>()(c, d));
                    for (int l = 0; l < S::width; ++l)
                        if (occupied >> l & 1u)
                            slope_error = std::max(slope_error, std::abs(slopes[l] - slope_along(d, Dim)));
                }
        });
    CHECK(slope_error < 1e-13);
    for (const auto p : std::as_const(s.body))
        for (int d = 0; d < Dim; ++d) CHECK(std::abs(p[v][d] - linear_velocity(p[x], d)) < 4e-14);
}

/// As a sweep of FMPM(k) sums: few numbers a node, so that rows of nodes are summed together where there are registers.
template <bool Slopes> struct momentum_alone : summing<fields<field::momentum>> {
    static constexpr bool sums_by_slopes = Slopes;
    auto make(const auto& slot, const auto&, const auto&) const {
        return detail::plain<field::momentum>(
            (slot.template get<field::mass>() * slot.template get<field::velocity>()).eval());
    }
};

/// Sums of more particles than are looked at in one go, against weights looked up one by one.
template <int Dim, class Shape, class Lanes, bool Slopes> void sums_of_crowded_cells() {
    using scene_type = scene<Dim, Shape, Lanes, 4000>;
    CAPTURE(Dim, Shape::support, scene_type::S::width, Slopes);
    scene_type s;
    std::uint32_t most = 0;
    for (const auto& t : s.body.store().tiles) most = std::max(most, t.count);
    CHECK(most > 16);
    s.sweeps.scatter(s.body, momentum_alone<Slopes>{});
    std::map<std::array<int, 3>, point<Dim, double>> sums;
    each_node(box<Dim>(), [&](const auto& index) { sums[index] = point<Dim, double>::Zero(); });
    for (const auto p : std::as_const(s.body))
        each_near_node(s.lattice, s.functions, p,
                       [&](const auto& node) { sums[node.index] += node.weight * p[m] * p[v]; });
    double error = 0;
    for (const auto& [index, sum] : sums)
        for (int d = 0; d < Dim; ++d) error = std::max(error, std::abs(s.node(field::momentum{}, index, d) - sum[d]));
    CHECK(error < 1e-12);
}

/// The quadratic splines without a pivot: every node's weight is used.
struct without_pivot {
    [[maybe_unused]] static constexpr std::string_view name = "quadratic without pivot";
    static constexpr int support = 3;
    static constexpr double shift = 0.5;
    template <class T> auto on_axis(const T& r) const { return quadratic_spline{}.on_axis(r); }
};
/// All sums of the step: more than registers hold, so that they are made in groups.
struct all_sums : summing<fields<field::mass, field::momentum, field::force>> {
    static constexpr bool sums_by_slopes = true;
    auto make(const auto& slot, const auto&, const auto&) const {
        const auto mass = slot.template get<field::mass>();
        const auto momentum = (mass * slot.template get<field::velocity>()).eval();
        using namespace detail;
        using vector = std::remove_const_t<decltype(momentum)>;
        return terms<plain_term<field::mass, std::remove_const_t<decltype(mass)>>, plain_term<field::momentum, vector>,
                     plain_term<field::force, vector>>{
            {plain<field::mass>(mass)}, {plain<field::momentum>(momentum)}, {plain<field::force>(momentum)}};
    }
};

/// Sums on nodes and what particles, known by their masses, gather of them.
template <int Dim, class Shape, class Lanes> auto there_and_back() {
    scene<Dim, Shape, Lanes> s;
    // By their places: the order of particles is that of storage.
    for (auto p : s.body) {
        const point<Dim, double> at = p[x];
        p[m] = 1 + 0.5 * std::sin(31 * at[0] + 17 * at[Dim - 1]);
        for (int d = 0; d < Dim; ++d) p[v][d] = std::sin(7 * at[0] + 3 * d);
    }
    s.sweeps.scatter(s.body, all_sums{});
    std::vector<double> sums;
    each_node(box<Dim>(), [&](const auto& index) {
        sums.push_back(s.node(field::mass{}, index));
        for (int d = 0; d < Dim; ++d) {
            sums.push_back(s.node(field::momentum{}, index, d));
            sums.push_back(s.node(field::force{}, index, d));
        }
    });
    gather<detail::gathers<fields<field::force>, fields<field::momentum>>>(
        s.sweeps, s.body, [&](auto& slot, auto, const auto& g) {
            const auto& slope = g.template gradient<field::momentum>();
            slot.template get<field::velocity>() = g.template sum<field::force>();
            for (int d = 0; d < Dim; ++d)
                slot.template get<field::velocity>()[d] += slope(d, (d + 1) % Dim) + 2. * slope(d, d);
        });
    std::map<double, point<Dim, double>> gathered;
    for (const auto p : std::as_const(s.body)) gathered[p[m]] = p[v];
    return std::pair(sums, gathered);
}
template <int Dim, class Lanes> void same_as_plain() {
    constexpr int width = scene<Dim, quadratic_spline, Lanes>::S::width;
    CAPTURE(Dim, width);
    const auto plain = there_and_back<Dim, without_pivot, one_lane>();
    const auto fast = there_and_back<Dim, quadratic_spline, Lanes>();
    REQUIRE(plain.first.size() == fast.first.size());
    double on_nodes = 0, on_particles = 0;
    for (std::size_t k = 0; k < plain.first.size(); ++k)
        on_nodes = std::max(on_nodes, std::abs(plain.first[k] - fast.first[k]));
    for (const auto& [mass, value] : plain.second)
        on_particles = std::max(on_particles, (value - fast.second.at(mass)).norm());
    CHECK(on_nodes < 1e-13);
    CHECK(on_particles < 1e-13);
}

}  // namespace

TEST_CASE("sweeps: with a pivot and in lanes nodes and particles get what they get of every weight one by one") {
    STATIC_REQUIRE(detail::pivot_of<quadratic_spline> == 1);
    STATIC_REQUIRE(detail::pivot_of<without_pivot> == -1);
    STATIC_REQUIRE(detail::pivot_of<linear> == -1);
    STATIC_REQUIRE(detail::pivot_of<cubic_spline> == -1);
    same_as_plain<1, native_lanes>();
    same_as_plain<2, native_lanes>();
    same_as_plain<3, native_lanes>();
    same_as_plain<3, one_lane>();
}

TEST_CASE("sweeps: around a pivot a constant field is gathered exactly along a row") {
    scene<1, quadratic_spline, native_lanes> s;
    each_node(box<1>(), [&](const auto& index) { s.node(field::acceleration{}, index) = 0.1; });
    gather<detail::gathers<fields<field::acceleration>>>(s.sweeps, s.body, [&](auto& slot, auto, const auto& g) {
        slot.template get<field::velocity>() = g.template sum<field::acceleration>();
    });
    // Beside walls ghost nodes have no value.
    int inside = 0;
    for (const auto p : std::as_const(s.body)) {
        if (p[x][0] < 0.5 || p[x][0] > 20.5) continue;
        ++inside;
        CHECK(p[v][0] == 0.1);
    }
    CHECK(inside > 100);
}

TEST_CASE("sweeps: to nodes and back, mass, first moments, linear functions and slopes are kept") {
    transfers_are_complete<1, linear, native_lanes>();
    transfers_are_complete<1, cubic_spline, one_lane>();
    transfers_are_complete<2, quadratic_spline, one_lane>();
    transfers_are_complete<2, cubic_spline, native_lanes>();
    transfers_are_complete<3, quadratic_spline, native_lanes>();
#if TAMIS_VECTOR_BYTES > 0
    // Fewer lanes than a row has nodes: sums go to the nodes another way.
    transfers_are_complete<1, cubic_spline, lanes<2>>();
    transfers_are_complete<2, cubic_spline, lanes<2>>();
#endif
}

TEST_CASE("sweeps: with and without slopes, sums of crowded cells are those of every weight one by one") {
    sums_of_crowded_cells<2, cubic_spline, native_lanes, false>();
    sums_of_crowded_cells<3, quadratic_spline, native_lanes, false>();
    sums_of_crowded_cells<3, quadratic_spline, native_lanes, true>();
    sums_of_crowded_cells<3, cubic_spline, native_lanes, false>();
    sums_of_crowded_cells<3, linear, native_lanes, false>();
    sums_of_crowded_cells<3, quadratic_spline, one_lane, false>();
}
