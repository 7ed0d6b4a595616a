#include <tamis/mass/periodic.hpp>
#include <tamis/update/update.hpp>

#include "catch.hpp"

using namespace tamis;

namespace {

using vector = point<2, double>;
const vector V(1, -2), S_v(0.5, 3), S_a(4, -1), S_v0(0.25, 2), S_vx(-3, 0.5);
constexpr double dt = 0.1;

/// A particle, and what is summed to it.
struct own {
    const vector& operator[](field::velocity) const { return V; }
};
struct near_it {
    const vector& sum(field::velocity) const { return S_v; }
    const vector& sum(field::acceleration) const { return S_a; }
    const vector& sum(field::start_velocity) const { return S_v0; }
    const vector& sum(field::filtered_velocity) const { return S_vx; }
};

/// The formulas of docs/method.md, Particle updates: V', X' - X, and the share of the start.
template <class Update> void check(const Update& update, const vector& after, const vector& moved, double share) {
    const vector velocity = update.velocity(own{}, near_it{}, dt);
    CHECK((velocity - after).norm() < 1e-15);
    CHECK((vector(update.displacement(V, velocity, near_it{}, dt)) - moved).norm() < 1e-15);
    CHECK(update.start_share() == share);
}

}  // namespace

TEST_CASE("update: every update is its two formulas") {
    const vector flip_after = V + dt * S_a;
    check(set_velocity{}, S_v, dt * S_v, 1);
    check(set_velocity_move_by_mean{}, S_v, dt / 2 * (V + S_v), 1);
    check(add_acceleration{}, flip_after, dt * S_v, 0);
    for (const double psi : {0., 0.4, 1.})
        check(add_acceleration_modified{psi}, flip_after, dt * (S_v - psi * dt / 2 * S_a), 0);
    for (const double alpha : {0., 0.25, 1.}) {
        const vector after = alpha * flip_after + (1 - alpha) * S_v;
        check(blend_velocity{alpha}, after, dt * S_v, 1 - alpha);
        check(blend_velocity_graphics{{alpha}}, after, dt * after, 1 - alpha);
    }
    check(set_filtered_velocity{}, S_vx, dt * (S_v0 + (S_vx - V) / 2), 1);
    check(detail::periodic_update{true}, S_v, dt / 2 * (V + S_v), 1);
    check(detail::periodic_update{false}, flip_after, dt * S_v, 0);
}
