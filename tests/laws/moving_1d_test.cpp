#include "laws/balance.hpp"
#include "laws/fall.hpp"
#include "laws/flight.hpp"
#include "laws/patch.hpp"
#include "laws/sameness.hpp"

using namespace laws;

namespace {

template <class Law> void each(Law law) {
    law(composed{linear{}, flip{}, usf{}});
    law(composed{quadratic_spline{}, flip{}, usl_minus{}});
    law(composed{cubic_spline{}, flip{}, usl_plus{}});
    law(composed{quadratic_spline{}, modified_flip{1}, usavg_minus{}});
    law(composed{linear{}, blend{0.9}, usavg_plus{}});
    law(composed{quadratic_spline{}, graphics_blend{0.5}, usl_minus{}});
    law(composed{linear{}, fmpm<3>{}, usl_plus{}});
    law(composed{quadratic_spline{}, fmpm<dynamic>{4}, usavg_plus{}});
    law(composed{cubic_spline{}, xpic<dynamic>{2}, usavg_plus{}});
    law(composed{quadratic_spline{}, fmpm<2>{}, euler{}});
}

}  // namespace

TEST_CASE("1D, moving: mass stays, momentum changes by reactions and gravity") {
    each([](const auto& c) { balance<1>(c); });
}
TEST_CASE("1D, moving: free flight over many cells") {
    each([](const auto& c) { flight<1>(c); });
}
TEST_CASE("1D, moving: free fall") {
    each([](const auto& c) { fall<1>(c); });
    fall<1>(composed{linear{}, pic{}, usl_minus{}});
    for (const double part : {0., 0.5, 1.}) {
        fall<1>(composed{quadratic_spline{}, modified_flip{part}, usavg_minus{}});
        fall<1>(composed{linear{}, blend{part}, usavg_plus{}});
    }
    for (int k = 1; k <= 8; ++k) {
        fall<1>(composed{quadratic_spline{}, fmpm<dynamic>{k}, usavg_plus{}});
        fall<1>(composed{cubic_spline{}, xpic<dynamic>{k}, usavg_plus{}});
    }
}
TEST_CASE("1D, moving: a linear velocity field strains evenly") {
    each([](const auto& c) { patch<1>(c, 1); });
}
TEST_CASE("1D, moving: a run can be taken up by another solver") {
    each([](const auto& c) {
        // Explicit Euler looks at walls as they were a step ago, which the other solver does not know.
        if constexpr (!decltype(c.order)::explicit_euler) taken_up<1>(c);
    });
}
TEST_CASE("1D, moving: the order of the particles does not matter") {
    each([](const auto& c) { any_order<1>(c); });
}
