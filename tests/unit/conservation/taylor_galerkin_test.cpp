#include <tamis/conservation/integrate.hpp>

#include <cmath>
#include <functional>
#include <numbers>

#include "catch.hpp"

using namespace tamis;
using std::numbers::pi;

namespace {

const uniform_grid<1> ring = uniform_grid<1>{{0.}, {1.}, 1. / 16}.wrapped(0);

}  // namespace

TEST_CASE("Taylor-Galerkin: a run that begins anew counts from there, and one that goes on goes on") {
    const conservation::ends open{conservation::inflow{[](double) { return 1.; }}, conservation::outflow{}};
    taylor_galerkin scheme{
        uniform_grid{{0.}, {1.}, 0.1}, conservation::advection<>{{1.}}, per_cell{2}, linear{}, lumped_mass{}, open};
    scheme.start_at(3);
    CHECK(scheme.time() == 3);
    scheme.set([](const auto&) { return 0.; });
    CHECK(scheme.time() == 3);
    scheme.step(0.01);
    CHECK(scheme.time() == 3.01);
    double before = scheme.total()[0];
    const auto gained = [&] { return std::abs(scheme.total()[0] - before - scheme.gain()[0]) < 1e-14; };
    integrate(scheme, interval{0, 0.1}, fixed_steps{10});
    CHECK(scheme.steps() == 10);
    CHECK(scheme.time() == 0.1);
    CHECK(scheme.gain()[0] > 0.05);
    CHECK(gained());
    integrate(scheme, interval{0.1, 0.2}, fixed_steps{10});
    CHECK(scheme.steps() == 20);
    CHECK(gained());
    before = scheme.total()[0];
    integrate(scheme, interval{0, 0.1}, fixed_steps{10});
    CHECK(scheme.steps() == 10);
    CHECK(scheme.time() == 0.1);
    CHECK(gained());
    // A run that has not begun has nothing to go on with.
    taylor_galerkin fresh{ring, conservation::advection<>{{1.}}, per_cell{2}};
    fresh.start_at(0);
    CHECK(fresh.steps() == 0);
}

TEST_CASE("Taylor-Galerkin: observers given by value are committed after the run") {
    taylor_galerkin scheme{ring, conservation::advection<>{{1.}}, per_cell{2}};
    scheme.set([](const auto& at) { return std::sin(2 * pi * at[0]); });
    struct file {
        int* committed;
        void operator()(double) {}
        void commit() { ++*committed; }
    };
    int committed = 0;
    file kept{&committed};
    integrate(scheme, interval{0, 0.1}, courant{0.5}, every(2, file{&committed}), kept);
    CHECK(committed == 1);
    integrate(scheme, interval{0.1, 0.2}, fixed_steps{10}, file{&committed}, every(2, std::ref(kept)));
    CHECK(committed == 2);
}

TEST_CASE("Taylor-Galerkin: the fastest wave counts whichever way it runs") {
    CHECK(conservation::advection<2>{{1., -3.}}.wave_speed() == 3);
    taylor_galerkin scheme{ring, conservation::advection<>{{-1.}}, per_cell{2}};
    scheme.set([](const auto& at) { return std::sin(2 * pi * at[0]); });
    CHECK(scheme.wave_speed() == 1);
    CHECK(integrate(scheme, interval{0, 1}, courant{0.5}) == 32);
    CHECK(std::abs(scheme.on_node({4, 0, 0})[0] - 1) < 0.1);
}
