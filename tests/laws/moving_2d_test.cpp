#include "laws/balance.hpp"
#include "laws/fall.hpp"
#include "laws/flight.hpp"
#include "laws/patch.hpp"
#include "laws/sameness.hpp"

using namespace laws;

namespace {

template <class Law> void each(Law law) {
    law(composed{quadratic_spline{}, flip{}, usl_minus{}});
    law(composed{linear{}, pic{}, usl_plus{}});
    law(composed{cubic_spline{}, fmpm<3>{}, usf{}});
    law(composed{quadratic_spline{}, xpic<3>{}, usavg_minus{}});
    law(composed{cubic_spline{}, blend{0.9}, usl_minus{}});
    law(composed{quadratic_spline{}, fmpm<dynamic>{4}, usl_plus{}});
    law(composed{quadratic_spline{}, modified_flip{0.5}, usavg_plus{}});
    law(composed{linear{}, fmpm<1>{}, usl_minus{}});
    law(composed{linear{}, fmpm<dynamic>{3}, usavg_minus{}});
}

}  // namespace

TEST_CASE("2D, moving: mass stays, momentum changes by reactions and gravity") {
    each([](const auto& c) { balance<2>(c); });
}
TEST_CASE("2D, moving: free flight over many cells") {
    each([](const auto& c) { flight<2>(c); });
}
TEST_CASE("2D, moving: free fall") {
    each([](const auto& c) { fall<2>(c); });
}
TEST_CASE("2D, moving: a linear velocity field strains evenly") {
    each([](const auto& c) { patch<2>(c, 1); });
}
TEST_CASE("2D, moving: simple shear") {
    each([](const auto& c) { shear<2>(c); });
}
TEST_CASE("2D, moving: a run can be taken up by another solver") {
    each([](const auto& c) { taken_up<2>(c); });
}
TEST_CASE("2D, moving: the order of the particles does not matter") {
    each([](const auto& c) { any_order<2>(c); });
}
