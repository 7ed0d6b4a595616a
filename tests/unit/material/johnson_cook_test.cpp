#include <tamis/tamis.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/j2_reference.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using namespace motion_of;
using tensor3 = Eigen::Matrix3d;
using failing = johnson_cook_of<johnson_cook_failure>;

namespace {

// Steel in GPa, mm, us, g/cm^3 and K.
constexpr double young = 206.9, poisson = 0.3;
constexpr johnson_cook steel{.young = young,
                             .poisson = poisson,
                             .density = 7.83,
                             .yield = 0.806,
                             .hardening = 0.614,
                             .exponent = 0.168,
                             .rate_factor = 0.0089,
                             .reference_rate = 1e-6,
                             .softening = 1.1,
                             .reference_temperature = 20,
                             .melting_temperature = 1540,
                             .heat_capacity = 460e-6,
                             .taylor_quinney = 0.9};
constexpr failing brittle{.young = young,
                          .poisson = poisson,
                          .density = 7.83,
                          .yield = 0.6,
                          .hardening = 0.5,
                          .exponent = 0.3,
                          .rate_factor = 0.02,
                          .reference_rate = 1e-6,
                          .softening = 0.8,
                          .reference_temperature = 20,
                          .melting_temperature = 1500,
                          .heat_capacity = 460e-6,
                          .failure = {.d1 = 0.02, .d2 = 0.1, .d3 = -2, .d4 = 0.01, .d5 = 0.6}};
static_assert(!contains<johnson_cook::on_particles, field::damage>);
static_assert(contains<failing::on_particles, field::damage>);

/// Y of the paper.
template <class Law> double strength(const Law& law, double eps, double rate, double temperature) {
    const double warm = std::clamp(
        (temperature - law.reference_temperature) / (law.melting_temperature - law.reference_temperature), 0., 1.);
    return (law.yield + law.hardening * std::pow(eps, law.exponent)) *
           (1 + law.rate_factor * std::log(std::max(rate / law.reference_rate, 1.))) *
           (1 - std::pow(warm, law.softening));
}

/// One particle in plain numbers; bisection of the stress that is left, not of the strain that flows.
template <class Law> struct reference {
    Law law;
    double dt;
    tensor3 b = tensor3::Identity(), tau = tensor3::Zero();
    double J = 1, alpha = 0, temperature = law.reference_temperature, damage = 0;

    double mean() const {
        const double pressed = young / (3 * (1 - 2 * poisson)) / 2 * (J * J - 1);
        return damage >= 1 ? std::min(pressed, 0.) : pressed;
    }
    void step(const tensor3& f) {
        const double mu = young / (2 * (1 + poisson));
        J *= f.determinant();
        const tensor3 f_bar = f / std::cbrt(f.determinant());
        b = f_bar * b * f_bar.transpose();
        const tensor3 s = mu * j2_reference::dev(b);
        const double mises = std::sqrt(1.5) * s.norm(), three_mu = mu * b.trace(), before = temperature;
        const bool gone = damage >= 1;
        const auto bound = [&](double x) { return gone ? 0 : strength(law, alpha + x, x / dt, before); };
        double low = mises;
        if (mises > bound(0)) {
            low = 0;
            double high = mises;
            for (int n = 0; n < 60; ++n) {
                const double q = (low + high) / 2;
                (q < bound((mises - q) / three_mu) ? low : high) = q;
            }
            const double x = (mises - low) / three_mu;
            alpha += x;
            temperature += law.taylor_quinney * low * x / (law.density * law.heat_capacity);
            if constexpr (std::is_same_v<Law, failing>)
                if (!gone) {
                    const auto& [d1, d2, d3, d4, d5] = law.failure;
                    const double warm =
                        (before - law.reference_temperature) / (law.melting_temperature - law.reference_temperature);
                    damage += x / ((d1 + d2 * std::exp(d3 * mean() / low)) *
                                   (1 + d4 * std::log(std::max(x / dt / law.reference_rate, 1.))) * (1 + d5 * warm));
                }
        }
        const tensor3 left = damage >= 1 ? tensor3::Zero() : tensor3(s * low / std::max(mises, 1e-300));
        b = left / mu + j2_reference::root(left / mu) * tensor3::Identity();
        tau = mean() * tensor3::Identity() + left;
    }
};

template <int D, class T, class Law> void is_the_reference(const Law& law, double dt, const auto& motion) {
    double worst = 0;
    const auto compare = [&](double distance, double of) { worst = std::max(worst, distance / of); };
    beside<D, T>(
        moved<D, T>(law, dt, motion), motion, reference<Law>{law, dt},
        [&](const moved_state& is, const reference<Law>& plain) {
            const double size = std::max(plain.tau.norm(), law.yield / 10);
            compare((is.full - plain.tau).norm(), size);
            compare((is.tau - plain.tau.topLeftCorner(D, D)).norm(), size);
            compare((is.b - plain.b).norm(), 1);
            compare(std::abs(is.J - plain.J), 1);
            compare(std::abs(is.alpha - plain.alpha), std::max(plain.alpha, 1e-4));
            compare(std::abs(is.temperature - plain.temperature), plain.temperature);
            compare(std::abs(is.damage - std::min(plain.damage, 1.)), 1);
        },
        [&](int l, const reference<Law>& plain) {
            CAPTURE(D, l, dt);
            CHECK(worst < 1e-10);
            CHECK(plain.alpha > 5e-3);
            if (std::is_same_v<Law, failing> && l == 0) CHECK(plain.damage > 0.1);
        });
}

}  // namespace

TEST_CASE("johnson_cook: a plain particle's steps, in 1D, plane strain and 3D, in lanes and without") {
    const auto all = [&]<class T>(T) {
        // At 2e5, 20 and 2e-3 1/s, the last slower than the reference; lanes differ.
        for (const double dt : {0.01, 100., 1e6}) {
            const auto size = [](int l) { return 0.004 / (1 + l / 3.); };
            const auto there = [&](int l) { return motion_of::there_and_back(size(l), 12); };
            is_the_reference<1, T>(steel, dt, there);
            is_the_reference<2, T>(brittle, dt, there);
            const auto twisted = [&](int l) { return motion_of::twisted(2 * size(l), 30); };
            is_the_reference<3, T>(steel, dt, twisted);
            is_the_reference<3, T>(brittle, dt, twisted);
        }
    };
    all(0.);
    all(native_lanes::type<double>());
}

TEST_CASE("johnson_cook: one straight line of hardening, neither rate nor heat, is j2") {
    const j2 book{.young = young, .poisson = poisson, .density = 7.83, .yield = 0.8, .hardening = 3};
    const johnson_cook same{.young = young, .poisson = poisson, .density = 7.83, .yield = 0.8, .hardening = 3};
    const auto motion = motion_of::twisted(0.004, 60);
    j2_reference plain{young / (2 * (1 + poisson)), young / (3 * (1 - 2 * poisson)), book.yield, book.hardening};
    const auto ours = moved(same, 1, motion);
    double worst = 0;
    for (std::size_t n = 0; n < motion.size(); ++n) {
        plain.step(motion[n]);
        worst = std::max({worst, (ours[n].full - plain.tau).norm(), std::abs(ours[n].alpha - plain.alpha)});
    }
    CHECK(worst < 1e-11);
    CHECK(plain.alpha > 0.1);
    CHECK(ours.back().temperature == 0);
}

TEST_CASE(
    "johnson_cook: random states and increments, none too small or too large: the stress that is left solves "
    "the equation") {
    std::mt19937_64 random(7);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto sized = [&](double low, double high) { return std::pow(10., uniform(low, high)); };
    const auto states = [&]<class T>(T, int count, double tolerance) {
        using S = space<3, T>;
        using real = typename S::real;
        constexpr int W = S::width;
        int flowing = 0, lost = 0;
        double worst = 0;
        for (int n = 0; n < count; n += W) {
            johnson_cook law = steel;
            law.yield = sized(-4, 1);
            law.hardening = uniform(0, 1) < 0.1 ? 0 : sized(-4, 1);
            law.exponent = uniform(0.02, 1.5);
            law.rate_factor = uniform(0, 1) < 0.1 ? 0 : sized(-3, 0);
            law.softening = uniform(0.2, 3);
            law.taylor_quinney = 0;
            const double dt = sized(-6, 8);
            auto slot = fresh<S>(law);
            real eps[W], warm[W], shear[W];
            for (int l = 0; l < W; ++l) {
                eps[l] = static_cast<real>(uniform(0, 1) < 0.2 ? 0 : sized(-12, 2));
                warm[l] = static_cast<real>(uniform(0, 1) < 0.1 ? 1540 : uniform(0, 1500));
                shear[l] = static_cast<real>(sized(-7, 2) / dt);
            }
            slot.template get<field::plastic_strain>() = lane<T>::load(eps);
            slot.template get<field::temperature>() = lane<T>::load(warm);
            typename S::tensor L = S::tensor::Zero();
            L(0, 1) = lane<T>::load(shear);
            const auto at = unit_frame<S>();
            detail::strain_slot<S>(law, slot, (1u << W) - 1u, at, L, T(real(dt)));
            const detail::slot_row<S, decltype(slot), fields<const field::stress>> p{slot, at};
            const typename S::tensor full = p[symbols::sigma];
            const T mean = full.trace() / T(real(3)), xx = full(0, 0) - mean, yy = full(1, 1) - mean,
                    zz = full(2, 2) - mean, square = xx * xx + yy * yy + zz * zz + T(real(2)) * full(0, 1) * full(0, 1);
            for (int l = 0; l < W; ++l) {
                // The trial's b is of a simple shear: its deviator by hand.
                const double g = static_cast<double>(real(dt)) * static_cast<double>(shear[l]),
                             mu = young / (2 * (1 + poisson)), three_mu = mu * (3 + g * g);
                const double trial = mu * g * std::sqrt(3 + g * g), left = std::sqrt(1.5 * in_lane(square, l));
                if (!std::isfinite(left)) ++lost;
                // Y(eps + x) at a stress q; the root is where q passes it.
                const auto over = [&](double q) {
                    const double x = std::max((trial - q) / three_mu, 0.);
                    return q - strength(law, static_cast<double>(eps[l]) + x, x / dt, static_cast<double>(warm[l]));
                };
                if (over(trial) > 0) {
                    ++flowing;
                    const double slack = tolerance * trial;
                    worst = std::max(worst, over(left + slack) > 0 ? 0. : 1.);
                    worst = std::max(worst, left < slack || over(left - slack) < 0 ? 0. : 1.);
                } else
                    worst = std::max(worst, std::abs(left - trial) / trial > tolerance ? 1. : 0.);
                if (warm[l] >= real(1540) && left > 1e-12 * trial) worst = 1;
            }
        }
        CHECK(lost == 0);
        CHECK(worst == 0);
        CHECK(flowing > count / 4);
    };
    states(native_lanes::type<double>(), 100000, 2e-14);
    states(native_lanes::type<float>(), 10000, 1e-5);
}

TEST_CASE("johnson_cook: plastic work heats by Taylor and Quinney's share, and softens by the closed form") {
    // Y = A (1 - T*), all plastic work to heat: 1 - T* = e^(-A eps/(rho c (Tm - T0))), as steps become short.
    johnson_cook soft{.young = young, .poisson = poisson, .density = 7.83, .yield = 0.8};
    soft.reference_temperature = 300;
    soft.melting_temperature = 1500;
    soft.heat_capacity = 100e-6;
    soft.taylor_quinney = 1;
    const auto distance = [&](int count) {
        const moved_state end = moved(soft, 1, motion_of::shear(2. / count, count)).back();
        const double expected = 1 - std::exp(-soft.yield * end.alpha / (soft.density * soft.heat_capacity * 1200));
        CHECK(end.alpha > 1);
        return std::abs((end.temperature - 300) / 1200 - expected);
    };
    CHECK(distance(800) < 1e-3);
    CHECK(std::abs(distance(400) / distance(800) - 2) < 0.05);
}

TEST_CASE("johnson_cook: the work done is stored or becomes heat, to the order of the steps") {
    const auto missing = [&](int fold) {
        steps motion;
        for (const tensor3& f : motion_of::there_and_back(0.004, 20))
            for (int k = 0; k < fold; ++k) motion.push_back(tensor3::Identity() + (f - tensor3::Identity()) / fold);
        const auto all = moved(steel, 0.02 / fold, motion);
        double work = 0;
        tensor3 before = tensor3::Zero();
        double flowed = 0;
        for (std::size_t n = 0; n < all.size(); ++n) {
            const tensor3 l = (motion[n] - tensor3::Identity()) * ((motion[n] + tensor3::Identity()) / 2).inverse();
            work += ((before + all[n].full) / 2).cwiseProduct(l).sum();
            before = all[n].full;
            CHECK(all[n].alpha >= flowed);
            CHECK((n == 0 || all[n].temperature >= all[n - 1].temperature));
            flowed = all[n].alpha;
        }
        const double heat = 7.83 * 460e-6 * (all.back().temperature - 20) / 0.9;
        CHECK(heat > 0.1);
        return std::abs(work - all.back().energy - heat) / work;
    };
    // Y d eps is the plastic work but for a part as large as the square of elastic strain, which is left at last.
    const double coarse = missing(2), fine = missing(4), finest = missing(8);
    CAPTURE(coarse, fine, finest);
    CHECK(std::abs((coarse - fine) / (fine - finest) - 2) < 0.8);
    CHECK(finest < 1e-3);
}

TEST_CASE("johnson_cook: what fails bears pressure and no tension; in shear it fails at d1 + d2") {
    johnson_cook_of<johnson_cook_failure> law = brittle;
    law.failure = {.d1 = 0.02, .d2 = 0.03, .d3 = -2};
    const auto sheared = motion_of::shear(0.001, 150);
    const auto all = moved(law, 1, joined(sheared, motion_of::uniaxial(0.01, 5)));
    double failed_at = 0;
    for (std::size_t n = 0; n < sheared.size(); ++n) {
        if (all[n].damage < 1) {
            CHECK(std::abs(all[n].damage - all[n].alpha / 0.05) < 1e-12);
            continue;
        }
        if (failed_at == 0) failed_at = all[n].alpha;
        CHECK(all[n].full.norm() < 1e-12);
        CHECK(all[n].damage == 1);
    }
    CHECK(failed_at >= 0.05);
    CHECK(failed_at < 0.0507);
    // Pulled apart it bears nothing and stores nothing.
    CHECK(all.back().J > 1.05);
    CHECK(all.back().full.norm() < 1e-12);
    CHECK(std::abs(all.back().energy) < 1e-12);
    // It closes before it bears again, by pressure alone.
    const auto closed =
        moved(law, 1, joined(joined(sheared, motion_of::uniaxial(0.01, 5)), motion_of::uniaxial(-0.01, 10)));
    const moved_state end = closed.back();
    CHECK(end.J < 0.96);
    const double kappa = young / (3 * (1 - 2 * poisson));
    CHECK((end.full - kappa / 2 * (end.J * end.J - 1) * tensor3::Identity()).norm() < 1e-11);
    CHECK(std::abs(end.energy - kappa / 2 * ((end.J * end.J - 1) / 2 - std::log(end.J))) < 1e-12);
    CHECK(closed[closed.size() - 7].full.norm() < 1e-11);  // J is still above 1
}

TEST_CASE("johnson_cook: a turning observer sees the stress turn, and nothing else") {
    const auto motion = joined(motion_of::uniaxial(-0.003, 20), motion_of::shear(0.005, 60));
    const auto still = moved(brittle, 0.01, motion), turning = moved(brittle, 0.01, motion_of::turned(motion, 0.11));
    double worst = seen_otherwise(still, turning, 0.11);
    for (std::size_t n = 0; n < still.size(); ++n)
        worst = std::max({worst, std::abs(turning[n].damage - still[n].damage),
                          std::abs(turning[n].temperature - still[n].temperature) / 1000});
    CHECK(worst < 1e-10);
    CHECK(still.back().alpha > 0.1);
}

TEST_CASE(
    "johnson_cook: a lane does not see what others hold; plane and uniaxial strain are three dimensions; float "
    "is near") {
    using T = native_lanes::type<double>;
    const auto motion = motion_of::there_and_back(0.004, 20);
    const auto alike = moved<2, T>(steel, 0.01, [&](int) { return motion; });
    const auto mixed = moved<2, T>(
        steel, 0.01, [&](int l) { return l == 0 ? motion : motion_of::there_and_back(l % 2 ? 1e-5 : 0.02, 20); });
    constexpr std::size_t W = lane<T>::width;
    double apart = 0;
    for (std::size_t n = 0; n < alike.size(); n += W) apart += (alike[n].full - mixed[n].full).norm();
    CHECK(apart == 0);

    const auto thin = moved<2>(steel, 0.01, motion), thick = moved(steel, 0.01, motion);
    CHECK((thin.back().full - thick.back().full).norm() == 0);
    const auto stretch = motion_of::uniaxial(0.002, 60);
    CHECK((moved<1>(steel, 0.01, stretch).back().full - moved(steel, 0.01, stretch).back().full).norm() == 0);

    const moved_state near = moved<2, native_lanes::type<float>>(steel, 0.01, [&](int) { return motion; }).back();
    CHECK((near.full - thin.back().full).norm() < 1e-4 * young);
    CHECK(std::abs(near.temperature - thin.back().temperature) < 0.1);
}

TEST_CASE("johnson_cook: turned inside out, the stress is no number") {
    CHECK(std::isnan(moved(steel, 1, motion_of::uniaxial(-1.5, 1)).back().full.sum()));
    CHECK(std::isnan(moved(brittle, 1, motion_of::uniaxial(-1.5, 2)).back().full.sum()));
}

TEST_CASE("johnson_cook: constants and particles without sense are refused, by name") {
    const auto refused = [](auto change, const char* word) {
        failing law = brittle;
        change(law);
        CAPTURE(word);
        CHECK(names(complaint([&] { law.check(); }), "johnson_cook: ", word));
    };
    CHECK_NOTHROW(steel.check());
    CHECK_NOTHROW(brittle.check());
    refused([](auto& law) { law.young = 0; }, "Young");
    refused([](auto& law) { law.yield = 0; }, "yield stress is 0");
    refused([](auto& law) { law.hardening = -1; }, "hardening is -1");
    refused([](auto& law) { law.exponent = 0; }, "exponent of hardening is 0");
    refused([](auto& law) { law.rate_factor = -1; }, "rate's factor is -1");
    refused([](auto& law) { law.reference_rate = 0; }, "reference rate is 0");
    refused([](auto& law) { law.softening = -1; }, "exponent of softening is -1");
    refused([](auto& law) { law.reference_temperature = NAN; }, "reference temperature is nan");
    refused([](auto& law) { law.melting_temperature = 20; }, "melting temperature is 20");
    refused([](auto& law) { law.heat_capacity = 0; }, "heat capacity is 0");
    refused([](auto& law) { law.taylor_quinney = 2; }, "share is 2");
    refused([](auto& law) { law.failure.d2 = -1; }, "d2 = -1");
    refused([](auto& law) { law.failure.d5 = INFINITY; }, "d5 = inf");

    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}};
    auto body = mpm.make_body(brittle, everywhere, per_cell{1});
    mpm.step(bodies(body), 1e-3);
    CHECK(elastic_energy(body) == 0);
    const auto complains = [&](auto field, double value, double well, const char* word) {
        for (auto p : body) p[field] = value;
        CHECK(names(complaint([&] { mpm.step(bodies(body), 1e-3); }), word));
        for (auto p : body) p[field] = well;
    };
    complains(field::volume_ratio{}, -1, 1, "volume ratio is -1");
    complains(field::plastic_strain{}, -1, 0, "plastic strain is -1");
    complains(field::temperature{}, INFINITY, 20, "temperature is inf");
    CHECK(complaint([&] { mpm.step(bodies(body), 1e-3); }) == "nothing");
    for (auto p : body) p[field::elastic_cauchy_green{}] = tensor3::Zero();
    CHECK(names(complaint([&] { mpm.step(bodies(body), 1e-3); }), "trace 0"));
}
