#include <tamis/tamis.hpp>

#include "catch.hpp"
#include "unit/material/deform.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

/// A symmetric tensor of the dimension that a law writes, and one of 3x3.
struct spread : symmetric_field {
    static constexpr std::string_view name = "spread";
};
struct whole : symmetric_3x3_field {
    static constexpr std::string_view name = "whole";
};
constexpr spread d_sum;
constexpr whole w_sum;

/// Hooke's law of 3x3 tensors: the strain is a field, the stress out of the plane is there too.
struct hooke {
    double lambda, shear, density = 1;
    using on_particles = fields<whole>;
    static constexpr bool three_by_three = true;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        static_assert(Tensor::RowsAtCompileTime == 3 && Tensor::ColsAtCompileTime == 3);
        using T = typename Tensor::Scalar;
        p[w_sum] += (dt / 2) * Tensor(L + L.transpose());
        return detail::isotropic<Tensor>(constant<T>(lambda) * p[w_sum].trace()) + constant<T>(2 * shear) * p[w_sum];
    }
};
struct hooke_by_lane : hooke {
    static constexpr bool lane_by_lane = true;
};
/// The same in plain numbers only.
struct hooke_in_numbers {
    double lambda, shear, density = 1;
    using on_particles = fields<whole>;
    static constexpr bool three_by_three = true;
    double wave_speed() const { return 1; }
    Eigen::Matrix3d stress(auto p, const Eigen::Matrix3d& L, double dt) const {
        p[w_sum] = p[w_sum] + dt / 2 * (L + L.transpose());
        return lambda * p[w_sum].trace() * Eigen::Matrix3d::Identity() + 2 * shear * p[w_sum];
    }
};
/// Written in the dimension's tensors, with a symmetric field of its own: set, added to, taken from.
struct summing {
    double lambda, shear, density = 1;
    using on_particles = fields<spread, const field::strain>;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        using T = typename Tensor::Scalar;
        const Tensor D = (dt / 2) * Tensor(L + L.transpose());
        p[d_sum] = p[d_sum] + D * T(3.);
        p[d_sum] -= D;
        p[d_sum] += -D;
        return detail::isotropic<Tensor>(constant<T>(lambda) * p[d_sum].trace()) + constant<T>(2 * shear) * p[d_sum];
    }
};

template <int D> matrix<D, double> some_gradient() {
    matrix<D, double> g;
    for (int c = 0; c < D * D; ++c) g.data()[c] = 0.1 * c - 0.13 * (c % 2) + 0.05;
    return g;
}
template <int D, class Law> void is_hookes(const Law& law) {
    const matrix<D, double> g = some_gradient<D>(), strain = (g + g.transpose()) / 2 * 3 * 0.125;
    auto body = deform<held, Law, D>(law, g, 3, 0.125);
    for (const auto p : std::as_const(body)) {
        const matrix<D, double> expected =
            law.lambda * strain.trace() * matrix<D, double>::Identity() + 2 * law.shear * strain;
        CHECK((matrix<D, double>(p[sigma]) - expected).norm() < 1e-14);
        if constexpr (decltype(body)::has(w_sum)) {
            Eigen::Matrix3d full = Eigen::Matrix3d::Zero();
            full.topLeftCorner(D, D) = strain;
            CHECK((Eigen::Matrix3d(p[w_sum]) - full).norm() < 1e-15);
        } else
            CHECK((matrix<D, double>(p[d_sum]) - strain).norm() < 1e-15);
    }
}
template <class Law> void is_hookes_in_all_dimensions(const Law& law) {
    is_hookes<1>(law);
    is_hookes<2>(law);
    is_hookes<3>(law);
}

}  // namespace

TEST_CASE("three_by_three: a law of 3x3 tensors is told of the plane's gradient, and gives the plane's stress") {
    is_hookes_in_all_dimensions(hooke{7, 3});
    is_hookes_in_all_dimensions(hooke_by_lane{{7, 3}});
    is_hookes_in_all_dimensions(hooke_in_numbers{7, 3});
}

TEST_CASE("three_by_three: laws write symmetric fields of their own") { is_hookes_in_all_dimensions(summing{7, 3}); }

TEST_CASE("three_by_three: viscosity beside such a law computes with 3x3 tensors too") {
    const newtonian<hooke> both{.law = {7, 3}, .viscosity = 0.25};
    const matrix<2, double> g = some_gradient<2>(), rate = (g + g.transpose()) / 2, one = matrix<2, double>::Identity();
    const double dt = 0.125, J = 1 + dt * g.trace();
    auto body = deform<held, newtonian<hooke>, 2>(both, g, 1, dt);
    const matrix<2, double> elastic = 7 * dt * rate.trace() * one + 2 * 3 * dt * rate;
    const matrix<2, double> viscous = J * 2 * 0.25 * (rate - rate.trace() / 3 * one);
    for (const auto p : std::as_const(body)) CHECK((matrix<2, double>(p[sigma]) - elastic - viscous).norm() < 1e-14);
}

TEST_CASE("three_by_three: stored are the components that plane and uniaxial strain leave") {
    STATIC_REQUIRE(whole::components<space<1, double>> == 3);
    STATIC_REQUIRE(whole::components<space<2, double>> == 4);
    STATIC_REQUIRE(whole::components<space<3, double>> == 6);
}

TEST_CASE("three_by_three: users read and write such fields as 3x3 tensors") {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}};
    auto body = mpm.make_body(linear_elastic{.young = 1, .density = 1}, everywhere, per_cell{2}, fields<whole>{});
    Eigen::Matrix3d given;
    given << 1, 2, 0, 2, 4, 0, 0, 0, 6;
    double n = 0;
    for (auto p : body) {
        CHECK(Eigen::Matrix3d(p[w_sum]) == Eigen::Matrix3d::Zero());
        p[w_sum] = ++n * given;
        p[w_sum] += given;
        CHECK(p[w_sum](1, 0) == 2 * (n + 1));
        CHECK(p[w_sum].trace() == 11 * (n + 1));
    }
    double k = 0;
    for (const auto p : std::as_const(body)) {
        const Eigen::Matrix3d read = p[w_sum];
        CHECK(read == (++k + 1) * given);
    }
    CHECK((mean(body, w_sum) - (n + 3) / 2 * given).norm() < 1e-12);
}
