#include "stability_map.hpp"

#include <tamis/run/critical_courant.hpp>
#include <tamis/stability/critical.hpp>
#include <tamis/tamis.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace tamis;
using namespace tamis::symbols;

constexpr int cells = 6;
constexpr double margin = 4;

std::vector<point<1, double>> free_bar(int per_cell, double offset) {
    std::vector<point<1, double>> places;
    for (int p = 0; p < cells * per_cell; ++p)
        places.push_back(point<1, double>(margin + offset + (p + 0.5) / per_cell));
    return places;
}

/// A step of it, by the Courant number.
template <class... Policies>
stability::step_matrix<Eigen::MatrixXd> step_of_free_bar(int per_cell, double offset, const Policies&... policies) {
    using matrix = stability::step_matrix<Eigen::MatrixXd>;
    std::array<Eigen::MatrixXd, matrix::samples> at;
    for (int s = 0; s < matrix::samples; ++s)
        at[static_cast<std::size_t>(s)] =
            stability::responses<1>(free_bar(per_cell, offset), 1. / per_cell, cells + 8, 0, 0, cells * per_cell,
                                    matrix::sample(s), policies...);
    return matrix(at);
}

/// Does a rough start grow?
template <class... Policies> bool grows(const std::vector<point<1, double>>& places, int per_cell,
                                        double courant_number, const Policies&... policies) {
    solver mpm{uniform_grid{{0.}, {cells + 2 * margin}, 1.}, policies..., held{}, one_lane{}, unchecked{}};
    auto bar = mpm.make_body_at(linear_elastic{.young = 1, .poisson = 0, .density = 1}, places, 1. / per_cell);
    int number = 0;
    for (auto p : bar) p[v][0] = std::sin(1 + 2.3 * number * number), ++number;
    const auto energy = [&] { return kinetic_energy(bar) + elastic_energy(bar); };
    const double before = energy();
    for (int n = 0; n < 4000; ++n) {
        mpm.step(bodies(bar), courant_number);
        if (n % 100 == 0 && !(energy() < 1e4 * before)) return true;
    }
    return !(energy() < 1e4 * before);
}

template <class Shape, class Order> void check(std::vector<run_check>& to, bool full, const map_progress& tell,
                                               std::size_t all, const Shape& shape, const Order& order) {
    for (const int k : full ? std::vector{1, 2, 4, 16} : std::vector{1, 4})
        for (const int per_cell : full ? std::vector{1, 2, 3, 4} : std::vector{2})
            for (const double offset : full ? std::vector{0.05, 0.3, 0.55, 0.8} : std::vector{0.3}) {
                const fmpm<dynamic> update{k};
                const auto places = free_bar(per_cell, offset);
                const auto step = step_of_free_bar(per_cell, offset, shape, update, order);
                run_check one{
                    std::string(Shape::name) + ", FMPM(" + std::to_string(k) + "), " + std::string(Order::name),
                    per_cell, offset};
                tell(to.size(), all, one.composition);
                one.predicted = stability::first_unstable(stability::most_courant, 0.02, [&](double c) {
                    return stability::spectral_radius_of(step, c) <= 1 + stability::growth;
                });
                double low = 0, high = stability::most_courant;
                while (high - low > 0.004 * high) {
                    const double middle = (low + high) / 2;
                    (grows(places, per_cell, middle, shape, update, order) ? high : low) = middle;
                }
                one.by_runs = high > 0.99 * stability::most_courant ? stability::most_courant : (low + high) / 2;
                to.push_back(one);
            }
}

template <class Order> cure cure_by(const Order& order) {
    cure found{std::string(Order::name)};
    const fixed ends{[](const auto& at) { return at[0] <= 0 || at[0] >= 1; }};
    double seconds = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < 5; ++attempt) {
        solver mpm{uniform_grid{{0.}, {1.}, 0.02}, linear{}, fmpm<dynamic>{4}, order, held{}, ends};
        auto bar = mpm.make_body(linear_elastic{.young = 1, .poisson = 0, .density = 1}, everywhere, per_cell{2});
        const double pi = std::numbers::pi;
        set_velocity_of(bar, [&](const auto& at) { return 0.01 * std::sin(pi * at[0]); });
        const double before = kinetic_energy(bar);
        const auto clock = std::chrono::steady_clock::now();
        // An eighth of a period more than one, that there is strain.
        const double end = 2.25;
        const int steps = 1125;
        for (int n = 0; n < steps; ++n) mpm.step(bodies(bar), end / steps);
        seconds = std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count());
        double velocity = 0, strain = 0;
        for (const auto p : std::as_const(bar)) {
            const double at = p[x][0];
            velocity += std::pow(p[v][0] / 0.01 - std::sin(pi * at) * std::cos(pi * end), 2);
            strain += std::pow(p[sigma](0, 0) / 0.01 - std::cos(pi * at) * std::sin(pi * end), 2);
        }
        found.velocity_error = std::sqrt(velocity / 100);
        found.strain_error = std::sqrt(strain / 100);
        found.energy_change = (kinetic_energy(bar) + elastic_energy(bar)) / before - 1;
    }
    found.time_ratio = seconds;
    const auto step = step_of_free_bar(2, 0.25 + 2e-4, linear{}, fmpm<dynamic>{4}, order);
    found.critical = stability::first_unstable(stability::most_courant, 0.002, [&](double c) {
        return stability::spectral_radius_of(step, c) <= 1 + stability::growth;
    });
    return found;
}

}  // namespace

std::vector<cure> cures() {
    std::vector<cure> all{cure_by(usl_minus{}), cure_by(usl_plus{}), cure_by(usavg_minus{}), cure_by(usavg_plus{}),
                          cure_by(usf{})};
    const double usual = all[0].time_ratio;
    for (auto& one : all) one.time_ratio /= usual;
    return all;
}

std::string map_row::update_title() const {
    if (update == "flip") return "FLIP";
    if (update == "fmpm" && k == 1) return "PIC, FMPM(1)";
    return (update == "xpic" ? "XPIC(" : "FMPM(") + std::to_string(k) + ")";
}

std::vector<map_row> shipped_map() {
    std::vector<map_row> all;
    std::size_t row = 0;
    for (const std::string shape : {"linear", "quadratic", "cubic", "ugimp"})
        for (const std::string stress : {"usl-", "usavg-", "usf"}) {
            if (shape == "ugimp" && stress != "usl-") continue;
            const auto add = [&](const std::string& update, int k) {
                const auto& r = detail::critical_table[row++];
                for (int n = 0; n < detail::critical_per_cell; ++n)
                    all.push_back({shape, stress, update, k, n + 1, r.inner[n] / 1000., r.free_end[n] / 1000.});
            };
            add("flip", 0);
            for (const int k : detail::critical_xpic) add("xpic", k);
            for (const int k : detail::critical_fmpm) add("fmpm", k);
        }
    return all;
}

std::vector<run_check> checks_by_runs(bool full, const map_progress& tell) {
    std::vector<run_check> all;
    const std::size_t count = 6 * (full ? 4 * 4 * 4 : 2);
    check(all, full, tell, count, linear{}, usl_minus{});
    check(all, full, tell, count, linear{}, usavg_minus{});
    check(all, full, tell, count, linear{}, usf{});
    check(all, full, tell, count, quadratic_spline{}, usl_minus{});
    check(all, full, tell, count, quadratic_spline{}, usavg_minus{});
    check(all, full, tell, count, quadratic_spline{}, usf{});
    return all;
}

bool known_value::met() const { return std::abs(found - exact) <= within; }

std::vector<known_value> known_values() {
    const auto inner = [](int per_cell, double offset, const auto& update, int k) {
        return stability::critical_inner(per_cell, offset, stability::reach_of<linear>(k), stability::most_courant,
                                         linear{}, update, usl_minus{});
    };
    std::vector<known_value> all{{"linear, FLIP, USL-, 2 particles per cell at 1/4 and 3/4", "C^2 = 4/7",
                                  std::sqrt(4. / 7), inner(2, 0, flip{}, 0), 2e-4},
                                 {"linear, FLIP, USL-, 1 particle in the middle of its cell", "C^2 = 1/2",
                                  std::sqrt(0.5), inner(1, 0, flip{}, 0), 2e-4},
                                 {"linear, FMPM(64), USL-, 2 particles per cell at 1/4 and 3/4",
                                  "C = 1/2 for k to infinity", 0.5, inner(2, 0, fmpm<dynamic>{64}, 64), 5e-4}};
    // A node of share s of an inner one's mass at a free end: C^2 = 2 n s/k.
    for (const double share : {1e-2, 1e-4})
        for (const int k : {1, 4}) {
            const auto step = step_of_free_bar(2, 0.25 + 2 * share, linear{}, fmpm<dynamic>{k}, usl_minus{});
            const double theory = std::sqrt(4 * share / k);
            const double found = stability::first_unstable(1, theory / 10, [&](double c) {
                return stability::spectral_radius_of(step, c) <= 1 + stability::growth;
            });
            all.push_back({"linear, FMPM(" + std::to_string(k) + "), USL-, 2 particles per cell, lightest node " +
                               (share == 1e-2 ? "1e-2" : "1e-4") + " of the inner ones",
                           "C^2 = 2 n s/k for small s", theory, found, 0.04 * theory});
        }
    return all;
}
