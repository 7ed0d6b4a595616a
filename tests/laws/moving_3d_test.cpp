#include "laws/balance.hpp"
#include "laws/fall.hpp"
#include "laws/flight.hpp"
#include "laws/patch.hpp"
#include "laws/sameness.hpp"

using namespace laws;

namespace {

template <class Law> void each(Law law) {
    law(composed{quadratic_spline{}, flip{}, usl_minus{}});
    law(composed{linear{}, fmpm<3>{}, usl_plus{}});
    law(composed{cubic_spline{}, xpic<3>{}, usf{}});
    law(composed{quadratic_spline{}, fmpm<dynamic>{3}, usavg_minus{}});
    law(composed{linear{}, graphics_blend{0.9}, usl_minus{}});
    law(composed{quadratic_spline{}, pic{}, usavg_plus{}});
}

}  // namespace

TEST_CASE("3D, moving: mass stays, momentum changes by reactions and gravity") {
    each([](const auto& c) { balance<3>(c); });
}
TEST_CASE("3D, moving: free flight over many cells") {
    each([](const auto& c) { flight<3>(c); });
}
TEST_CASE("3D, moving: free fall") {
    each([](const auto& c) { fall<3>(c); });
}
TEST_CASE("3D, moving: a linear velocity field strains evenly") {
    each([](const auto& c) { patch<3>(c, 1); });
}
TEST_CASE("3D, moving: simple shear") {
    each([](const auto& c) { shear<3>(c); });
}
TEST_CASE("3D, moving: a run can be taken up by another solver") {
    each([](const auto& c) { taken_up<3>(c); });
}
TEST_CASE("3D, moving: the order of the particles does not matter") {
    each([](const auto& c) { any_order<3>(c); });
}
