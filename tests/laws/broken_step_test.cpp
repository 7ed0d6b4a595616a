// A step that a law, a load or a condition breaks off: every particle is in the cell where it is, in whatever pass, and
// the solver can be used on.
#include <tamis/tamis.hpp>

#include "catch.hpp"

#include <atomic>
#include <cmath>
#include <set>
#include <stdexcept>

using namespace tamis;
using namespace tamis::symbols;

namespace {

/// Throws at its call of some number. Counted by all threads.
struct fuse {
    static inline std::atomic<long> left{-1};
    static void burn() {
        if (left.load() >= 0 && left.fetch_sub(1) == 0) throw std::runtime_error("the fuse");
    }
};
struct moody : linear_elastic {
    template <class Tensor> Tensor stress(auto p, const Tensor& L, auto dt) const {
        fuse::burn();
        return linear_elastic::stress(p, L, dt);
    }
};
const moody law{{.young = 1e-6, .density = 1}};

struct moody_load {
    auto acceleration(const auto& at, const auto&, double) const {
        fuse::burn();
        return (at * 0).eval();
    }
};

/// What is found by looking, and whether each particle is in the cell that its place says.
template <class Body> void check_all_there(const Body& body, std::size_t count, double mass) {
    std::size_t seen = 0;
    std::set<double> ids;
    double sum = 0;
    for (const auto p : std::as_const(body)) {
        ++seen;
        sum += p[m];
        ids.insert(p[field::id{}]);
        const auto& store = body.store();
        const auto* slot = store.lane_of(p.slot(), p.lane_index());
        using slot_type = typename std::remove_cvref_t<decltype(store)>::slot;
        for (int d = 0; d < Body::dim; ++d) {
            const double local = slot[(slot_type::template first<field::position>() + d) * Body::space_type::width];
            CHECK(local >= 0);
            CHECK(local <= 1);
        }
    }
    CHECK(body.size() == count);
    CHECK(seen == count);
    CHECK(ids.size() == count);
    CHECK(std::abs(sum - mass) < 1e-12 * mass);
}

/// Steps of 0.3 cells; one of them is broken off at every call in turn.
template <int D, class... Policies> void check_broken(long stride, const Policies&... policies) {
    using grid_type = uniform_grid<D, double>;
    const auto grid = [] {
        if constexpr (D == 1)
            return grid_type({0.}, {10.}, 0.1);
        else
            return grid_type({0., 0.}, {4., 2.}, 0.1);
    }();
    for (long call = 0;; call += stride) {
        solver mpm{grid, policies...};
        auto body = mpm.make_body(
            law, [](const auto& at) { return at[0] > 0.5 && at[0] < 3; }, per_cell{2}, fields<field::id>{});
        for (auto p : body) p[v][0] = 1;
        const std::size_t count = body.size();
        const double mass = total_mass(body);
        mpm.step(bodies(body), 0.03);
        mpm.step(bodies(body), 0.03);  // letters are under way
        fuse::left = call;
        bool thrown = false;
        try {
            mpm.step(bodies(body), 0.03);
        } catch (const std::runtime_error& e) {
            CHECK(std::string(e.what()) == "the fuse");
            thrown = true;
        }
        fuse::left = -1;
        CAPTURE(call);
        CHECK(mpm.steps() == (thrown ? 2 : 3));
        check_all_there(body, count, mass);
        mpm.step(bodies(body), 0.03);
        check_all_there(body, count, mass);
        CHECK(std::abs(total_momentum(body)[0] - mass) < 1e-6 * mass);
        if (!thrown) break;
    }
}

}  // namespace

TEST_CASE("a law that throws in mid-step leaves every particle where it can be found") {
    check_broken<1>(5, linear{});
    check_broken<1>(5, linear{}, usl_plus{});
    check_broken<1>(7, quadratic_spline{}, fmpm<2>{}, usavg_plus{});
    check_broken<2>(67, linear{}, flip{});
    check_broken<2>(67, quadratic_spline{}, usf{}, one_lane{});
}

TEST_CASE("so does a load that throws") { check_broken<1>(9, linear{}, moody_load{}); }

#if defined(_OPENMP)
TEST_CASE("what a law or a load throws in any thread reaches the caller") {
    check_broken<2>(97, linear{}, threads{2});
    check_broken<2>(97, quadratic_spline{}, fmpm<2>{}, moody_load{}, threads{2});
}
#endif

TEST_CASE("a large body whose passes run together is whole after a law threw") {
    // More than four megabytes of particles.
    solver mpm{uniform_grid{{0., 0.}, {12., 12.}, 0.05}, quadratic_spline{}, fmpm<2>{}
#if defined(_OPENMP)
               ,
               threads{2}
#endif
    };
    auto body = mpm.make_body(
        law, [](const auto& at) { return at[0] > 0.5 && at[0] < 10; }, per_cell{2}, fields<field::id>{});
    for (auto p : body) p[v][0] = 1;
    const std::size_t count = body.size();
    const double mass = total_mass(body);
    mpm.step(bodies(body), 0.015);
    mpm.step(bodies(body), 0.015);
    REQUIRE(mpm.steps_in_waves() == 2);
    for (const long call : {100L, 20000L}) {
        fuse::left = call;
        REQUIRE_THROWS_AS(mpm.step(bodies(body), 0.015), std::runtime_error);
        fuse::left = -1;
        check_all_there(body, count, mass);
        mpm.step(bodies(body), 0.015);
        CHECK(std::abs(total_momentum(body)[0] - mass) < 1e-6 * mass);
    }
}

TEST_CASE("a condition that throws is asked anew") {
    static bool moody_wall = false;
    const auto wall = prescribed{[](const auto& at) { return at[0] <= 0; },
                                 [](const auto& at, double t) {
                                     if (moody_wall && at[1] > 0.5) throw std::runtime_error("the wall");
                                     return point<2, double>(t, 0);
                                 }};
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, linear{}, wall};
    auto body = mpm.make_body(
        law, [](const auto& at) { return at[0] < 0.5; }, per_cell{2});
    mpm.step(bodies(body), 0.01);
    moody_wall = true;
    for (int k = 0; k < 2; ++k) REQUIRE_THROWS_AS(mpm.step(bodies(body), 0.01), std::runtime_error);
    moody_wall = false;
    mpm.step(bodies(body), 0.01);
    for (const auto& node : mpm.reactions())
        if (node.at[0] <= 0) CHECK(node.velocity[0] == 0.02);
}

TEST_CASE("an observer that throws leaves a run that can be gone on with") {
    solver mpm{uniform_grid{{0.}, {1.}, 0.1}, linear{}};
    auto body = mpm.make_body(law, everywhere, per_cell{2});
    const auto moody_observer = [](double t) {
        if (t > 0.045) throw std::runtime_error("the observer");
    };
    REQUIRE_THROWS_AS(integrate(mpm, bodies(body), {0, 0.1}, fixed_steps{10}, moody_observer), std::runtime_error);
    CHECK(mpm.steps() == 5);
    integrate(mpm, bodies(body), {mpm.time(), 0.1}, fixed_steps{5});
    CHECK(mpm.steps() == 10);
}
