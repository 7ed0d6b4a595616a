#include "two_bars_run.hpp"

#include "catch.hpp"

namespace {

void check(const two_bars& set, const two_bars_result& r, double within) {
    CAPTURE(set.young, set.density, set.cells, r.reflected, r.transmitted, r.energy_gain);
    CHECK(std::abs(r.reflected / set.reflected() - 1) < within);
    CHECK(std::abs(r.transmitted / set.transmitted() - 1) < within);
    CHECK(std::abs(r.energy_gain) < 0.01);
}

}  // namespace

TEST_CASE("bi-material: amplitudes are those of the impedances, for ratios of 1e-6 to 1e6") {
    using namespace tamis;
    for (const double ratio : {1e-6, 1e-4, 0.1, 10., 100., 1e4, 1e6}) {
        two_bars set;
        set.young = set.density = ratio;
        check(set, run_two_bars(set, linear{}, flip{}, usl_minus{}, held{}), 2e-4);
        check(set, run_two_bars(set, quadratic_spline{}, flip{}, usl_minus{}, moving{}), 3e-3);
        check(set, run_two_bars(set, quadratic_spline{}, fmpm<4>{}, usl_minus{}, moving{}), 3e-3);
    }
}

TEST_CASE("bi-material: bars of different wave speeds") {
    two_bars set;
    set.young = 200;
    set.density = 100;
    using namespace tamis;
    check(set, run_two_bars(set, quadratic_spline{}, flip{}, usl_minus{}, moving{}), 5e-3);
    set.young = 1;
    set.density = 4;
    check(set, run_two_bars(set, quadratic_spline{}, flip{}, usl_minus{}, moving{}), 5e-3);
}
