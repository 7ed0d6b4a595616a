#include <tamis/material/linear_elastic.hpp>
#include <tamis/material/neo_hookean.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

/// A scalar with one derivative, as a user's automatic differentiation would bring it.
struct dual {
    double a = 0, b = 0;
    dual() = default;
    dual(double value, double slope = 0) : a(value), b(slope) {}
    double value() const { return a; }
    friend dual operator+(dual x, dual y) { return {x.a + y.a, x.b + y.b}; }
    friend dual operator-(dual x, dual y) { return {x.a - y.a, x.b - y.b}; }
    friend dual operator*(dual x, dual y) { return {x.a * y.a, x.a * y.b + x.b * y.a}; }
    [[maybe_unused]] friend dual operator/(dual x, dual y) { return {x.a / y.a, (x.b - x.a / y.a * y.b) / y.a}; }
    [[maybe_unused]] friend dual& operator+=(dual& x, dual y) { return x = x + y; }
    friend bool operator>(dual x, dual y) { return x.a > y.a; }
    friend dual log(dual x) { return {std::log(x.a), x.b / x.a}; }
    friend dual exp(dual x) { return {std::exp(x.a), x.b * std::exp(x.a)}; }
};

}  // namespace

template <> struct Eigen::NumTraits<dual> : Eigen::GenericNumTraits<double> {
    using Real = dual;
    using NonInteger = dual;
    using Nested = dual;
    using Literal = dual;
};

namespace {

constexpr double young = 7, poisson = 0.3, density = 2;
constexpr double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson)), shear = young / (2 * (1 + poisson));
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class V> constexpr neo_hookean_of<V> law{.young = young, .poisson = poisson, .density = density};

/// A particle as a law sees it: its deformation gradient.
template <class Tensor> struct row {
    Tensor F;
    const Tensor& operator[](field::deformation) const { return F; }
};
template <class V, class Tensor> Tensor stress_at(const Tensor& F) {
    return law<V>.stress(row<Tensor>{F}, Tensor(Tensor::Zero()), typename Tensor::Scalar(1));
}
template <class V, class Tensor> auto energy_at(const Tensor& F) {
    return law<V>.energy(row<Tensor>{F}, stress_at<V>(F));
}

std::mt19937 numbers(5);
template <int D> matrix<D, double> any_matrix(double size) {
    std::uniform_real_distribution<double> number(-size, size);
    matrix<D, double> a;
    for (int d = 0; d < D; ++d)
        for (int e = 0; e < D; ++e) a(d, e) = number(numbers);
    return a;
}
template <int D> matrix<D, double> any_deformation() {
    const matrix<D, double> F = matrix<D, double>::Identity() + any_matrix<D>(0.3);
    REQUIRE(detail::determinant(F) > 0);
    return F;
}
template <int D> matrix<D, double> any_rotation() {
    matrix<D, double> R = matrix<D, double>::Identity();
    for (int d = 0; d < D; ++d)
        for (int e = 0; e < d; ++e) {
            const double angle = std::uniform_real_distribution<double>(0, 6)(numbers);
            matrix<D, double> turn = matrix<D, double>::Identity();
            turn(d, d) = turn(e, e) = std::cos(angle);
            turn(d, e) = std::sin(angle);
            turn(e, d) = -turn(d, e);
            R = turn * R;
        }
    return R;
}

/// What is checked for one form of the law in one dimension.
template <class V, int D> struct form {
    using tensor = matrix<D, double>;
    static constexpr auto one = [] { return tensor(tensor::Identity()); };

    /// tau = (dW/dF) F^T, by central differences.
    static void stress_is_slope_of_energy() {
        for (int k = 0; k < 5; ++k) {
            const tensor F = any_deformation<D>();
            constexpr double h = 1e-5;
            tensor P;
            for (int d = 0; d < D; ++d)
                for (int e = 0; e < D; ++e) {
                    tensor above = F, below = F;
                    above(d, e) += h;
                    below(d, e) -= h;
                    P(d, e) = (energy_at<V>(above) - energy_at<V>(below)) / (2 * h);
                }
            CHECK((P * F.transpose() - stress_at<V>(F)).norm() < 1e-8 * young);
        }
    }
    static void nothing_deformed_nothing_stressed() {
        CHECK(stress_at<V>(one()).norm() < 1e-15 * young);
        CHECK(std::abs(energy_at<V>(one())) < 1e-15 * young);
    }
    /// Halving the strain quarters the distance from Hooke's law, in which axes beyond the dimension are held.
    static void small_strain_is_hookes() {
        const tensor H = any_matrix<D>(1);
        const auto distance = [&](double size) {
            const tensor strain = (H + H.transpose()) * (size / 2);
            const tensor hooke = lame * strain.trace() * one() + 2 * shear * strain;
            if (D > 1) {
                const linear_elastic linear{.young = young, .poisson = poisson, .density = density};
                CHECK((linear.at_strain(0, strain) - hooke).norm() < 1e-14 * size);
            }
            const tensor F = one() + size * H;
            CHECK(std::abs(energy_at<V>(F) - hooke.cwiseProduct(strain).sum() / 2) < 100 * young * size * size * size);
            return (stress_at<V>(F) - hooke).norm();
        };
        const double coarse = distance(1e-3), fine = distance(5e-4);
        CHECK(coarse < 1e-5 * young * 10);
        CHECK(std::abs(coarse / fine - 4) < 0.1);
    }
    static void rotations_turn_the_stress() {
        const tensor F = any_deformation<D>(), R = any_rotation<D>();
        CHECK((stress_at<V>(tensor(R * F)) - R * stress_at<V>(F) * R.transpose()).norm() < 1e-14 * young);
        CHECK(std::abs(energy_at<V>(tensor(R * F)) - energy_at<V>(F)) < 1e-14 * young);
        // Isotropic: turned beforehand the material is the same.
        CHECK((stress_at<V>(tensor(F * R)) - stress_at<V>(F)).norm() < 1e-14 * young);
        CHECK(stress_at<V>(R).norm() < 1e-14 * young);
    }
    static void lanes_compute_what_plain_numbers_do() {
        using T = native_lanes::type<double>;
        using S = space<D, T>;
        constexpr int W = S::width;
        tensor F[W];
        double in[D * D][W], out[W];
        for (int l = 0; l < W; ++l) {
            F[l] = any_deformation<D>();
            if (l == 1) F[l].row(0) *= -1;
            for (int c = 0; c < D * D; ++c) in[c][l] = F[l].data()[c];
        }
        typename S::tensor lanes;
        for (int c = 0; c < D * D; ++c) lanes.data()[c] = lane<T>::load(in[c]);
        const typename S::tensor tau = stress_at<V>(lanes);
        for (int c = 0; c < D * D; ++c) {
            lane<T>::store(out, tau.data()[c]);
            for (int l = 0; l < W; ++l) {
                if (l == 1)
                    CHECK(std::isnan(out[l]));
                else
                    CHECK(std::abs(out[l] - stress_at<V>(F[l]).data()[c]) < 1e-14 * young);
            }
        }
        lane<T>::store(out, energy_at<V>(lanes));
        for (int l = 0; l < W; ++l)
            if (l != 1) CHECK(std::abs(out[l] - energy_at<V>(F[l])) < 1e-14 * young);
    }
    static void float_is_near() {
        const matrix<D, float> F = any_deformation<D>().template cast<float>();
        const tensor same = F.template cast<double>();
        CHECK((stress_at<V>(F).template cast<double>() - stress_at<V>(same)).norm() < 1e-5 * young);
    }
    static void inside_out_is_no_number() {
        for (const double number : {0., -1., not_a_number}) {
            tensor F = one();
            F(0, 0) = number;
            CHECK(std::isnan(stress_at<V>(F).sum()));
            CHECK(std::isnan(neo_hookean_of<V>{.young = young, .density = density}.at_deformation(F).sum()));
        }
    }
    static void all() {
        CAPTURE(D);
        stress_is_slope_of_energy();
        nothing_deformed_nothing_stressed();
        small_strain_is_hookes();
        rotations_turn_the_stress();
        lanes_compute_what_plain_numbers_do();
        float_is_near();
        inside_out_is_no_number();
    }
};
template <class V> void in_all_dimensions() {
    form<V, 1>::all();
    form<V, 2>::all();
    form<V, 3>::all();
}

/// The stress of the whole body, three by three, of which a dimension keeps a corner.
template <class V, int D> void is_a_corner_of_three_dimensions() {
    const matrix<D, double> F = any_deformation<D>();
    matrix<3, double> full = matrix<3, double>::Identity();
    full.template topLeftCorner<D, D>() = F;
    const matrix<D, double> corner = stress_at<V>(full).template topLeftCorner<D, D>();
    CHECK((stress_at<V>(F) - corner).norm() < 1e-14 * young);
    CHECK(std::abs(energy_at<V>(F) - energy_at<V>(full)) < 1e-14 * young);
}

/// The slope of the energy, exactly.
template <class V> void duals_differentiate() {
    const matrix<3, double> F = any_deformation<3>(), tau = stress_at<V>(F);
    matrix<3, double> P;
    for (int d = 0; d < 3; ++d)
        for (int e = 0; e < 3; ++e) {
            matrix<3, dual> G;
            for (int c = 0; c < 9; ++c) G.data()[c] = dual(F.data()[c], 0);
            G(d, e).b = 1;
            P(d, e) = law<V>.energy_at(G).b;
            CHECK(std::abs(law<V>.at_deformation(G)(0, 1).a - tau(0, 1)) < 1e-14 * young);
        }
    CHECK((P * F.transpose() - tau).norm() < 1e-14 * young);
}

template <class V> std::string refusal(double e, double nu, double rho0) {
    return complaint([&] { neo_hookean_of<V>{.young = e, .poisson = nu, .density = rho0}.check(); });
}

}  // namespace

TEST_CASE("neo_hookean: stress is the energy's slope, Hooke's where strain is small, and turns with the particle") {
    in_all_dimensions<volumetric::logarithmic>();
    in_all_dimensions<volumetric::quadratic>();
    in_all_dimensions<volumetric::split>();
}

TEST_CASE("neo_hookean: plane and uniaxial strain are three dimensions with the others held") {
    is_a_corner_of_three_dimensions<volumetric::logarithmic, 1>();
    is_a_corner_of_three_dimensions<volumetric::logarithmic, 2>();
    is_a_corner_of_three_dimensions<volumetric::quadratic, 1>();
    is_a_corner_of_three_dimensions<volumetric::quadratic, 2>();
    is_a_corner_of_three_dimensions<volumetric::split, 1>();
    is_a_corner_of_three_dimensions<volumetric::split, 2>();
}

TEST_CASE("neo_hookean: the papers' formulas, at a stretch of 2, 1, 1/2 and of 2, 1, 1") {
    const matrix<3, double> deformed = matrix<3, double>(point<3, double>(2, 1, 0.5).asDiagonal());
    CHECK(std::abs(stress_at<volumetric::logarithmic>(deformed)(0, 0) - 3 * shear) < 1e-14);
    CHECK(std::abs(stress_at<volumetric::quadratic>(deformed)(2, 2) + 0.75 * shear) < 1e-14);
    CHECK(std::abs(stress_at<volumetric::split>(deformed)(0, 0) - shear * (4 - 5.25 / 3)) < 1e-14);
    const matrix<1, double> doubled(2.);
    CHECK(std::abs(stress_at<volumetric::logarithmic>(doubled)(0) - (3 * shear + lame * std::log(2.))) < 1e-14);
    CHECK(std::abs(stress_at<volumetric::quadratic>(doubled)(0) - (3 * shear + lame * 1.5)) < 1e-14);
    const double kappa = young / (3 * (1 - 2 * poisson));
    CHECK(std::abs(stress_at<volumetric::split>(doubled)(0) - (2 * shear / std::cbrt(4.) + kappa * 1.5)) < 1e-14);
}

TEST_CASE("neo_hookean: without Poisson's ratio a bar has Young's modulus") {
    const neo_hookean bar{.young = young, .density = density};
    const double strain = 1e-6;
    CHECK(std::abs(bar.at_deformation(matrix<1, double>(1 + strain))(0) / strain - young) < 2e-6 * young);
}

TEST_CASE("neo_hookean: split, the pressure is that of the volume alone") {
    matrix<3, double> deformed = any_deformation<3>(), other = any_deformation<3>();
    other *= std::cbrt(detail::determinant(deformed) / detail::determinant(other));
    const double J = detail::determinant(deformed), trace = stress_at<volumetric::split>(deformed).trace();
    CHECK(std::abs(trace - stress_at<volumetric::split>(other).trace()) < 1e-14 * young);
    CHECK(std::abs(trace - 1.5 * young / (3 * (1 - 2 * poisson)) * (J * J - 1)) < 1e-14 * young);
    CHECK(std::abs(stress_at<volumetric::logarithmic>(deformed).trace() -
                   stress_at<volumetric::logarithmic>(other).trace()) > 0.01);
}

TEST_CASE("neo_hookean: dual numbers give the energy's exact slope") {
    duals_differentiate<volumetric::logarithmic>();
    duals_differentiate<volumetric::quadratic>();
    duals_differentiate<volumetric::split>();
}

TEST_CASE("neo_hookean: the wave speed is the longitudinal one of the material at rest, held sideways") {
    for (int dim = 1; dim <= 3; ++dim)
        CHECK(std::abs(neo_hookean{.young = young, .poisson = poisson, .density = density}.wave_speed(dim) -
                       std::sqrt((lame + 2 * shear) / density)) < 1e-15);
    CHECK(std::abs(neo_hookean{.young = young, .density = density}.wave_speed(1) - std::sqrt(young / density)) < 1e-15);
}

TEST_CASE("neo_hookean: parameters that make no sense are refused by name") {
    CHECK(refusal<volumetric::split>(1, 0.49, 1) == "nothing");
    CHECK(names(refusal<volumetric::split>(-2, 0, 1), "neo_hookean", "Young's modulus is -2", "positive"));
    CHECK(names(refusal<volumetric::logarithmic>(1, 0.5, 1), "neo_hookean", "Poisson's ratio is 0.5", "below 0.5"));
    CHECK(names(refusal<volumetric::quadratic>(1, 0, -3), "neo_hookean", "density is -3", "positive"));
}

TEST_CASE("neo_hookean: a particle turned inside out is refused") {
    const auto with = [](double number) {
        matrix<2, double> deformed = matrix<2, double>::Identity();
        deformed(1, 1) = number;
        return complaint([&] { law<volumetric::logarithmic>.check(row<matrix<2, double>>{deformed}); });
    };
    CHECK(with(0.01) == "nothing");
    CHECK(names(with(-1), "its deformation gradient has the determinant -1", "positive", "identity"));
    for (const double number : {0., infinity, not_a_number}) CHECK(names(with(number), "determinant"));
}
