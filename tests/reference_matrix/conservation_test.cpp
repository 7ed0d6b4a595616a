// The two-step Taylor-Galerkin scheme agrees with dense matrices, for three laws, the shapes, masses and ends.
#include <tamis/conservation/taylor_galerkin.hpp>
#include <tamis/shape/cubic_spline.hpp>
#include <tamis/shape/linear.hpp>
#include <tamis/shape/quadratic_spline.hpp>

#include "burgers.hpp"
#include "reference/conservation.hpp"

#include "catch.hpp"

#include <random>

using namespace tamis;
using reference::shape_kind;

namespace {

constexpr shape_kind kind_of(const linear&) { return shape_kind::linear; }
constexpr shape_kind kind_of(const quadratic_spline&) { return shape_kind::quadratic_spline; }
constexpr shape_kind kind_of(const cubic_spline&) { return shape_kind::cubic_spline; }

constexpr int cells = 11;
constexpr double lower = -0.5, upper = 0.6, spacing = 0.1, dt = 0.02;

double push(double t) { return 0.3 + 0.2 * std::sin(9 * t); }

/// Steps both from rough states around `mean`, and compares all nodes; `set` brings flux, k and what ends hold.
template <class Law, class Shape, class Mass, class Ends>
void compare(const Law& law, const Shape& shape, const Mass& mass, const Ends& ends, reference::line set, double mean) {
    constexpr int count = Law::unknowns;
    CAPTURE(count, Shape::name, set.k, set.periodic);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> some(-1, 1);
    std::vector<point<1, double>> points;
    for (int p = 0; p < 3 * cells; ++p) points.emplace_back(lower + spacing * ((p + 0.5) / 3 + 0.1 * some(random)));
    set.shape = kind_of(shape);
    set.lower = lower;
    set.spacing = spacing;
    set.cells = cells;
    set.x.resize(3 * cells);
    for (int p = 0; p < 3 * cells; ++p) set.x[p] = points[static_cast<std::size_t>(p)][0];
    set.volume = Eigen::VectorXd::Constant(3 * cells, spacing / 3);
    Eigen::MatrixXd u(set.nodes(), count);
    for (Eigen::Index i = 0; i < u.size(); ++i) u.data()[i] = mean + 0.2 * some(random);
    for (const auto& h : set.low) u(0, h.unknown) = h.value(0);
    for (const auto& h : set.high) u(u.rows() - 1, h.unknown) = h.value(0);

    uniform_grid<1> grid{{lower}, {upper}, spacing};
    if (set.periodic) grid = grid.wrapped(0);
    taylor_galerkin scheme{grid, law, points, spacing / 3, shape, mass, ends};
    scheme.set([&](const auto& at) {
        const auto i = static_cast<Eigen::Index>(std::lround((at[0] - lower) / spacing)) % u.rows();
        return conservation::state<count, double>(u.row(i).transpose());
    });
    const double start = u.cwiseAbs().maxCoeff();
    for (int step = 0; step < 200; ++step) {
        u = reference::taylor_galerkin_step(set, u, step * dt, dt);
        scheme.step(dt, (step + 1) * dt);
    }
    // Nothing that grows without end.
    REQUIRE(u.cwiseAbs().maxCoeff() < 3);
    double off = 0;
    for (int i = 0; i <= cells; ++i) {
        const auto row = u.row(i % u.rows()).transpose();
        off = std::max(off, (scheme.on_node({i, 0, 0}) - row).cwiseAbs().maxCoeff());
    }
    CHECK(off < 1e-10 * start);
    CHECK((scheme.on_node({4, 0, 0}) - conservation::state<count, double>(u.row(4).transpose())).norm() < 1e-10);
}

template <class Shape> void compare_bar(const Shape& shape) {
    const conservation::elastic_bar law{2, 0.5};
    reference::line set;
    set.flux = [](const Eigen::MatrixXd& u) {
        Eigen::MatrixXd f(u.rows(), 2);
        f.col(0) = -2 * u.col(1);
        f.col(1) = -u.col(0) / 0.5;
        return f;
    };
    for (const bool periodic : {false, true})
        for (const int k : {1, 2, 5}) {
            set.periodic = periodic;
            set.k = k;
            if (periodic)
                set.low = set.high = {};
            else {
                set.low = {{1, push}};
                set.high = {{0, [](double) { return 0.; }}};
            }
            compare(law, shape, full_mass<dynamic>{k},
                    conservation::ends{conservation::give<1>(push), conservation::give<0>([](double) { return 0; })},
                    set, 0);
        }
}

}  // namespace

TEST_CASE("Taylor-Galerkin, elastic bar: agrees with dense matrices") {
    compare_bar(linear{});
    compare_bar(quadratic_spline{});
    compare_bar(cubic_spline{});
}

TEST_CASE("Taylor-Galerkin, advection and a user's law: agree with dense matrices") {
    using namespace conservation;
    const ends open{inflow{push}, outflow{}};
    reference::line set;
    set.low = {{0, push}};
    for (const bool periodic : {false, true}) {
        set.periodic = periodic;
        if (periodic) set.low = {};
        set.flux = [](const Eigen::MatrixXd& u) { return Eigen::MatrixXd(1.5 * u); };
        compare(advection<>{{1.5}}, linear{}, lumped_mass{}, open, set, 0.5);
        set.flux = [](const Eigen::MatrixXd& u) { return Eigen::MatrixXd(u.cwiseProduct(u) / 2); };
        compare(burgers{}, quadratic_spline{}, lumped_mass{}, open, set, 0.5);
    }
}
