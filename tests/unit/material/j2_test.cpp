#include <tamis/tamis.hpp>

#include <algorithm>
#include <limits>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/j2_reference.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using motion_of::steps;
using tensor3 = Eigen::Matrix3d;

namespace {

constexpr field::elastic_cauchy_green be{};
constexpr field::volume_ratio J{};
constexpr field::plastic_strain alpha{};

constexpr double young = 200, poisson = 0.3, mu = young / (2 * (1 + poisson)), kappa = young / (3 * (1 - 2 * poisson));
constexpr double dt = 0.125;
constexpr j2 steel{.young = young, .poisson = poisson, .density = 1, .yield = 2, .hardening = 15};

j2_reference reference_of(const j2& law) { return {mu, kappa, law.yield, law.hardening}; }

template <int D, class T = double> std::vector<moved_state> moved(const steps& motion, const j2& law = steel) {
    return ::moved<D, T>(law, dt, [&](int) { return motion; });
}

/// Every step of every lane is the reference's, to 1e-10.
template <int D, class T, class Motion> void is_the_reference(const Motion& motion, const j2& law = steel) {
    double worst = 0, most_alpha = 0;
    const auto compare = [&](double distance, double of) { worst = std::max(worst, distance / of); };
    beside<D, T>(
        ::moved<D, T>(law, dt, motion), motion, reference_of(law),
        [&](const moved_state& is, const j2_reference& reference) {
            const double size = std::max(reference.tau.norm(), law.yield / 10);  // on its way back it is nearly 0
            compare((is.tau - reference.tau.topLeftCorner(D, D)).norm(), size);
            compare((is.full - reference.tau).norm(), size);
            compare((is.b - reference.b).norm(), 1);
            compare(std::abs(is.J - reference.J), 1);
            compare(std::abs(is.alpha - reference.alpha), std::max(reference.alpha, 1e-4));
        },
        [&](int l, const j2_reference& reference) {
            CAPTURE(D, l);
            CHECK(worst < 1e-10);
            most_alpha = std::max(most_alpha, reference.alpha);
        });
    CHECK((law.yield > young || most_alpha > 0.01));
}
template <int D> void is_the_reference_in_and_out_of_lanes() {
    // Lanes differ: some of them yield where others do not.
    const auto size = [](int l) { return 0.002 / (1 + l); };
    for (const double hardening : {15., 0.}) {
        j2 law = steel;
        law.hardening = hardening;
        const auto all = [&]<class T>(T) {
            is_the_reference<D, T>([&](int l) { return motion_of::uniaxial(size(l), 60); }, law);
            is_the_reference<D, T>([&](int l) { return motion_of::uniaxial(-size(l), 60); }, law);
            is_the_reference<D, T>([&](int l) { return motion_of::there_and_back(size(l), 30); }, law);
            if constexpr (D > 1) is_the_reference<D, T>([&](int l) { return motion_of::shear(3 * size(l), 200); }, law);
            if constexpr (D > 1) is_the_reference<D, T>([&](int l) { return motion_of::twisted(size(l), 100); }, law);
        };
        all(0.);
        all(native_lanes::type<double>());
    }
}

}  // namespace

TEST_CASE("j2: the book's equations, step by step, in 1D, plane strain and 3D, in lanes and without") {
    is_the_reference_in_and_out_of_lanes<1>();
    is_the_reference_in_and_out_of_lanes<2>();
    is_the_reference_in_and_out_of_lanes<3>();
    // Steps that stretch by half, which a trial far out of the yield surface makes.
    is_the_reference<3, double>([](int) { return motion_of::uniaxial(0.3, 4); });
}

TEST_CASE("j2: a turning observer sees the stress turn, and nothing else") {
    for (const auto& motion :
         {motion_of::uniaxial(0.002, 60), motion_of::shear(0.005, 80), motion_of::there_and_back(0.002, 30)}) {
        const double angle = 0.11;
        const auto still = moved<3>(motion), turning = moved<3>(motion_of::turned(motion, angle));
        double worst = 0;
        for (std::size_t n = 0; n < still.size(); ++n) {
            const tensor3 R = motion_of::turn(angle * static_cast<double>(n + 1));
            const tensor3 expected = R * still[n].full * R.transpose();
            worst = std::max(worst, (turning[n].full - expected).norm() / expected.norm());
            worst = std::max(worst, std::abs(turning[n].alpha - still[n].alpha));
        }
        CHECK(worst < 1e-10);
        CHECK(still.back().alpha > 0.01);
    }
}

TEST_CASE("j2: plane and uniaxial strain are three dimensions with the others held") {
    const auto cycle = motion_of::there_and_back(0.002, 30), stretch = motion_of::uniaxial(0.002, 60);
    const auto thin = moved<2>(cycle);
    const auto thick = moved<3>(cycle);
    CHECK((thin.back().full - thick.back().full).norm() == 0);
    CHECK(std::abs(thin.back().full(2, 2)) > 1);
    CHECK((thin.back().tau - thick.back().full.topLeftCorner(2, 2)).norm() == 0);
    const auto bar = moved<1>(stretch);
    const auto block = moved<3>(stretch);
    CHECK((bar.back().full - block.back().full).norm() == 0);
    CHECK(std::abs(bar.back().tau(0, 0) - block.back().tau(0, 0)) == 0);
}

TEST_CASE("j2: what yields dissipates, stays on the yield surface and keeps its elastic part's volume") {
    for (const auto& motion :
         {motion_of::there_and_back(0.002, 60), motion_of::twisted(0.004, 200), motion_of::shear(0.01, 300)}) {
        const auto ours = moved<3>(motion);
        auto reference = reference_of(steel);
        double least = 1, before = 0, furthest = 0, volume = 0, work = 0, dissipated = 0;
        for (std::size_t n = 0; n < motion.size(); ++n) {
            reference.step(motion[n]);
            const moved_state& is = ours[n];
            const double mises = std::sqrt(1.5) * j2_reference::dev(is.full).norm(),
                         limit = steel.yield + 15 * is.alpha;
            // Of the trial's energy, what b has not kept, and the same by stress and plastic strain.
            const double stored = mu / 2 * (is.b.trace() - 3) + kappa / 2 * ((is.J * is.J - 1) / 2 - std::log(is.J));
            CHECK(std::abs(stored - is.energy) < 1e-13 * young);
            least = std::min({least, is.alpha - before, reference.dissipated + 1e-15});
            furthest = std::max(furthest, is.alpha > before ? std::abs(mises - limit) : mises - limit);
            volume = std::max(volume, std::abs(is.b.determinant() - 1));
            work += mises * (is.alpha - before);
            dissipated += reference.dissipated;
            before = is.alpha;
        }
        CHECK(least >= 0);
        CHECK(furthest < 1e-10 * steel.yield);
        CHECK(volume < 1e-12);
        CHECK(std::abs(work / dissipated - 1) < 0.1);
        CHECK(dissipated > 0.05);
    }
}

TEST_CASE("j2: without yielding it is neo_hookean's split form, and Hooke's law where strain is small") {
    j2 strong = steel;
    strong.yield = 1e5;
    const neo_hookean_of<volumetric::split> elastic{.young = young, .poisson = poisson, .density = 1};
    const auto motion = motion_of::twisted(0.02, 20);
    matrix<3, double> F = matrix<3, double>::Identity();
    for (const auto& f : motion) F = f * F;
    const auto ours = moved<3>(motion, strong);
    CHECK((ours.back().full - elastic.at_deformation(F)).norm() < 1e-11 * young);
    CHECK(std::abs(ours.back().energy - elastic.energy_at(F)) < 1e-12 * young);
    CHECK(ours.back().alpha == 0);

    const linear_elastic linear{.young = young, .poisson = poisson, .density = 1};
    const auto distance = [&](double size) {
        const auto small = motion_of::twisted(size, 1);
        const matrix<3, double> H = small[0] - tensor3::Identity(), strain = (H + H.transpose()) / 2;
        return (moved<3>(small).back().full - linear.at_strain(0, strain)).norm();
    };
    CHECK(distance(1e-3) < 1e-3 * young * 0.01);
    CHECK(std::abs(distance(1e-3) / distance(5e-4) - 4) < 0.1);
}

TEST_CASE("j2: float is near") {
    const auto motion = motion_of::there_and_back(0.002, 30);
    CHECK((moved<2, float>(motion).back().full - moved<2>(motion).back().full).norm() < 1e-4 * young);
    CHECK((moved<3, native_lanes::type<float>>(motion).back().full - moved<3>(motion).back().full).norm() <
          1e-4 * young);
}

TEST_CASE("j2: turned inside out, the stress is no number") {
    CHECK(std::isnan(moved<3>(motion_of::uniaxial(-1.5, 1)).back().full.sum()));
    CHECK(std::isnan(moved<1>(motion_of::uniaxial(-1.5, 2)).back().tau.sum()));
}

TEST_CASE("j2: parameters and particles that make no sense are refused by name") {
    const auto refusal = [](double yield, double hardening) {
        return complaint([&] { j2{.young = 1, .density = 1, .yield = yield, .hardening = hardening}.check(); });
    };
    CHECK(refusal(1, 0) == "nothing");
    CHECK(names(refusal(0, 0), "j2", "yield stress is 0", "positive"));
    CHECK(names(refusal(1, -2), "j2", "hardening modulus is -2", "give 0 or a positive number", "softens"));
    CHECK(names(complaint([] { j2{.young = -1, .density = 1, .yield = 1}.check(); }), "j2", "Young's modulus is -1"));
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.25}};
    auto body = mpm.make_body(steel, everywhere, per_cell{1});
    mpm.step(bodies(body), 1e-3);
    CHECK(elastic_energy(body) == 0);
    for (auto p : body) p[J] = -1;
    CHECK(names(complaint([&] { mpm.step(bodies(body), 1e-3); }), "its volume ratio is -1", "positive"));
    for (auto p : body) {
        p[J] = 1;
        p[be] = tensor3::Zero();
    }
    CHECK(names(complaint([&] { mpm.step(bodies(body), 1e-3); }), "trace 0", "determinant 1"));
}
