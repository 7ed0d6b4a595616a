#include <tamis/tamis.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using namespace motion_of;
using tensor3 = Eigen::Matrix3d;

namespace {

constexpr double young = 100, poisson = 0.25, G = young / (2 * (1 + poisson)), K = young / (3 * (1 - 2 * poisson));
constexpr double usual_dt = 0.125;
constexpr granular_flow sand{.young = young,
                             .poisson = poisson,
                             .density = 1.5,
                             .static_friction = 0.4,
                             .limit_friction = 0.7,
                             .inertial_number = 0.3,
                             .grain_diameter = 0.2,
                             .grain_density = 2.5};
granular_flow with_diameter(double d) {
    granular_flow law = sand;
    law.grain_diameter = d;
    return law;
}
double friction_at(const granular_flow& law, double I) {
    return law.static_friction + (law.limit_friction - law.static_friction) / (law.inertial_number / I + 1);
}

/// One particle in plain numbers: the density says whether it bears stress and how much pressure; Hencky's strain in
/// axes that Eigen finds; the rate of flow by bisection of the friction that it makes against the stress that it
/// leaves.
struct reference {
    granular_flow law;
    tensor3 b = tensor3::Identity(), tau = tensor3::Zero();
    double dt = usual_dt, density = law.density, alpha = 0, rate = 0;

    void step(const tensor3& f) {
        density /= f.determinant();
        const double J = law.density / density, P = std::max(-K * std::log(J), 0.), p = P / J;
        const Eigen::SelfAdjointEigenSolver<tensor3> form(f * b * f.transpose());
        const Eigen::Vector3d e = form.eigenvalues().array().log() / 2;
        Eigen::Vector3d s = 2 * G * (e.array() - e.sum() / 3);  // dev tau
        const double before = s.norm() / std::sqrt(2.);
        rate = 0;
        double after = before;
        if (P == 0) {
            rate = before / (G * dt);
            after = 0;
        } else if (before > law.static_friction * P) {
            const auto too_slow = [&](double flow) {
                return before - G * dt * flow >
                       friction_at(law, flow * law.grain_diameter * std::sqrt(law.grain_density / p)) * P;
            };
            double low = 0, high = before / (G * dt);
            for (int n = 0; n < 200; ++n) (too_slow((low + high) / 2) ? low : high) = (low + high) / 2;
            rate = high;
            after = before - G * dt * rate;
        }
        alpha += rate * dt / std::sqrt(3.);
        s *= before > 0 ? after / before : 0;
        const tensor3 R = form.eigenvectors();
        b = R * (s.array() / G - 2 * P / (3 * K)).exp().matrix().asDiagonal() * R.transpose();
        tau = R * (s.array() - P).matrix().asDiagonal() * R.transpose();
    }
};

std::vector<moved_state> moved(const granular_flow& law, const steps& motion, double dt = usual_dt) {
    return ::moved(law, dt, motion);
}
/// Pressure, and the shear stress.
double mean_of(const moved_state& is) { return -is.full.trace() / 3; }
double shear_of(const moved_state& is) { return (is.full + mean_of(is) * tensor3::Identity()).norm() / std::sqrt(2.); }

template <int D, class T> void is_the_reference(const granular_flow& law, const auto& motion) {
    double worst = 0, slid = 0;
    beside<D, T>(
        ::moved<D, T>(law, usual_dt, motion), motion, reference{law},
        [&](const moved_state& is, const reference& plain) {
            const double opening = std::max(std::log(law.density / plain.density), 0.);
            worst = std::max({worst, (is.full - plain.tau).norm() / young, (is.b - plain.b).norm(),
                              (is.tau - plain.tau.topLeftCorner(D, D)).norm() / young, std::abs(is.opening - opening),
                              std::abs(is.alpha - plain.alpha)});
        },
        [&](int l, const reference& plain) {
            CAPTURE(D, l, law.grain_diameter);
            CHECK(worst < 1e-12);
            slid = std::max(slid, plain.alpha);
        });
    CHECK(slid > 1e-3);
}
/// One step to a volume of which the logarithm is `size`.
steps squeezed(double size) { return steps(1, tensor3(std::exp(size / 3) * tensor3::Identity())); }
/// Pure shear by `size` a step: coaxial, at constant volume, sqrt(2 D:D) dt = size.
steps pure_shear(double size, int count) {
    return steps(static_cast<std::size_t>(count),
                 Eigen::Vector3d(std::exp(size / 2), std::exp(-size / 2), 1).asDiagonal());
}

}  // namespace

TEST_CASE("granular_flow: a plain particle's steps, in 1D, plane strain and 3D, in lanes and without") {
    const auto dimensions = [&]<class T>(T) {
        granular_flow even = sand;
        even.limit_friction = even.static_friction;
        for (const auto& law : {sand, with_diameter(20), even}) {
            // Lanes differ: some flow, some come apart where others do not.
            const auto size = [](int l) { return 0.002 / (1 + l); };
            const auto to_and_fro = [&](int l) {
                return joined(joined(motion_of::uniaxial(-size(l), 40), motion_of::uniaxial(size(l), 60)),
                              motion_of::uniaxial(-size(l), 40));
            };
            is_the_reference<1, T>(law, to_and_fro);
            is_the_reference<2, T>(law, to_and_fro);
            is_the_reference<3, T>(law, to_and_fro);
            const auto sheared = [&](int l) {
                return joined(stretched(-size(l), -size(l), -size(l), 10), motion_of::twisted(4 * size(l), 40));
            };
            is_the_reference<2, T>(law, sheared);
            is_the_reference<3, T>(law, sheared);
        }
    };
    dimensions(0.);
    dimensions(native_lanes::type<double>());
}

TEST_CASE("granular_flow: steady shear is borne with mu(I), over five decades of I and at any pressure") {
    for (const double ln_J : {-0.02, -0.001})
        for (const double I : {1e-4, 1e-3, 0.01, 0.1, 0.3, 1., 10.}) {
            // The pressure is that of the density, p = -K ln J/J; the step's length makes the rate.
            const double p = -K * ln_J / std::exp(ln_J), g = 0.002;
            const double rate = I / (sand.grain_diameter * std::sqrt(sand.grain_density / p));
            const auto all = moved(sand, joined(squeezed(ln_J), pure_shear(g, 60)), g / rate);
            const moved_state &end = all.back(), &before = all[all.size() - 2];
            CAPTURE(ln_J, I);
            CHECK(std::abs(mean_of(end) / std::exp(ln_J) / p - 1) < 1e-11);
            CHECK(std::abs(shear_of(end) / mean_of(end) / friction_at(sand, I) - 1) < 1e-11);
            CHECK(std::abs((end.alpha - before.alpha) * std::sqrt(3.) / g - 1) < 1e-11);
            // The excess over mu_s too, down to where I is small.
            CHECK(std::abs((shear_of(end) / mean_of(end) - 0.4) / (0.3 / (0.3 / I + 1)) - 1) < 1e-7);
        }
}

TEST_CASE("granular_flow: in simple shear, which turns, mu(I) is missed by no more than elastic strain") {
    const auto missed = [&](double ln_J, double I) {
        const double p = -K * ln_J / std::exp(ln_J), g = 0.002;
        const double rate = I / (sand.grain_diameter * std::sqrt(sand.grain_density / p));
        const moved_state end = moved(sand, joined(squeezed(ln_J), motion_of::shear(g, 200)), g / rate).back();
        CHECK(std::abs(shear_of(end) / end.full(0, 1) - 1) < -ln_J);
        return std::abs(shear_of(end) / mean_of(end) / friction_at(sand, I) - 1);
    };
    for (const double I : {1e-4, 0.1, 10.}) {
        CAPTURE(I);
        CHECK(missed(-1e-2, I) < 1e-5);
        CHECK(missed(-1e-3, I) < 1e-6);
    }
}

TEST_CASE("granular_flow: below mu_s nothing flows, held above it it creeps down to mu_s, and no rate is above mu_2") {
    const double ln_J = -0.01, P = -K * ln_J;
    // tau/G of shear, tau = ratio P.
    const auto shear_to = [&](double ratio) { return pure_shear(ratio * P / G / 20, 20); };
    const auto still = moved(sand, joined(joined(squeezed(ln_J), shear_to(0.399)), shear_to(-0.399)));
    CHECK(still.back().alpha == 0);
    CHECK(std::abs(shear_of(still[20]) / P - 0.399) < 1e-12);
    CHECK(shear_of(still.back()) < 1e-12);
    const auto held = moved(sand, joined(joined(squeezed(ln_J), pure_shear(2 * P / G, 1)), pure_shear(0, 200)));
    double before = shear_of(held[1]);
    CHECK(before > 0.42 * P);
    for (std::size_t n = 2; n < held.size(); ++n) {
        CHECK(shear_of(held[n]) <= before + 1e-13);
        CHECK(shear_of(held[n]) > (0.4 - 1e-13) * P);
        before = shear_of(held[n]);
    }
    CHECK(before < (0.4 + 1e-9) * P);
    double last = 0;
    for (const double d : {1., 1e2, 1e4, 1e6, 1e12}) {
        const moved_state fast = moved(with_diameter(d), joined(squeezed(ln_J), pure_shear(0.01, 50))).back();
        CHECK(shear_of(fast) / P > last);
        CHECK(shear_of(fast) / P < 0.7 + 1e-13);
        last = shear_of(fast) / P;
    }
    CHECK(std::abs(last - 0.7) < 1e-10);
}

TEST_CASE("granular_flow: less dense than the packing it bears nothing, and denser the same however often it opened") {
    for (const auto& law : {sand, with_diameter(20)}) {
        // Sheared all the while, in and out of contact.
        steps path;
        for (int n = 0; n < 800; ++n) {
            tensor3 f = (1 + 0.004 * std::sin(0.3 * n + 1)) * tensor3::Identity();
            f(0, 1) += 0.003 * std::sin(0.07 * n);
            path.push_back(f);
        }
        const auto all = moved(law, path);
        double volume = 0, borne = 0, deformed = 0, off = 0;
        int parted = 0, met = 0;
        for (std::size_t n = 0; n < path.size(); ++n) {
            const moved_state& is = all[n];
            volume += std::log(path[n].determinant());
            if (volume > 0) {
                parted += n > 0 && all[n - 1].opening == 0;
                borne = std::max(borne, is.tau.norm());
                deformed = std::max({deformed, (is.b - tensor3::Identity()).norm(), is.energy, is.full.norm() / young});
            } else {
                met += n > 0 && all[n - 1].opening > 0;
                off = std::max(off, std::abs(mean_of(is) + K * volume) / young);
            }
            off = std::max(off, std::abs(is.opening - std::max(volume, 0.)));
        }
        CHECK(borne == 0);
        CHECK(deformed < 1e-14);
        CHECK(off < 1e-12);
        CHECK(parted > 20);
        CHECK(met > 20);
    }
}

TEST_CASE("granular_flow: where mu_2 = mu_s it is drucker_prager's cone of the same friction, whatever the rate") {
    const drucker_prager cone{.young = young, .poisson = poisson, .density = 1.5, .friction = 28};
    const double sine = std::sin(28 * std::numbers::pi / 180);
    granular_flow even = sand;
    even.static_friction = even.limit_friction = 2 * std::sqrt(3.) * sine / (3 - sine);
    for (const auto& motion :
         {motion_of::there_and_back(0.003, 40), joined(squeezed(-0.02), motion_of::twisted(0.004, 100)),
          joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.01, 100))}) {
        const auto theirs = ::moved(cone, usual_dt, motion);
        for (const double d : {1e-6, 1e6}) {
            even.grain_diameter = d;
            const auto ours = moved(even, motion);
            double worst = 0;
            for (std::size_t n = 0; n < ours.size(); ++n)
                worst =
                    std::max({worst, (ours[n].full - theirs[n].full).norm() / young, (ours[n].b - theirs[n].b).norm(),
                              std::abs(ours[n].opening - theirs[n].opening), std::abs(ours[n].alpha - theirs[n].alpha),
                              std::abs(ours[n].energy - theirs[n].energy) / young});
            CHECK(worst < 1e-13);
            CHECK(ours.back().alpha > 0.01);
        }
    }
    CHECK(even.wave_speed(2) == cone.wave_speed(2));
}

TEST_CASE("granular_flow: no step makes energy, and the work is what is stored and what flow takes") {
    // The sum of work less what is stored and dissipated, of a motion in `count` steps that last 10 s.
    const auto unbalanced = [&](const granular_flow& law, int count) {
        const double g = 0.3 / count;
        const auto path = joined(squeezed(-0.01), motion_of::shear(g, count));
        const auto all = moved(law, path, 10. / count);
        double work = 0, dissipated = 0;
        for (std::size_t n = 1; n < all.size(); ++n) {
            work += (all[n].full(0, 1) + all[n - 1].full(0, 1)) / 2 * g;
            dissipated += shear_of(all[n]) * std::sqrt(3.) * (all[n].alpha - all[n - 1].alpha);
        }
        CHECK(dissipated > 0.05);
        return std::abs(work - (all.back().energy - all[0].energy) - dissipated) / dissipated;
    };
    for (const auto& law : {sand, with_diameter(20)}) {
        const double coarse = unbalanced(law, 200), fine = unbalanced(law, 400);
        CHECK(coarse < 1e-3);
        CHECK(fine < 0.6 * coarse);
        for (const auto& motion :
             {motion_of::there_and_back(0.003, 40), joined(squeezed(-0.02), motion_of::twisted(0.004, 100)),
              joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.01, 100))}) {
            const auto all = moved(law, motion);
            double made = 0, slid = 0, above = 0;
            tensor3 b = tensor3::Identity();
            for (std::size_t n = 0; n < all.size(); ++n) {
                // The energy that the elastic trial would have, by strains of Eigen's axes.
                const Eigen::SelfAdjointEigenSolver<tensor3> form(motion[n] * b * motion[n].transpose());
                const Eigen::Vector3d e = form.eigenvalues().array().log() / 2;
                const double trial = G * (e.array() - e.sum() / 3).square().sum() + K / 2 * e.sum() * e.sum();
                if (n == 0 || all[n - 1].opening == 0) made = std::max(made, all[n].energy - trial);
                CHECK(all[n].alpha >= slid);
                slid = all[n].alpha;
                b = all[n].b;
                above = std::max(above, shear_of(all[n]) - law.limit_friction * mean_of(all[n]));
            }
            CHECK(made < 1e-13 * young);
            CHECK(above < 1e-13 * young);
            CHECK(slid > 0.01);
        }
    }
}

TEST_CASE("granular_flow: a turning observer sees the stress turn, and nothing else") {
    const auto motion = joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.005, 60));
    const double angle = 0.11;
    const auto still = moved(sand, motion), turning = moved(sand, motion_of::turned(motion, angle));
    double apart = 0;
    for (std::size_t n = 0; n < still.size(); ++n) apart = std::max(apart, std::abs(turning[n].alpha - still[n].alpha));
    CHECK(apart < 1e-12);
    CHECK(seen_otherwise(still, turning, angle) < 1e-12 * young);
    CHECK(still.back().alpha > 0.1);
}

TEST_CASE("granular_flow: float is near, in lanes too, and turned inside out the stress is no number") {
    const auto motion = joined(squeezed(-0.03), motion_of::there_and_back(0.002, 30));
    const auto same = [&](int) { return motion; };
    const tensor3 exact = moved(sand, motion).back().full;
    CHECK((::moved<3, float>(sand, usual_dt, same).back().full - exact).norm() < 1e-4 * young);
    CHECK((::moved<3, native_lanes::type<float>>(sand, usual_dt, same).back().full - exact).norm() < 1e-4 * young);
    CHECK(exact.norm() > 1e-2 * young);
    CHECK(std::isnan(moved(sand, motion_of::uniaxial(-1.5, 1)).back().full.sum()));
    CHECK(std::isnan(moved(sand, joined(squeezed(-0.01), motion_of::uniaxial(-1.5, 2))).back().full.sum()));
}

TEST_CASE("granular_flow: constants and particles without sense are refused, by name") {
    const auto refused = [](auto change, const char* word) {
        granular_flow law = sand;
        change(law);
        CHECK(names(complaint([&] { law.check(); }), "granular_flow", word));
    };
    constexpr double none = std::numeric_limits<double>::quiet_NaN(),
                     infinite = std::numeric_limits<double>::infinity();
    CHECK_NOTHROW(sand.check());
    refused([](auto& law) { law.young = 0; }, "Young");
    refused([](auto& law) { law.poisson = 0.5; }, "Poisson");
    refused([](auto& law) { law.density = 0; }, "the density");
    refused([](auto& law) { law.static_friction = -0.1; }, "static friction");
    refused([](auto& law) { law.static_friction = none; }, "static friction");
    refused([](auto& law) { law.limit_friction = 0.39; }, "limit of friction is 0.39");
    refused([](auto& law) { law.limit_friction = infinite; }, "limit of friction");
    refused([](auto& law) { law.static_friction = law.limit_friction = 0; }, "limit of friction is 0");
    refused([](auto& law) { law.inertial_number = 0; }, "inertial number");
    refused([](auto& law) { law.inertial_number = infinite; }, "inertial number");
    refused([](auto& law) { law.grain_diameter = 0; }, "grain's diameter");
    refused([](auto& law) { law.grain_diameter = infinite; }, "grain's diameter");
    refused([](auto& law) { law.grain_density = 1.4; }, "not below that of the packing, 1.5");
    refused([](auto& law) { law.grain_density = infinite; }, "grain's density");

    using S = space<3, double>;
    auto slot = fresh<S>(sand);
    const auto at = unit_frame<S>();
    const detail::slot_row<S, decltype(slot), on_particles_t<granular_flow>> p{slot, at};
    CHECK_NOTHROW(sand.check(p));
    CHECK(sand.full_stress(p).norm() == 0);
    slot.set_zero();
    CHECK(names(complaint([&] { sand.check(p); }), "trace 0"));
}
