#include <tamis/tamis.hpp>

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "unit/complaint.hpp"

using namespace tamis;
using namespace tamis::symbols;

namespace {

using place = point<2, double>;
const linear_elastic law{.young = 1e-3, .poisson = 0, .density = 1};
const uniform_grid<2, double> box{{0., 0.}, {2., 1.}, 0.25};

/// Gives a stress that is not a number.
struct broken {
    double density = 1;
    double wave_speed() const { return 1; }
    template <class Tensor> Tensor stress(auto, const Tensor& L, auto) const {
        return L * typename Tensor::Scalar(std::numeric_limits<double>::quiet_NaN());
    }
};

/// A block that flies to the right; its stress is nothing beside its motion.
template <class Shape, class Leaving> struct flight {
    solver<uniform_grid<2, double>, Shape, Leaving> mpm{box, Shape{}, Leaving{}};
    typename decltype(mpm)::template body_for<linear_elastic> block = mpm.make_body(
        law, [](const auto& at) { return at[0] > 1 && at[0] < 1.5; }, per_cell{2});
    explicit flight(double speed = 1) {
        for (auto p : block) p[v][0] = speed;
    }
    void steps(int n, double dt = 0.0625) {
        for (int k = 0; k < n; ++k) mpm.step(bodies(block), dt);
    }
    std::size_t seen() const {
        std::size_t n = 0;
        for (const auto p : block) n += p[m] > 0 ? 1 : 0;
        return n;
    }
};

}  // namespace

TEST_CASE("leaving: by default the run stops, and says which particle, when, where to, and why") {
    flight<quadratic_spline, leaving_stops> run;
    const std::string text = complaint([&] { run.steps(20); });
    CAPTURE(text);
    CHECK(names(text, "particle ", "step 10, t = 0.625", "left the grid, to (2.0", "velocity (",
                "no condition keeps the body", "leaving_clamps"));

    // All particles are there to be looked at.
    CHECK(run.seen() == run.block.size());
    CHECK(run.mpm.steps() == 10);

    flight<quadratic_spline, leaving_stops> fast(20);
    const std::string warning = complaint([&] { fast.steps(1); });
    CAPTURE(warning);
    CHECK(names(warning, "particle ", "step 1, t = 0.0625", "left the grid", "stability limit", "half a cell"));
}

TEST_CASE("leaving: a particle that is not a number stops the run, whatever the policy") {
    const auto says = [](auto leaving, auto checks) {
        solver mpm{box, quadratic_spline{}, leaving, checks};
        auto block = mpm.make_body(broken{}, everywhere, per_cell{1});
        return complaint([&] {
            for (int k = 0; k < 3; ++k) mpm.step(bodies(block), 0.25);
        });
    };
    for (const std::string& text : {says(leaving_stops{}, unchecked{}), says(leaving_removes{}, unchecked{})}) {
        CAPTURE(text);
        CHECK(names(text, "particle ", "step 2, t = 0.5", "place is not a number", "dt = 0.25", "or a law"));
    }
    CHECK(names(says(leaving_stops{}, checked{}), "particle 0 at", "step 1, t = 0.25", "stress is not a number"));
}

TEST_CASE("leaving: a particle may be put back on the wall, with its velocity") {
    const auto check = [](auto shape) {
        flight<decltype(shape), leaving_clamps> run;
        const std::size_t size = run.block.size();
        run.steps(40);
        CHECK(run.block.size() == size);
        CHECK(run.seen() == size);
        for (const auto p : std::as_const(run.block)) {
            CHECK(p[x][0] <= 2);
            CHECK(p[x][0] > 1.999);
            CHECK(std::abs(p[v][0] - 1) < 0.05);
        }
    };
    check(linear{});
    check(quadratic_spline{});
}

TEST_CASE("leaving: a particle is put back on the wall that it left by") {
    // Along each axis, to either side; one particle, which nothing stops.
    for (const int axis : {0, 1})
        for (const double speed : {-3., 3.}) {
            CAPTURE(axis, speed);
            solver mpm{box, linear{}, leaving_clamps{}};
            auto one = mpm.make_body_at(law, {place(1.1, 0.6)}, 0.01);
            for (auto p : one) p[v][axis] = speed;
            for (int k = 0; k < 10; ++k) mpm.step(bodies(one), 0.0625);
            const place at = (*std::as_const(one).begin())[x];
            CHECK(at[axis] == (speed < 0 ? box.lower() : box.upper())[axis]);
            CHECK(std::abs(at[1 - axis] - place(1.1, 0.6)[1 - axis]) < 1e-12);
        }
}

TEST_CASE("leaving: a particle may be removed, with its mass") {
    flight<quadratic_spline, leaving_removes> run;
    const std::size_t size = run.block.size();
    run.steps(9);
    CHECK(run.block.size() == size);
    std::size_t before = size;
    for (int k = 0; k < 30; ++k) {
        run.steps(1);
        CHECK(run.block.size() <= before);
        CHECK(run.seen() == run.block.size());
        for (const auto p : std::as_const(run.block)) CHECK(p[x][0] <= 2);
        before = run.block.size();
    }
    CHECK(run.block.size() == 0);
    run.steps(1);
}
