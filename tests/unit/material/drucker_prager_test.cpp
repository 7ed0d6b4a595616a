#include <tamis/tamis.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using namespace motion_of;
using tensor3 = Eigen::Matrix3d;

namespace {

constexpr double young = 100, poisson = 0.25, dt = 0.125;
constexpr drucker_prager sand{.young = young, .poisson = poisson, .density = 1, .friction = 30};
constexpr drucker_prager soil{
    .young = young, .poisson = poisson, .density = 1, .friction = 25, .cohesion = 0.4, .dilatancy = 10, .tension = 0.3};

/// One particle in plain numbers: Hencky's strain in axes that Eigen finds; the cone by stresses, and the return by
/// bisection of the plastic flow, not by its closed form.
struct reference {
    drucker_prager law;
    tensor3 b = tensor3::Identity(), tau = tensor3::Zero();
    double opening = 0, alpha = 0;

    void step(const tensor3& f) {
        const double mu = young / (2 * (1 + poisson)), K = young / (3 * (1 - 2 * poisson)),
                     degree = std::numbers::pi / 180;
        const auto A_of = [&](double angle) {
            return std::sqrt(2. / 3) * 2 * std::sin(angle * degree) / (3 - std::sin(angle * degree));
        };
        const double A = A_of(law.friction), B = A_of(law.dilatancy),
                     k = std::sqrt(2. / 3) * 6 * law.cohesion * std::cos(law.friction * degree) /
                         (3 - std::sin(law.friction * degree));
        const Eigen::SelfAdjointEigenSolver<tensor3> form(f * b * f.transpose());
        const Eigen::Vector3d e = form.eigenvalues().array().log() / 2;
        Eigen::Vector3d dev = e.array() - e.sum() / 3;
        double volume = e.sum() + opening, length = dev.norm();
        const double before = length;
        // Beyond the cone: how much must flow along n + B 1?
        const auto outside = [&](double flow) {
            return 2 * mu * (length - flow) + A * 3 * K * (volume - 3 * B * flow) - k;
        };
        if (outside(0) > 0) {
            double low = 0, high = length;
            if (outside(length) < 0)
                for (int n = 0; n < 200; ++n) (outside((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
            volume -= 3 * B * high;
            length -= high;
        }
        // Beyond the tip or the tension: the rest is opening, and the cone bounds the shear there.
        const double tip = A > 0 ? k / (3 * A) : INFINITY, most = std::min(tip, law.tension) / K;
        opening = std::max(volume - most, 0.);
        volume = std::min(volume, most);
        length = std::min(length, std::max((k - 3 * A * K * volume) / (2 * mu), 0.));
        alpha += std::sqrt(2. / 3) * (before - length);
        dev *= before > 0 ? length / before : 0;
        const tensor3 R = form.eigenvectors();
        b = R * (2 * (dev.array() + volume / 3)).exp().matrix().asDiagonal() * R.transpose();
        tau = R * (2 * mu * dev.array() + K * volume).matrix().asDiagonal() * R.transpose();
    }
};

std::vector<moved_state> moved(const drucker_prager& law, const steps& motion) { return ::moved(law, dt, motion); }

template <int D, class T> void is_the_reference(const drucker_prager& law, const auto& motion) {
    double worst = 0;
    beside<D, T>(
        ::moved<D, T>(law, dt, motion), motion, reference{law},
        [&](const moved_state& is, const reference& plain) {
            worst = std::max({worst, (is.full - plain.tau).norm() / young, (is.b - plain.b).norm(),
                              (is.tau - plain.tau.topLeftCorner(D, D)).norm() / young,
                              std::abs(is.opening - plain.opening), std::abs(is.alpha - plain.alpha)});
        },
        [&](int l, const reference& plain) {
            CAPTURE(D, l);
            CHECK(worst < 1e-12);
            CHECK(plain.alpha > 1e-3);
        });
}
double mean_of(const tensor3& tau) { return tau.trace() / 3; }
double shear_of(const tensor3& tau) { return (tau - mean_of(tau) * tensor3::Identity()).norm(); }

}  // namespace

TEST_CASE("drucker_prager: a plain particle's steps, in 1D, plane strain and 3D, in lanes and without") {
    const auto dimensions = [&]<class T>(T) {
        for (const auto& law : {sand, soil}) {
            // Lanes differ: some slide, some come apart where others do not.
            const auto size = [](int l) { return 0.002 / (1 + l); };
            const auto squeezed = [&](int l) {
                return joined(joined(motion_of::uniaxial(-size(l), 40), motion_of::uniaxial(size(l), 60)),
                              motion_of::uniaxial(-size(l), 40));
            };
            is_the_reference<1, T>(law, squeezed);
            is_the_reference<2, T>(law, squeezed);
            is_the_reference<3, T>(law, squeezed);
            const auto sheared = [&](int l) {
                return joined(stretched(-size(l), -size(l), -size(l), 10), motion_of::twisted(4 * size(l), 60));
            };
            is_the_reference<2, T>(law, sheared);
            is_the_reference<3, T>(law, sheared);
        }
    };
    dimensions(0.);
    dimensions(native_lanes::type<double>());
}

TEST_CASE("drucker_prager: a triaxial test fails at the ratio of Mohr and Coulomb, at constant volume or swelling") {
    // Squeezed evenly, then along x while the sides give way so that the mean strain stays: the stress slides on the
    // cone, at (sigma_3 - sigma_1)/(sigma_3 + sigma_1) = sin(friction).
    const auto path = joined(stretched(-0.01, -0.01, -0.01, 20), stretched(-0.01, 0.0050378, 0.0050378, 60));
    const auto all = moved(sand, path);
    const tensor3 end = all.back().full;
    CHECK(std::abs((end(0, 0) - end(1, 1)) / (end(0, 0) + end(1, 1)) - std::sin(std::numbers::pi / 6)) < 1e-10);
    // Without dilatancy sliding leaves the elastic volume as it is told: det b is the square of the body's.
    double J = 1;
    for (const tensor3& f : path) J *= f.determinant();
    CHECK(std::abs(all.back().b.determinant() / (J * J) - 1) < 1e-12);
    // With it grains push apart as they slide, by 3 B in volume for each unit along dev tau, and the pressure rises.
    drucker_prager swelling = sand;
    swelling.dilatancy = 15;
    const moved_state swollen = moved(swelling, path).back();
    const double sine = std::sin(std::numbers::pi / 12), B = std::sqrt(2. / 3) * 2 * sine / (3 - sine);
    const double pushed = std::log(J) - std::log(swollen.b.determinant()) / 2;
    CHECK(std::abs(pushed - 3 * B * swollen.alpha / std::sqrt(2. / 3)) < 1e-12);
    CHECK(mean_of(swollen.full) < 1.1 * mean_of(end));
}

TEST_CASE("drucker_prager: without friction it is Tresca's circle through compression, 2 cohesion wide") {
    drucker_prager clay = sand;
    clay.friction = 0;
    clay.cohesion = 0.5;
    const tensor3 end = moved(clay, stretched(-0.002, 0.001, 0.001, 50)).back().full;
    CHECK(std::abs(std::abs(end(0, 0) - end(1, 1)) - 2 * clay.cohesion) < 1e-10);
}

TEST_CASE("drucker_prager: no step makes energy, and none leaves the cone") {
    for (const auto& law : {sand, soil})
        for (const auto& motion : {motion_of::there_and_back(0.003, 40), motion_of::twisted(0.004, 100),
                                   joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.01, 100))}) {
            const auto all = moved(law, motion);
            const double degree = std::numbers::pi / 180, sine = std::sin(law.friction * degree),
                         A = std::sqrt(2. / 3) * 2 * sine / (3 - sine),
                         k = std::sqrt(2. / 3) * 6 * law.cohesion * std::cos(law.friction * degree) / (3 - sine);
            double outside = 0, made = 0, slid = 0;
            tensor3 b = tensor3::Identity();
            for (std::size_t n = 0; n < all.size(); ++n) {
                outside = std::max(outside, shear_of(all[n].full) + A * all[n].full.trace() - k);
                // The energy that the elastic trial would have, by strains of Eigen's axes.
                const Eigen::SelfAdjointEigenSolver<tensor3> form(motion[n] * b * motion[n].transpose());
                const Eigen::Vector3d e = form.eigenvalues().array().log() / 2;
                const double mu = young / (2 * (1 + poisson)), K = young / (3 * (1 - 2 * poisson)),
                             trial = mu * (e.array() - e.sum() / 3).square().sum() + K / 2 * e.sum() * e.sum();
                if (n == 0 || all[n - 1].opening == 0) made = std::max(made, all[n].energy - trial);
                CHECK(all[n].alpha >= slid);
                slid = all[n].alpha;
                b = all[n].b;
            }
            CHECK(outside < 1e-12 * young);
            CHECK(made < 1e-13 * young);
            CHECK(slid > 0.01);
        }
}

TEST_CASE("drucker_prager: a turning observer sees the stress turn, and nothing else") {
    const auto motion = joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.005, 60));
    const double angle = 0.11;
    const auto still = moved(soil, motion), turning = moved(soil, motion_of::turned(motion, angle));
    CHECK(seen_otherwise(still, turning, angle) < 1e-12 * young);
}
