// What the full mass matrix's variants have in common: adaptive, periodic and exact ones, and the boundary methods.
#include <tamis/tamis.hpp>
#include <tamis/mass/exact.hpp>

#include <cmath>
#include <string>

#include "catch.hpp"
#include "reference/dense.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

const linear_elastic law{.young = 1, .poisson = 0.3, .density = 1};
constexpr double pi = 3.14159265358979323846;

struct outcome {
    std::vector<double> velocities;
    double reach = 0, unbalanced = 0;
    series_report series;
};
double difference(const outcome& a, const outcome& b) {
    double most = 0;
    REQUIRE(a.velocities.size() == b.velocities.size());
    for (std::size_t k = 0; k < a.velocities.size(); ++k)
        most = std::max(most, std::abs(a.velocities[k] - b.velocities[k]));
    return most;
}

/// A bar between a fixed and a driven end, stepped; how far the held nodes are from their values, and the momentum from
/// the impulse of the reactions.
template <class... Policy> outcome driven_bar(int per, const Policy&... policies) {
    const auto ends = conditions{fixed{[](const auto& at) { return at[0] <= 0; }},
                                 prescribed{[](const auto& at) { return at[0] >= 1; },
                                            [](const auto&, auto t) { return 0.01 * std::sin(10 * t); }}};
    solver mpm{uniform_grid{{0.}, {1.}, 0.05}, ends, policies...};
    auto bar = mpm.make_body(law, everywhere, per_cell{per});
    set_velocity_of(bar, [](const auto& at) { return 0.01 * std::sin(pi * at[0]); });
    outcome out;
    double impulse = total_momentum(bar)[0];
    const double dt = 0.01;
    for (int k = 0; k < 60; ++k) {
        mpm.step(bodies(bar), dt);
        for (const auto& node : mpm.reactions()) impulse += node.reaction[0] * dt;
    }
    out.unbalanced = std::abs(total_momentum(bar)[0] - impulse);
    for (const auto p : std::as_const(bar)) out.velocities.push_back(p[v][0]);
    out.series = mpm.series();
    return out;
}

/// A block between an inclined wall, a floor and a moving lid.
template <class... Policy> double unbalanced_block(const Policy&... policies) {
    using place = point<2, double>;
    const place slope(std::cos(0.3), std::sin(0.3));
    const auto walls =
        conditions{slip{[](const auto& at) { return at[0] <= 0; }, slope},
                   slip{[](const auto& at) { return at[1] <= 0; }, place(0, 1)},
                   prescribed{[](const auto& at) { return at[1] >= 1 && at[0] > 0; },
                              [](const auto&, auto t) { return place(0.01 * std::sin(5 * t), -0.01 * t); }}};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}, walls, policies...};
    auto block = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.9; }, per_cell{3});
    set_velocity_of(block, [](const auto& at) { return place(0.01 * at[1], -0.02 * at[0]); });
    place impulse = total_momentum(block);
    for (int k = 0; k < 40; ++k) {
        mpm.step(bodies(block), 0.02);
        for (const auto& node : mpm.reactions()) impulse += node.reaction * 0.02;
    }
    return (total_momentum(block) - impulse).norm();
}

/// The method by its type and by its name are one: so most compositions, which take long to compile, are by name.
template <class Method> void balances(const Method& method) {
    CAPTURE(Method::name);
    const boundary_method::chosen named{Method::name};
    for (const int k : {1, 2, 5}) {
        CAPTURE(k);
        const auto typed = driven_bar(2, linear{}, fmpm<dynamic>{k}, method);
        CHECK(typed.unbalanced < 1e-14);
        CHECK(difference(typed, driven_bar(2, linear{}, fmpm<dynamic>{k}, named)) == 0);
        CHECK(driven_bar(2, quadratic_spline{}, usavg_minus{}, fmpm<dynamic>{k}, named).unbalanced < 1e-14);
        CHECK(driven_bar(3, usl_plus{}, fmpm<dynamic>{k}, named, held{}).unbalanced < 1e-14);
    }
    CHECK(unbalanced_block(fmpm<3>{}, named) < 1e-15);
}

}  // namespace

TEST_CASE("full mass: adaptive, periodic and exact ones meet the plain series where they must") {
    const auto plain = driven_bar(2, linear{}, fmpm<6>{});
    const auto never_small = driven_bar(2, linear{}, adaptive_fmpm{0., 6});
    CHECK(difference(plain, never_small) == 0);
    CHECK(never_small.series.terms == 6);
    CHECK(never_small.series.last_increment > 0);
    const auto tolerant = driven_bar(2, linear{}, adaptive_fmpm{1e-3, 100});
    CHECK(tolerant.series.terms > 1);
    CHECK(tolerant.series.terms < 100);

    CHECK(difference(driven_bar(2, fmpm<3>{}), driven_bar(2, periodic_fmpm<3>{1})) == 0);
    CHECK(difference(driven_bar(2, fmpm<3>{}), driven_bar(2, periodic_fmpm<dynamic>{3, 1})) == 0);
    // Between FLIP, which it mostly is, and FMPM.
    CHECK(difference(driven_bar(2, flip{}), driven_bar(2, periodic_fmpm<3>{20})) <
          difference(driven_bar(2, flip{}), driven_bar(2, periodic_fmpm<3>{2})));
    CHECK(driven_bar(2, periodic_fmpm<3>{7}).unbalanced < 1e-14);
}

TEST_CASE("full mass: by increments the series is stable to k = 1000, where it meets the exact solve") {
    for (const int per : {2, 3}) {
        const auto exact = driven_bar(per, linear{}, exact_fmpm{}, held{});
        CHECK(difference(exact, driven_bar(per, linear{}, fmpm<dynamic>{1000}, held{})) < 1e-13);
        CHECK(exact.unbalanced < 1e-14);
    }
    const auto exact = driven_bar(3, exact_fmpm{}, usavg_plus{});
    CHECK(difference(exact, driven_bar(3, fmpm<dynamic>{1000}, usavg_plus{})) < 1e-9);
    CHECK(exact.unbalanced < 1e-14);
    CHECK(unbalanced_block(exact_fmpm{}, linear{}) < 1e-14);
}

TEST_CASE("full mass: a thousand increments are exact where the sum with binomials has lost every digit") {
    const int cells = 8;
    const double h = 1. / cells;
    solver mpm{uniform_grid{{0.}, {1.}, h}, quadratic_spline{}, fmpm<dynamic>{1000}};
    auto bar = mpm.make_body(law, everywhere, per_cell{2});
    reference::scene set;
    set.lower = Eigen::VectorXd::Zero(1);
    set.upper = Eigen::VectorXd::Ones(1);
    set.spacing = h;
    set.shape = reference::shape_kind::quadratic_spline;
    Eigen::MatrixXd places(2 * cells, 1);
    Eigen::Index row = 0;
    for (const auto p : std::as_const(bar)) places(row++, 0) = p[x][0];
    const reference::basis shapes = evaluate_basis(set, places, Eigen::VectorXd::Constant(2 * cells, h / 2));

    // m^(1/2) A m^(-1/2) is symmetric: sum A^l over l < k is (1 - lambda^k)/(1 - lambda) for each eigenvalue.
    const Eigen::VectorXd root = shapes.mass.cwiseSqrt();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(root.asDiagonal() * shapes.A *
                                                               root.cwiseInverse().asDiagonal());
    const auto exact = [&](int k) {
        Eigen::VectorXd sums(cells + 1);
        for (Eigen::Index i = 0; i <= cells; ++i) {
            const double lambda = modes.eigenvalues()[i];
            sums[i] = 1 - lambda > 1e-12 ? (1 - std::pow(lambda, k)) / (1 - lambda) : k;
        }
        const Eigen::MatrixXd symmetric = modes.eigenvectors() * sums.asDiagonal() * modes.eigenvectors().transpose();
        return Eigen::MatrixXd(root.cwiseInverse().asDiagonal() * symmetric * root.cwiseInverse().asDiagonal());
    };
    // sum over l from 1 to k of (-1)^(l+1) (k over l) (S+ S)^(l-1) m^-1
    const auto by_binomials = [&](int k) {
        const Eigen::MatrixXd smoothed = Eigen::MatrixXd::Identity(cells + 1, cells + 1) - shapes.A;
        Eigen::MatrixXd power = shapes.inverse_mass.asDiagonal(), sum = Eigen::MatrixXd::Zero(cells + 1, cells + 1);
        double binomial = 1;
        for (int l = 1; l <= k; ++l) {
            binomial *= static_cast<double>(k - l + 1) / l;
            sum += (l % 2 == 1 ? binomial : -binomial) * power;
            power = smoothed * power;
        }
        return sum;
    };
    const auto off = [](const Eigen::MatrixXd& found, const Eigen::MatrixXd& wanted) {
        return (found - wanted).norm() / wanted.norm();
    };
    Eigen::MatrixXd found(cells + 1, cells + 1);
    for (int j = 0; j <= cells; ++j) {
        const auto column = mpm.inverse_column(bodies(bar), {j, 0, 0});
        found.col(j) = Eigen::Map<const Eigen::VectorXd>(column.data(), cells + 1);
    }
    CAPTURE(off(found, exact(1000)), off(by_binomials(10), exact(10)), off(by_binomials(50), exact(50)),
            off(by_binomials(1000), exact(1000)));
    CHECK(off(found, exact(1000)) < 1e-11);
    CHECK(off(by_binomials(10), exact(10)) < 1e-11);
    CHECK(off(by_binomials(50), exact(50)) > 1e-5);
    CHECK_FALSE(off(by_binomials(1000), exact(1000)) < 1e100);
}

TEST_CASE("full mass: entries of the matrix are kept where they pay, and nowhere else") {
    const auto keeps = []<int D, class... Policy>(const uniform_grid<D, double>&, const Policy&...) {
        using C = detail::composition<uniform_grid<D, double>, Policy...>;
        using kept = field::mass_entries<C::shape::support>;
        return stores<typename detail::schedule_of<C>::layout, kept>;
    };
    const uniform_grid<1, double> line{{0.}, {1.}, 0.1};
    const uniform_grid<2, double> square{{0., 0.}, {1., 1.}, 0.1};
    const uniform_grid<3, double> cube{{0., 0., 0.}, {1., 1., 1.}, 0.1};
    CHECK(keeps(line, linear{}, fmpm<2>{}, held{}));
    CHECK(keeps(line, linear{}, fmpm<3>{}));
    CHECK(keeps(line, quadratic_spline{}, xpic<3>{}));
    CHECK(keeps(line, cubic_spline{}, fmpm<4>{}));
    CHECK(keeps(line, cubic_spline{}, fmpm<dynamic>{2}));
    CHECK_FALSE(keeps(line, linear{}, fmpm<2>{}));
    CHECK_FALSE(keeps(line, cubic_spline{}, fmpm<3>{}));
    CHECK_FALSE(keeps(line, linear{}, flip{}, held{}));
    CHECK_FALSE(keeps(line, linear{}, exact_fmpm{}));
    CHECK(keeps(square, linear{}, fmpm<3>{}));
    CHECK(keeps(square, linear{}, fmpm<dynamic>{2}));
    CHECK(keeps(square, cubic_spline{}, xpic<3>{}, held{}));
    CHECK(keeps(cube, linear{}, fmpm<3>{}, held{}));
    CHECK_FALSE(keeps(square, linear{}, fmpm<2>{}));
    CHECK_FALSE(keeps(square, linear{}, fmpm<2>{}, held{}));
    CHECK_FALSE(keeps(square, quadratic_spline{}, fmpm<4>{}));
    CHECK_FALSE(keeps(cube, linear{}, fmpm<4>{}));
    CHECK_FALSE(keeps(cube, quadratic_spline{}, fmpm<4>{}, held{}));
}

TEST_CASE("full mass: every boundary method tells the reaction that balances momentum") {
    using namespace boundary_method;
    balances(incremental{});
    balances(boundary_method::lumped{});
    balances(boundary_method::velocity{});
    balances(combined{});
    balances(unlumped1{});
    balances(unlumped2{});
    balances(partial{});
    balances(collected{});
}

TEST_CASE("full mass: columns of the inverse, and the acceleration that it gives") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}, fmpm<40>{},
               read_out<field::full_acceleration, field::acceleration>{}};
    auto bar = mpm.make_body(law, everywhere, per_cell{3});
    set_velocity_of(bar, [](const auto& at) { return 0.01 * std::sin(2 * pi * at[0]); });
    mpm.step(bodies(bar), 0.02);
    // M~ c = e for the column c of a node: M~ assembled here from the particles' tents.
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(11, 11);
    for (const auto p : std::as_const(bar)) {
        const double r = p[x][0] / 0.1;
        const int i = std::min(9, static_cast<int>(r));
        Eigen::Vector2d w(1 - (r - i), r - i);
        matrix.block<2, 2>(i, i) += p[m] * w * w.transpose();
    }
    const auto c = mpm.inverse_column(bodies(bar), {4, 0, 0});
    REQUIRE(c.size() == 11);
    CHECK_THROWS_AS(mpm.inverse_column(bodies(bar), {11, 0, 0}), error);
    CHECK_THROWS_AS(mpm.on_node(field::acceleration{}, {4, 1, 0}), error);
    CHECK_THROWS_AS(mpm.on_node(field::acceleration{}, {-1, 0, 0}), error);
    const Eigen::VectorXd unit = matrix * Eigen::Map<const Eigen::VectorXd>(c.data(), 11);
    for (int k = 0; k < 11; ++k) CHECK(std::abs(unit[k] - (k == 4 ? 1 : 0)) < 1e-6);

    // M~ a = f = m a_lumped, of the step that begins here.
    mpm.step(bodies(bar), 0.02);
    Eigen::VectorXd full(11), lumped(11);
    for (int k = 0; k <= 10; ++k) {
        full[k] = mpm.on_node(field::full_acceleration{}, {k, 0, 0})[0];
        lumped[k] = mpm.on_node(field::acceleration{}, {k, 0, 0})[0];
    }
    const Eigen::VectorXd force = matrix.rowwise().sum().cwiseProduct(lumped);
    CHECK((matrix * full - force).norm() < 1e-6 * force.norm());
    CHECK((full - lumped).norm() > 1e-2 * full.norm());
}

TEST_CASE("full mass: an update's Lagrangian error is read, and is none for FMPM") {
    const auto error_of = [](const auto& scheme) {
        solver mpm{uniform_grid{{0.}, {1.}, 0.1}, scheme};
        auto bar = mpm.make_body(law, everywhere, per_cell{2}, fields<field::update_error>{});
        set_velocity_of(bar, [](const auto& at) { return 0.01 * std::sin(40 * at[0]); });
        for (int k = 0; k < 5; ++k) mpm.step(bodies(bar), 0.02);
        double most = 0;
        for (const auto p : std::as_const(bar)) most = std::max(most, std::abs(p[field::update_error{}][0]));
        return most;
    };
    CHECK(error_of(fmpm<2>{}) < 1e-17);
    CHECK(error_of(flip{}) > 1e-4);
    CHECK(error_of(xpic<2>{}) > 1e-4);
    CHECK(error_of(pic{}) > 1e-5);
}

TEST_CASE("full mass: bad parameters and a singular matrix get a sentence") {
    const auto message = [](auto&& action) -> std::string {
        try {
            action();
        } catch (const error& e) {
            return e.what();
        }
        return "nothing was thrown";
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    CHECK(has(message([] { adaptive_fmpm{-1., 4}; }), "the tolerance is -1; give a share"));
    CHECK(has(message([] { adaptive_fmpm{0.1, 0}; }), "at most 0 terms; give 1 or more"));
    CHECK(has(message([] { periodic_fmpm<2>{0}; }), "the period is 0 steps; give 1 or more"));
    CHECK(has(message([] { driven_bar(1, linear{}, exact_fmpm{}); }), "is singular"));
}
