// The forces that touching() tells are what the bodies feel: their impulse is the change of a body's momentum.
#include <tamis/tamis.hpp>

#include <cmath>

#include "catch.hpp"

using namespace tamis;

namespace {

using place = point<2, double>;

template <class... Policy> void balances(const Policy&... policies) {
    solver mpm{uniform_grid{{0., 0.}, {1., 1.}, 0.1}, policies...};
    const auto box = [&](double from, double to) {
        return mpm.make_body(
            linear_elastic{.young = 1, .poisson = 0.3, .density = 1},
            [=](const auto& at) { return at[0] > from && at[0] < to && at[1] > 0.2 && at[1] < 0.8; }, per_cell{2});
    };
    auto one = box(0.2, 0.5), two = box(0.5, 0.8);
    set_velocity_of(one, [](const auto& at) { return place(0.05 + 0.02 * std::sin(9 * at[1]), 0.02); });
    set_velocity_of(two, [](const auto&) { return place(-0.05, -0.02); });
    const place before = total_momentum(one);
    place impulse = place::Zero();
    for (int k = 0; k < 40; ++k) {
        mpm.step(bodies(one, two), 0.02);
        for (const auto& node : mpm.touching()) impulse += 0.02 * node.force;
    }
    CHECK(impulse.norm() > 0.005);
    CHECK((total_momentum(one) - before - impulse).norm() < 1e-14);
}

}  // namespace

TEST_CASE("contact: its forces balance the momentum of each body") {
    const contact slides{coulomb{0.3}, given_normal{place(1, 0)}};
    balances(slides, flip{});
    balances(slides, flip{}, usf{});
    balances(slides, pic{});
    balances(slides, blend{0.5});
    balances(slides, fmpm<1>{});
    balances(slides, fmpm<4>{});
    balances(slides, fmpm<4>{}, usavg_plus{});
    balances(slides, xpic<3>{});
    balances(contact{coulomb{0.3}}, fmpm<2>{}, held{});
    balances(contact{bonded{}}, fmpm<3>{});
    balances(contact{coulomb{0.3}, given_normal{place(1, 0)}, by_approach{}, contact_method::velocity{}}, fmpm<4>{});
}
