// What the laws of soils and grains have in common: constants that are refused, and what has come apart.
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"
#include "unit/complaint.hpp"
#include "unit/material/moved.hpp"

using namespace tamis;
using namespace motion_of;

namespace {

constexpr double young = 100, poisson = 0.25, dt = 0.125;
template <class Law> constexpr Law sand{.young = young, .poisson = poisson, .density = 1, .friction = 30};
template <class Law> constexpr Law soil{
    .young = young, .poisson = poisson, .density = 1, .friction = 25, .cohesion = 0.4, .dilatancy = 10, .tension = 0.3};

}  // namespace

TEMPLATE_TEST_CASE("grains: what has come apart bears nothing until it has closed again", "", drucker_prager,
                   mohr_coulomb) {
    const auto path = joined(stretched(0.01, 0.01, 0.01, 10), stretched(-0.01, -0.01, -0.01, 14));
    const auto all = moved(sand<TestType>, dt, path);
    double volume = 0;
    for (std::size_t n = 0; n < path.size(); ++n) {
        volume += std::log(path[n].determinant());
        CAPTURE(n);
        if (volume > 0) {
            CHECK(all[n].full.norm() < 1e-13 * young);
            CHECK(std::abs(all[n].opening - volume) < 1e-13);
        } else
            CHECK(std::abs(all[n].full.trace() / 3 - young / (3 * (1 - 2 * poisson)) * volume) < 1e-12 * young);
    }
    CHECK(volume < -0.03);
    // A soil bears its tension, and no more.
    const auto pulled = moved(soil<TestType>, dt, stretched(0.01, 0.01, 0.01, 10)).back();
    CHECK(std::abs(pulled.full.trace() / 3 - soil<TestType>.tension) < 1e-12);
}

TEMPLATE_TEST_CASE("grains: constants and particles without sense are refused, by name", "", drucker_prager,
                   mohr_coulomb) {
    const auto refused = [](auto change, const char* word) {
        TestType law = sand<TestType>;
        change(law);
        CHECK(names(complaint([&] { law.check(); }), std::string(TestType::name).c_str(), word));
    };
    CHECK_NOTHROW(soil<TestType>.check());
    refused([](auto& law) { law.friction = 90; }, "angle of friction");
    refused([](auto& law) { law.friction = -1; }, "angle of friction");
    refused([](auto& law) { law.cohesion = -1; }, "cohesion");
    refused([](auto& law) { law.friction = 0; }, "both 0");
    refused([](auto& law) { law.dilatancy = 31; }, "dilatancy");
    refused([](auto& law) { law.tension = -1; }, "tension");
    refused([](auto& law) { law.young = 0; }, "Young");
    TestType clay = sand<TestType>;
    clay.friction = 0;
    clay.cohesion = 0.5;
    CHECK_NOTHROW(clay.check());
    // A particle without elastic strain, too.
    using S = space<3, double>;
    auto slot = fresh<S>(soil<TestType>);
    const auto at = unit_frame<S>();
    const detail::slot_row<S, decltype(slot), on_particles_t<TestType>> p{slot, at};
    CHECK_NOTHROW(soil<TestType>.check(p));
    CHECK(p[field::elastic_cauchy_green{}].trace() == 3);
    slot.set_zero();
    CHECK(names(complaint([&] { soil<TestType>.check(p); }), "trace 0", "positive tensor"));
}
