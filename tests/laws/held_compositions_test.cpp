#include "laws/balance.hpp"
#include "laws/patch.hpp"

using namespace laws;

namespace {

template <class Law> void each_1d(Law law) {
    law(composed{linear{}, flip{}, usl_minus{}, held{}});
    law(composed{linear{}, fmpm<2>{}, usavg_plus{}, held{}});
    law(composed{cubic_spline{}, fmpm<dynamic>{3}, usl_plus{}, held{}});
    law(composed{quadratic_spline{}, blend{0.5}, euler{}, held{}});
}
template <class Law> void each_2d(Law law) {
    law(composed{quadratic_spline{}, flip{}, usl_plus{}, held{}});
    // By sweeps, and by the assembled matrix.
    law(composed{cubic_spline{}, fmpm<dynamic>{2}, usavg_minus{}, held{}});
    law(composed{cubic_spline{}, fmpm<dynamic>{3}, usavg_minus{}, held{}});
    law(composed{cubic_spline{}, modified_flip{0.5}, usf{}, held{}});
}
template <class Law> void each_3d(Law law) {
    law(composed{linear{}, flip{}, usf{}, held{}});
    law(composed{quadratic_spline{}, fmpm<3>{}, usl_minus{}, held{}});
    law(composed{cubic_spline{}, xpic<2>{}, usavg_plus{}, held{}});
}

}  // namespace

TEST_CASE("held: mass stays, momentum changes by reactions and gravity") {
    each_1d([](const auto& c) { balance<1>(c); });
    each_2d([](const auto& c) { balance<2>(c); });
    each_3d([](const auto& c) { balance<3>(c); });
}
TEST_CASE("held: a linear velocity field strains evenly, step after step") {
    for (const int steps : {1, 20}) {
        each_1d([=](const auto& c) { patch<1>(c, steps); });
        each_2d([=](const auto& c) { patch<2>(c, steps); });
        each_3d([=](const auto& c) { patch<3>(c, steps); });
    }
}
