// The exact answers obey the equations of the bar, v_t = e_x and e_t = v_x (E = rho = 1), their conditions at the ends,
// and their energies are what they say: checked by differences and sums.
#include "exact.hpp"

#include <algorithm>

#include "catch.hpp"

namespace {

/// Largest residual of the equations over the bar and the time, at points where `smooth(x, t)`.
double residual(const auto& answer, double last, const auto& smooth) {
    const double d = 1e-5;
    double most = 0;
    for (double x = 0.013; x < 1; x += 0.0371)
        for (double t = 0.017; t < last; t += 0.0437) {
            if (!smooth(x, t)) continue;
            const auto along = [&](double dx, double dt) { return answer(x + dx, t + dt); };
            const double v_t = (along(0, d).velocity - along(0, -d).velocity) / (2 * d);
            const double v_x = (along(d, 0).velocity - along(-d, 0).velocity) / (2 * d);
            const double e_t = (along(0, d).strain - along(0, -d).strain) / (2 * d);
            const double e_x = (along(d, 0).strain - along(-d, 0).strain) / (2 * d);
            most = std::max({most, std::abs(v_t - e_x), std::abs(e_t - v_x)});
        }
    return most;
}
/// Energy of the bar by the midpoint rule.
double energy(const auto& answer, double t) {
    const int n = 20000;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
        const auto s = answer((k + 0.5) / n, t);
        sum += (s.velocity * s.velocity + s.strain * s.strain) / 2 / n;
    }
    return sum;
}

}  // namespace

TEST_CASE("standing wave") {
    for (const int n : {1, 3}) {
        const exact::standing_wave wave{0.01, n};
        CHECK(residual(wave, 2.5, [](double, double) { return true; }) < 1e-8);
        for (double t = 0; t < 2; t += 0.1) {
            CHECK(std::abs(wave(0, t).velocity) < 1e-16);
            CHECK(std::abs(wave(1, t).velocity) < 1e-16);
            CHECK(std::abs(energy(wave, t) - wave.energy(t)) < 1e-12);
        }
    }
    CHECK(exact::standing_wave{0.01}(0.5, 0).velocity == 0.01);
    CHECK(exact::standing_wave{0.01}(0.3, 0).strain == 0);
}

TEST_CASE("reflection, with the images after the wave's return") {
    const exact::reflection wave{0.01, 10};
    // Waves have a kink at their front.
    const auto smooth = [](double x, double t) {
        for (double sent = 0; sent < t; sent += 2)
            for (const double late : {sent + 1 - x, sent + 1 + x})
                if (std::abs(t - late) < 1e-3) return false;
        return true;
    };
    CHECK(residual(wave, 7, smooth) < 1e-7);
    for (double t = 0; t < 7; t += 0.1) {
        CHECK(std::abs(wave(0, t).velocity) < 1e-15);
        CHECK(std::abs(wave(1, t).velocity - 0.01 * std::sin(10 * t)) < 1e-15);
        CHECK(std::abs(energy(wave, t) - wave.energy(t)) < 1e-7 * (1 + wave.energy(t)));
    }
    for (double x = 0; x <= 1; x += 0.1) CHECK((wave(x, 0).velocity == 0 && wave(x, 0).strain == 0));
    CHECK(std::abs(wave.energy(1.3) - 1e-4 * (1.3 / 2 - std::sin(26.0) / 40)) < 1e-18);
}

TEST_CASE("shock") {
    const exact::shock shock{-0.001};
    CHECK(shock(0.49, 0).strain == -0.001);
    CHECK(shock(0.51, 0).strain == 0);
    for (const double t : {0.1, 0.3, 0.45}) {
        CHECK(std::abs(energy(shock, t) - shock.energy(t)) < 1e-10);
        // Jumps obey [v] = -s [e] and [e] = -s [v] at fronts of speed s = -1 and 1.
        const auto jump = [&](double at, double s) {
            const auto behind = shock(at - 1e-6, t), ahead = shock(at + 1e-6, t);
            CHECK(std::abs((ahead.velocity - behind.velocity) + s * (ahead.strain - behind.strain)) < 1e-18);
            CHECK(std::abs(ahead.strain - behind.strain - 0.0005) < 1e-15);
        };
        jump(0.5 - t, -1);
        jump(0.5 + t, 1);
    }
}
