#include <tamis/tamis.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "catch.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using namespace motion_of;
using tensor3 = Eigen::Matrix3d;
using vector3 = Eigen::Vector3d;

namespace {

constexpr double young = 100, poisson = 0.25, mu = young / (2 * (1 + poisson)), kappa = young / (3 * (1 - 2 * poisson)),
                 dt = 0.125, degree = std::numbers::pi / 180;
constexpr int runs = 160, trials = 6000;
constexpr mohr_coulomb sand{.young = young, .poisson = poisson, .density = 1, .friction = 30};
constexpr mohr_coulomb soil{
    .young = young, .poisson = poisson, .density = 1, .friction = 25, .cohesion = 0.4, .dilatancy = 10, .tension = 0.3};
constexpr mohr_coulomb clay{.young = young, .poisson = poisson, .density = 1, .friction = 0, .cohesion = 0.5};
constexpr mohr_coulomb rock{
    .young = young, .poisson = poisson, .density = 1, .friction = 40, .cohesion = 0.4, .dilatancy = 40};

/// How far a largest and a smallest stress are beyond the pyramid, in its own unit of stress.
double outside(const mohr_coulomb& law, double most, double least) {
    const double A = std::sin(law.friction * degree);
    return (1 + A) * most - (1 - A) * least - 2 * law.cohesion * std::cos(law.friction * degree);
}
double apex_of(const mohr_coulomb& law) {
    const double apex = law.friction > 0 ? law.cohesion / std::tan(law.friction * degree) : INFINITY;
    return std::min(apex, law.tension);
}
tensor3 log_of(const tensor3& a) {
    const Eigen::SelfAdjointEigenSolver<tensor3> form(a);
    return form.eigenvectors() * form.eigenvalues().array().log().matrix().asDiagonal() *
           form.eigenvectors().transpose();
}

/// One particle in plain numbers: Hencky's strain in axes that Eigen finds, in no order. Active are some of seven
/// planes, the pyramid's six and the largest mean stress; all choices of up to three are tried for multipliers that are
/// not negative and a stress that is beyond no plane. Where the apex leaves several, the one that opens most.
class reference {
  public:
    explicit reference(const mohr_coulomb& law) {
        const double A = std::sin(law.friction * degree), B = std::sin(law.dilatancy * degree);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if (i != j)
                    add((1 + A) * vector3::Unit(i) - (1 - A) * vector3::Unit(j),
                        (1 + B) * vector3::Unit(i) - (1 - B) * vector3::Unit(j),
                        2 * law.cohesion * std::cos(law.friction * degree));
        const vector3 third = vector3::Constant(1. / 3);
        if (std::isfinite(apex_of(law))) add(third, third, apex_of(law));
        sets_.push_back({});
        for (int i = 0; i < planes_; ++i) {
            add_set({i});
            for (int j = i + 1; j < planes_; ++j) {
                add_set({i, j});
                for (int k = j + 1; k < planes_; ++k) add_set({i, j, k});
            }
        }
    }
    tensor3 b = tensor3::Identity(), tau = tensor3::Zero();
    double opening = 0, alpha = 0;
    /// How many of the pyramid's planes were active in the last step, and how far the stresses of all the choices that
    /// are right have been apart since the start.
    int slides = 0;
    double apart = 0;

    void start() {
        b = tensor3::Identity();
        opening = alpha = 0;
    }
    void step(const tensor3& f) {
        const Eigen::SelfAdjointEigenSolver<tensor3> form(f * b * f.transpose());
        const vector3 trial = form.eigenvalues().array().log() / 2 + opening / 3;
        double over[7]{};
        for (int i = 0; i < planes_; ++i) over[i] = beyond(i, trial.data());
        std::vector<choice> near;
        double least = INFINITY;
        for (const set& active : sets_) {
            choice now{{trial[0], trial[1], trial[2]}, 0, 0, 0};
            for (int r = 0; r < active.count; ++r) {
                double multiplier = 0;
                for (int c = 0; c < active.count; ++c) multiplier += active.inverse[r][c] * over[active.planes[c]];
                now.wrong = -multiplier > now.wrong ? -multiplier : now.wrong;
                for (int d = 0; d < 3; ++d) now.strain[d] -= multiplier * flows_[active.planes[r]][d];
                if (active.planes[r] == 6)
                    now.opened = multiplier;
                else
                    ++now.slides;
            }
            if (now.wrong > 1e-9) continue;
            for (int i = 0; i < planes_; ++i) now.wrong = std::max(now.wrong, beyond(i, now.strain) / young);
            least = std::min(least, now.wrong);
            near.push_back(now);
        }
        REQUIRE(least < 1e-13);
        const choice* best = nullptr;
        for (const choice& one : near)
            if (one.wrong <= least + 1e-14 && (!best || one.opened > best->opened)) best = &one;
        for (const choice& one : near)
            if (one.wrong <= least + 1e-14)
                for (int d = 0; d < 3; ++d) apart = std::max(apart, std::abs(one.strain[d] - best->strain[d]));
        slides = best->slides;
        opening = std::max(best->opened, 0.);
        const vector3 strain(best->strain), gone = trial - strain;
        alpha += std::sqrt(2. / 3) * (gone.array() - gone.mean()).matrix().norm();
        const tensor3 R = form.eigenvectors();
        b = R * (2 * strain.array()).exp().matrix().asDiagonal() * R.transpose();
        tau = R * stress_of(strain).asDiagonal() * R.transpose();
    }

  private:
    // Arrays: tests are compiled without optimisation.
    struct set {
        int count = 0, planes[3]{};
        double inverse[3][3]{};
    };
    struct choice {
        double strain[3], wrong, opened;
        int slides;
    };
    int planes_ = 0;
    double normals_[7][3]{}, flows_[7][3]{}, bounds_[7]{};
    std::vector<set> sets_;

    static vector3 stress_of(const vector3& e) { return 2 * mu * e.array() + (kappa - 2 * mu / 3) * e.sum(); }
    double beyond(int plane, const double* e) const {
        const double* n = normals_[plane];
        return 2 * mu * (n[0] * e[0] + n[1] * e[1] + n[2] * e[2]) +
               (kappa - 2 * mu / 3) * (n[0] + n[1] + n[2]) * (e[0] + e[1] + e[2]) - bounds_[plane];
    }
    void add(const vector3& normal, const vector3& flow, double bound) {
        for (int d = 0; d < 3; ++d) {
            normals_[planes_][d] = normal[d];
            flows_[planes_][d] = flow[d];
        }
        bounds_[planes_++] = bound;
    }
    void add_set(const std::vector<int>& planes) {
        const int m = static_cast<int>(planes.size());
        tensor3 M = tensor3::Identity();
        set added{m, {}, {}};
        for (int r = 0; r < m; ++r) {
            added.planes[r] = planes[static_cast<std::size_t>(r)];
            for (int c = 0; c < m; ++c) {
                const int flow = planes[static_cast<std::size_t>(c)];
                M(r, c) = beyond(added.planes[r], flows_[flow]) + bounds_[added.planes[r]];
            }
        }
        if (std::abs(M.determinant()) < 1e-6 * std::pow(mu, m)) return;
        const tensor3 inverse = M.inverse();
        for (int r = 0; r < m; ++r)
            for (int c = 0; c < m; ++c) added.inverse[r][c] = inverse(r, c);
        sets_.push_back(added);
    }
};

template <class Law> std::vector<moved_state> moved(const Law& law, const steps& motion) {
    return ::moved(law, dt, motion);
}

/// Every step of every lane, to 1e-12 of the modulus and of strains of 1; of float, as near as it is.
template <int D, class T> void is_the_reference(const mohr_coulomb& law, const auto& motion) {
    const bool is_float = sizeof(typename lane<T>::real) == 4;
    double worst = 0, most = 0;
    beside<D, T>(
        ::moved<D, T>(law, dt, motion), motion, reference{law},
        [&](const moved_state& is, const reference& plain) {
            worst = std::max({worst, (is.full - plain.tau).norm() / young, (is.b - plain.b).norm(),
                              (is.tau - plain.tau.topLeftCorner(D, D)).norm() / young,
                              std::abs(is.opening - plain.opening), std::abs(is.alpha - plain.alpha)});
        },
        [&](int l, const reference& plain) {
            CAPTURE(D, l, law.friction);
            CHECK(worst < (is_float ? 2e-5 : 1e-12));
            most = std::max(most, plain.alpha);
        });
    CHECK(most > 1e-3);
}
/// Lanes differ: some slide, some come apart where others do not.
double size_of(int l) { return 0.003 / (1 + l); }
steps sheared(int l) {
    return joined(stretched(-size_of(l), -size_of(l), -size_of(l), 10), motion_of::twisted(4 * size_of(l), 40));
}
/// Squeezed or stretched evenly, and then some steps in all directions, most of them out of the pyramid.
steps anywhere(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    steps all{tensor3::Identity() * (0.9975 + 0.005 * any(random))};
    for (int n = 0; n < 4; ++n) {
        tensor3 f = tensor3::Identity() * (1 + 0.002 * any(random));
        const double size = 0.02 * std::pow(10., any(random) - 1);
        for (int c = 0; c < 9; ++c) f.data()[c] += size * any(random);
        all.push_back(f);
    }
    return all;
}

}  // namespace

TEST_CASE("mohr_coulomb: a plain particle's steps, in 1D, plane strain and 3D, in lanes of every width and float") {
    const auto dimensions = [&]<class T>(T) {
        for (const auto& law : {sand, soil, clay}) {
            const auto squeezed = [](int l) {
                return joined(joined(motion_of::uniaxial(-size_of(l), 15), motion_of::uniaxial(size_of(l), 30)),
                              motion_of::uniaxial(-size_of(l), 20));
            };
            is_the_reference<1, T>(law, squeezed);
            is_the_reference<2, T>(law, sheared);
            is_the_reference<3, T>(law, sheared);
        }
    };
    dimensions(0.);
    dimensions(native_lanes::type<double>());
    is_the_reference<3, float>(soil, sheared);
    is_the_reference<3, native_lanes::type<float>>(soil, sheared);
#if TAMIS_VECTOR_BYTES >= 32
    is_the_reference<3, lanes<2>::type<double>>(soil, sheared);
    is_the_reference<3, lanes<4>::type<float>>(soil, sheared);
#endif
}

TEST_CASE("mohr_coulomb: a lane is the same whatever the others hold") {
    using T = native_lanes::type<double>;
    constexpr std::size_t W = lane<T>::width;
    const auto beside = ::moved<3, T>(soil, dt, sheared),
               alone =
                   ::moved<3, T>(soil, dt, [](int l) { return l == 0 ? sheared(0) : steps(50, tensor3::Identity()); });
    double apart = 0;
    for (std::size_t n = 0; n < beside.size(); n += W)
        apart = std::max({apart, (beside[n].full - alone[n].full).norm(), (beside[n].b - alone[n].b).norm(),
                          std::abs(beside[n].alpha - alone[n].alpha)});
    CHECK(apart == 0);
}

TEST_CASE("mohr_coulomb: the only choice of planes whose multipliers are not negative, wherever the trial is") {
    using T = native_lanes::type<double>;
    constexpr int W = lane<T>::width;
    std::mt19937 random(11);
    for (const auto& law : {sand, soil, clay, rock}) {
        double worst = 0;
        int count[2][3]{};
        reference plain(law);
        for (int run = 0; run < runs; run += W) {
            std::vector<steps> all;
            for (int l = 0; l < W; ++l) all.push_back(anywhere(random));
            const auto ours = ::moved<3, T>(law, dt, [&](int l) { return all[static_cast<std::size_t>(l)]; });
            for (std::size_t l = 0; l < W; ++l) {
                plain.start();
                for (std::size_t n = 0; n < all[l].size(); ++n) {
                    plain.step(all[l][n]);
                    const moved_state& is = ours[n * W + l];
                    worst = std::max({worst, (is.full - plain.tau).norm() / young, std::abs(is.opening - plain.opening),
                                      std::abs(is.alpha - plain.alpha)});
                    ++count[plain.opening > 0][plain.slides > 1 ? 2 : plain.slides];
                }
            }
        }
        CAPTURE(law.friction, law.dilatancy, worst * 1e15, plain.apart * 1e15);
        CHECK(worst < 1e-12);
        CHECK(plain.apart < 1e-12);
        // All regions were there: inside, a plane, an edge; the same at the largest mean stress, or the apex alone.
        CHECK(std::min({count[0][0], count[0][1], count[0][2]}) > 10);
        if (law.tension < 1)
            CHECK(std::min({count[1][0], count[1][1], count[1][2]}) > 10);
        else if (law.friction > 0)
            CHECK(count[1][2] > 10);
    }
}

TEST_CASE("mohr_coulomb: trial states come back to the pyramid") {
    // Along the grid's axes, in all their orders; the tensors of other axes are tried above.
    using S = space<3, native_lanes::type<double>>;
    using list = merge<fields<field::stress>, on_particles_t<mohr_coulomb>>;
    constexpr int W = S::width;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    const detail::frame<S> at{1., 1., {}};
    for (const auto& law : {sand, soil, clay, rock}) {
        double worst = 0, mean = 0;
        int on = 0;
        for (int n = 0; n < trials; n += W) {
            values<S, list> slot;
            slot.set_zero();
            for (int d = 0; d < 3; ++d) slot.get<field::elastic_cauchy_green>()[d] = S::scalar(1.);
            S::tensor L = detail::isotropic<S::tensor>(S::scalar(0.));
            double rates[3][W];
            for (int l = 0; l < W; ++l) {
                const double even = 0.01 * any(random) - 0.005;
                for (auto& rate : rates) rate[l] = (even + 0.02 * any(random)) / dt;
            }
            for (int d = 0; d < 3; ++d) L(d, d) = lane<S::scalar>::load(rates[d]);
            detail::strain_slot<S>(law, slot, (1u << W) - 1u, at, L, S::scalar(dt));
            double stress[3][W];
            for (int d = 0; d < 3; ++d) lane<S::scalar>::store(stress[d], slot.get<field::stress>()[d]);
            for (int l = 0; l < W; ++l) {
                const double a = stress[0][l], b = stress[1][l], c = stress[2][l];
                const double scale = std::max({std::abs(a), std::abs(b), std::abs(c), law.cohesion, 1e-3});
                const double most = std::max({a, b, c}), least = std::min({a, b, c});
                worst = std::max(worst, outside(law, most, least) / scale);
                mean = std::max(mean, ((a + b + c) / 3 - apex_of(law)) / scale);
                on += outside(law, most, least) > -1e-12;
            }
        }
        CAPTURE(law.friction, law.dilatancy, on);
        CHECK(worst < 1e-12);
        CHECK(mean < 1e-12);
        CHECK(on > trials / 3);
    }
}

TEST_CASE("mohr_coulomb: triaxial tests fail at N_phi, in compression and in extension") {
    // Squeezed evenly, then so that the mean strain stays.
    const steps before = stretched(-0.01, -0.01, -0.01, 10);
    for (const auto& law : {sand, soil, rock, clay}) {
        const double A = std::sin(law.friction * degree), N = (1 + A) / (1 - A);
        for (const double along : {-0.01, 0.01}) {
            const double sideways = 1 / std::sqrt(1 + along) - 1;
            const auto all = moved(law, joined(before, stretched(along, sideways, sideways, 40)));
            const tensor3 end = -all.back().full;  // pressures
            const double most = std::max(end(0, 0), end(1, 1)), least = std::min(end(0, 0), end(1, 1));
            CHECK((end(0, 0) > end(1, 1)) == (along < 0));
            CHECK(std::abs(most - N * least - 2 * law.cohesion * std::sqrt(N)) < 1e-10 * most);
            CHECK(std::abs(end(1, 1) - end(2, 2)) < 1e-12 * most);
            CHECK(all.back().alpha > 0.04);
        }
    }
}

TEST_CASE("mohr_coulomb: where both sides are alike in compression, it is drucker_prager's cone") {
    const auto path = joined(joined(stretched(-0.01, -0.01, -0.01, 10), stretched(-0.01, 0.004, 0.004, 60)),
                             joined(stretched(0.008, 0.01, 0.01, 20), stretched(-0.01, -0.002, -0.002, 20)));
    for (const auto& law : {sand, soil, rock}) {
        const drucker_prager cone{law.young,    law.poisson,   law.density, law.friction,
                                  law.cohesion, law.dilatancy, INFINITY};
        auto pyramid = law;
        pyramid.tension = INFINITY;
        const auto ours = moved(pyramid, path), theirs = moved(cone, path);
        double worst = 0, opened = 0;
        for (std::size_t n = 0; n < path.size(); ++n) {
            worst = std::max({worst, (ours[n].full - theirs[n].full).norm() / young,
                              std::abs(ours[n].opening - theirs[n].opening), std::abs(ours[n].alpha - theirs[n].alpha),
                              std::abs(ours[n].energy - theirs[n].energy) / young});
            opened = std::max(opened, ours[n].opening);
        }
        CHECK(worst < 1e-12);
        CHECK((opened > 0.01 || law.cohesion > 0));
    }
}

TEST_CASE("mohr_coulomb: squeezed along one axis it slides on the edge, back on the other") {
    // The elastic strain is (strain + (1 - s) flow, -(1 + s)/2 flow, the same), and what lies beyond linear in the
    // flow.
    const double A = std::sin(soil.friction * degree), s = std::sin(soil.dilatancy * degree),
                 c = 2 * soil.cohesion * std::cos(soil.friction * degree);
    const auto stresses = [](double axial, double side) {
        const double round = (kappa - 2 * mu / 3) * (axial + 2 * side);
        return std::pair{round + 2 * mu * axial, round + 2 * mu * side};
    };
    const steps path = motion_of::uniaxial(-0.01, 30);
    const auto ours = ::moved<1>(soil, dt, path);
    double worst = 0;
    int slid = 0;
    for (std::size_t n = 0; n < path.size(); ++n) {
        const double strain = static_cast<double>(n + 1) * std::log(0.99);
        const auto beyond = [&](double flow) {
            const auto [axial, side] = stresses(strain + (1 - s) * flow, -(1 + s) / 2 * flow);
            return (1 + A) * side - (1 - A) * axial - c;
        };
        const double flow = std::max(beyond(0) / (beyond(0) - beyond(1)), 0.);
        const auto [axial, side] = stresses(strain + (1 - s) * flow, -(1 + s) / 2 * flow);
        worst = std::max({worst, std::abs(ours[n].full(0, 0) - axial), std::abs(ours[n].full(2, 2) - side),
                          std::abs(ours[n].alpha - (1 - s / 3) * flow)});
        slid += flow > 0;
    }
    CHECK(worst < 1e-10 * young);
    CHECK((slid > 20 && slid < 30));
    // Unloaded it is elastic first, and squeezed again it comes back to where it was.
    const auto again =
        ::moved<1>(soil, dt, joined(path, joined(motion_of::uniaxial(0.01, 1), motion_of::uniaxial(1 / 1.01 - 1, 1))));
    const auto [axial, side] = stresses(std::log(1.01), 0);
    CHECK(std::abs(again[30].full(0, 0) - ours[29].full(0, 0) - axial) < 1e-10 * young);
    CHECK(std::abs(again[30].full(1, 1) - ours[29].full(1, 1) - side) < 1e-10 * young);
    CHECK((again[31].full - ours[29].full).norm() < 1e-10 * young);
    CHECK(std::abs(again[31].alpha - ours[29].alpha) < 1e-14);
}

TEST_CASE(
    "mohr_coulomb: sheared in a plane it slides on a plane at the angle of friction, swelling by that of dilatancy") {
    for (mohr_coulomb law : {sand, soil, rock, clay}) {
        law.poisson = 0.4;  // that the stress out of the plane is between the others
        const steps path = joined(stretched(-0.0005, -0.0005, 0, 10), motion_of::shear(0.01, 60));
        const auto all = ::moved<2>(law, dt, path);
        const tensor3 end = all.back().full;
        const double half = (end(0, 0) + end(1, 1)) / 2, radius = std::hypot((end(0, 0) - end(1, 1)) / 2, end(0, 1));
        CHECK(std::abs(radius - law.cohesion * std::cos(law.friction * degree) +
                       half * std::sin(law.friction * degree)) < 1e-10);
        CHECK((end(2, 2) < half + radius - 0.01 && end(2, 2) > half - radius + 0.01));
        // The shear keeps the volume, so that what the flow swells the elastic strain has lost; alpha is the flow's
        // length.
        double J = 1;
        for (std::size_t n = 0; n < path.size(); ++n)
            J *= path[n](0, 0) * path[n](1, 1) - path[n](0, 1) * path[n](1, 0);
        const double s = std::sin(law.dilatancy * degree), swollen = std::log(J) - log_of(all.back().b).trace() / 2,
                     flow = all.back().alpha / std::sqrt(2. / 3) / std::sqrt(2 + 2 * s * s / 3);
        CHECK(std::abs(swollen - 2 * s * flow) < 1e-10);
    }
}

TEST_CASE("mohr_coulomb: grains that slide while they are apart do not swell, others bear their tension") {
    // Grains that slide to and fro while they are apart do not swell.
    steps shaken = stretched(0.01, 0.01, 0.01, 5);
    for (const double size : {0.02, -0.02, 0.02, -0.02}) shaken = joined(shaken, motion_of::shear(size, 5));
    CHECK(std::abs(moved(sand, shaken).back().opening - 15 * std::log(1.01)) < 1e-12);
    // Others bear their tension, or what the apex bears, and no more.
    const auto mean_of = [](const mohr_coulomb& law) {
        return moved(law, stretched(0.01, 0.01, 0.01, 10)).back().full.trace() / 3;
    };
    CHECK(std::abs(mean_of(soil) - soil.tension) < 1e-12);
    CHECK(std::abs(mean_of(rock) - rock.cohesion / std::tan(rock.friction * degree)) < 1e-12);
    CHECK(std::abs(mean_of(clay) - kappa * 30 * std::log(1.01)) < 1e-10);
}

TEST_CASE("mohr_coulomb: work goes into what is stored and what flows, which takes it and never gives") {
    for (const auto& law : {sand, soil, clay, rock})
        for (const bool shears : {true, false}) {
            // Of a step half as long, half the difference.
            double error[2];
            for (int fine = 0; fine < 2; ++fine) {
                const int by = fine + 1;
                const steps path = shears ? joined(stretched(-0.004 / by, -0.004 / by, -0.004 / by, 10 * by),
                                                   motion_of::shear(0.01 / by, 50 * by))
                                          : motion_of::there_and_back(0.004 / by, 20 * by);
                const auto all = moved(law, path);
                double work = 0, flown = 0, least = 0;
                tensor3 b = tensor3::Identity(), tau = tensor3::Zero();
                for (std::size_t n = 0; n < path.size(); ++n) {
                    const tensor3 rate = log_of(path[n] * path[n].transpose()) / 2,
                                  gone = (log_of(path[n] * b * path[n].transpose()) - log_of(all[n].b)) / 2,
                                  now = all[n].full;
                    const double flows = (now.transpose() * gone).trace();
                    work += ((tau + now) / 2 * rate).trace();
                    flown += flows;
                    // What has opened under tension gives it back as it closes.
                    const double opens = (all[n].opening - (n > 0 ? all[n - 1].opening : 0)) * apex_of(law);
                    least = std::min(least, opens < 0 ? flows - opens : flows);
                    CHECK(all[n].alpha >= (n > 0 ? all[n - 1].alpha : 0));
                    b = all[n].b;
                    tau = now;
                }
                CHECK(least > -1e-13 * young);
                CHECK(flown > 0.005);
                error[fine] = std::abs(all.back().energy + flown - work) / work;
            }
            CAPTURE(law.friction, shears, error[0], error[1]);
            CHECK(error[0] < 0.05);
            CHECK(error[1] < 0.6 * error[0]);
        }
}

TEST_CASE("mohr_coulomb: a turning observer sees the stress turn, and nothing else") {
    const auto motion = joined(stretched(-0.004, -0.004, -0.004, 10), motion_of::shear(0.005, 60));
    const double angle = 0.11;
    const auto still = moved(soil, motion), turning = moved(soil, motion_of::turned(motion, angle));
    double apart = 0;
    for (std::size_t n = 0; n < still.size(); ++n) apart = std::max(apart, std::abs(turning[n].alpha - still[n].alpha));
    CHECK(apart < 1e-12);
    CHECK(seen_otherwise(still, turning, angle) < 1e-12 * young);
}

TEST_CASE("mohr_coulomb: turned inside out, the stress is no number") {
    CHECK(std::isnan(moved(soil, motion_of::uniaxial(-1.5, 1)).back().full.sum()));
    CHECK(std::isnan(::moved<1>(soil, dt, motion_of::uniaxial(-1.5, 1)).back().tau.sum()));
}
